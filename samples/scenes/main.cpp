// generate_scenes: writes the sample scenes, their shots and their environments, and prints what each holds.
//
//   generate_scenes [-o FOLDER]                       all committed scenes (default folder: out/scenes)
//   generate_scenes --scaling TRIANGLES -o FILE.glb   one scene of at least that many triangles, and FILE.json
//   generate_scenes --heavy FOLDER                    the large scenes, which are not committed
#include <charconv>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "generate/scene.h"
#include "generate/whole_file.h"
#include "heavy/depth_complexity.h"
#include "heavy/heavy_scenes.h"

namespace {

using scenes::Scene;

constexpr size_t kForegroundBlurTriangles = 24000;
constexpr size_t kMaximumTriangles = 20'000'000;  // Keeps a .glb below 1 GiB, far from its 4 GiB limit.

struct Options {
  std::filesystem::path output;
  std::optional<size_t> scaling;
  bool heavy = false;
};

/// What is wrong with the command line, without the program's name.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
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
  scenes::writeWhole(folder / file, [&](const std::filesystem::path& path) { scene.glb.write(path); });
  for (const scenes::Shot& shot : scene.shots) {
    scenes::writeWhole(folder / (shot.name + ".json"),
                       [&](const std::filesystem::path& path) { writeShot(path, shot, file); });
  }
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
  scenes::writeWhole(folder / "studio.exr", scenes::writeStudioEnvironment);
}

/// One after another, so that no two are in memory.
void writeHeavy(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (scenes::HeavyScene (*make)() : {scenes::makeStreet, scenes::makeForest, scenes::makeDeep}) {
    const scenes::HeavyScene heavy = make();
    scenes::writeWhole(folder / (heavy.name + "_sky.exr"),
                       [&](const std::filesystem::path& path) { writeSky(path, heavy.sky); });
    write(heavy.scene, folder, heavy.name + ".glb");
    const scenes::DepthComplexity depth = depthComplexityOf(heavy.scene.glb, heavy.scene.shots.front().camera);
    std::fprintf(stderr, "%s: %.1f front faces behind a pixel in the mean, ten or more behind %.0f %% of the pixels\n",
                 heavy.name.c_str(), depth.mean(), 100.0 * depth.shareOfAtLeast(10));
  }
}

size_t triangleCountFrom(const char* text) {
  size_t triangles = 0;
  const char* end = text + std::strlen(text);
  const auto [rest, error] = std::from_chars(text, end, triangles);
  if (error != std::errc() || rest != end || triangles == 0 || triangles > kMaximumTriangles) {
    throw UsageError("--scaling: '" + std::string(text) + "' is no number from 1 to " +
                     std::to_string(kMaximumTriangles));
  }
  return triangles;
}

Options parse(int count, char** arguments) {
  Options options;
  for (int i = 1; i < count; i += 2) {
    const std::string_view word = arguments[i];
    if (word != "-o" && word != "--scaling" && word != "--heavy") {
      throw UsageError("'" + std::string(word) +
                       "' is none of -o FOLDER, --scaling TRIANGLES -o FILE.glb, --heavy FOLDER");
    }
    if (i + 1 == count || arguments[i + 1][0] == '\0') throw UsageError(std::string(word) + " needs a value");
    const char* value = arguments[i + 1];
    if (word == "--scaling") {
      options.scaling = triangleCountFrom(value);
      continue;
    }
    if (!options.output.empty()) throw UsageError("more than one place to write to; give one of -o and --heavy");
    options.output = value;
    options.heavy = word == "--heavy";
  }
  if (options.heavy && options.scaling) throw UsageError("--heavy and --scaling exclude each other");
  if (options.scaling && options.output.extension() != ".glb") throw UsageError("--scaling needs -o FILE.glb");
  if (options.output.empty()) options.output = "out/scenes";
  return options;
}

void run(const Options& options) {
  std::puts(
      "| scene | shot | triangles | bytes | depths (m) | focus (m) | CoC near … far (px) | CoC at infinity "
      "(px) |");
  std::puts("|---|---|---|---|---|---|---|---|");
  if (options.heavy) {
    writeHeavy(options.output);
  } else if (options.scaling) {
    const std::string name = options.output.stem().string();
    write(scenes::makeForegroundBlur(*options.scaling, name), options.output.parent_path(),
          options.output.filename().string());
  } else {
    writeAll(options.output);
  }
}

}  // namespace

int main(int count, char** arguments) {
  try {
    run(parse(count, arguments));
  } catch (const UsageError& error) {
    std::fprintf(stderr, "generate_scenes: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "generate_scenes: %s\n", error.what());
    return 1;
  }
  return 0;
}
