// generate_scenes: writes the sample scenes, their shots and their environment, and prints what each holds.
//
//   generate_scenes [-o FOLDER]                       all committed scenes (default folder: out/scenes)
//   generate_scenes --scaling TRIANGLES -o FILE.glb   one scene of at least that many triangles, and
//   FILE.json
#include <charconv>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "generate/scene.h"

namespace {

using scenes::Scene;

constexpr size_t kForegroundBlurTriangles = 24000;
constexpr size_t kMaximumTriangles = 20'000'000;  // Keeps a .glb below 1 GiB, far from its 4 GiB limit.

struct Options {
  std::filesystem::path output;
  std::optional<size_t> scaling;
};

void print(const std::string& file, const Scene& scene, const std::filesystem::path& path) {
  for (const scenes::Shot& shot : scene.shots) {
    const scenes::Extent extent = measure(shot, scene.glb);
    std::printf("| %s | %s | %zu | %zu | %.2f – %.2f | %.2f | %+.1f … %+.1f | %+.1f |\n", file.c_str(),
                shot.name.c_str(), scene.glb.worldTriangles().size(),
                static_cast<size_t>(std::filesystem::file_size(path)), extent.nearDepth, extent.farDepth,
                shot.lens.focusDistance, extent.nearCocPx, extent.farCocPx, extent.backgroundCocPx);
  }
}

void write(const Scene& scene, const std::filesystem::path& folder, const std::string& file) {
  if (!folder.empty()) std::filesystem::create_directories(folder);
  scene.glb.write(folder / file);
  for (const scenes::Shot& shot : scene.shots) writeShot(folder / (shot.name + ".json"), shot, file);
  print(file, scene, folder / file);
}

void writeAll(const std::filesystem::path& folder) {
  write(scenes::makeRailingText(), folder, "railing_text.glb");
  write(scenes::makeCrossingBranches(), folder, "crossing_branches.glb");
  write(scenes::makeFoliage(), folder, "foliage.glb");
  write(scenes::makeGlassPanes(), folder, "glass_panes.glb");
  write(scenes::makeStreetLights(), folder, "street_lights.glb");
  write(scenes::makeFigure(), folder, "figure.glb");
  write(scenes::makeReflective(), folder, "reflective.glb");
  write(scenes::makeForegroundBlur(kForegroundBlurTriangles, "foreground_blur"), folder, "foreground_blur.glb");
  scenes::writeStudioEnvironment(folder / "studio.exr");
}

std::optional<Options> parse(int count, char** arguments) {
  Options options;
  for (int i = 1; i < count; i += 2) {
    const std::string_view word = arguments[i];
    const char* value = i + 1 < count ? arguments[i + 1] : nullptr;
    if (value == nullptr) return std::nullopt;
    if (word == "-o") {
      options.output = value;
    } else if (word == "--scaling") {
      size_t triangles = 0;
      const char* end = value + std::strlen(value);
      const auto [rest, error] = std::from_chars(value, end, triangles);
      if (error != std::errc() || rest != end || triangles == 0 || triangles > kMaximumTriangles) {
        return std::nullopt;
      }
      options.scaling = triangles;
    } else {
      return std::nullopt;
    }
  }
  if (options.scaling && options.output.extension() != ".glb") return std::nullopt;
  if (options.output.empty()) options.output = "out/scenes";
  return options;
}

}  // namespace

int main(int count, char** arguments) {
  const std::optional<Options> options = parse(count, arguments);
  if (!options) {
    std::fprintf(stderr,
                 "usage: generate_scenes [-o FOLDER]\n"
                 "       generate_scenes --scaling TRIANGLES -o FILE.glb   (1 to %zu triangles)\n",
                 kMaximumTriangles);
    return 2;
  }
  try {
    std::puts(
        "| scene | shot | triangles | bytes | depths (m) | focus (m) | CoC near … far (px) | CoC at infinity "
        "(px) |");
    std::puts("|---|---|---|---|---|---|---|---|");
    if (options->scaling) {
      const std::string name = options->output.stem().string();
      write(scenes::makeForegroundBlur(*options->scaling, name), options->output.parent_path(),
            options->output.filename().string());
    } else {
      writeAll(options->output);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "generate_scenes: %s\n", error.what());
    return 1;
  }
  return 0;
}
