// The targets: shot files, glTF files, pictures, command lines.
#include "target.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>

#include "engine/error.h"
#include "engine/gltf/load_gltf.h"
#include "engine/image/image_io.h"
#include "rendergraph/error.h"
#include "samples/host/shot.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = LENSGRAPH_SOURCE_DIR;

Bytes contentOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void write(const fs::path& file, const Bytes& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// The contents of the files with these extensions in a folder and below it, in the order of their names; large ones
/// are left out, since their mutations are slow and mostly hit bulk data.
std::vector<Bytes> seedsIn(const fs::path& folder, std::initializer_list<std::string_view> extensions) {
  constexpr std::uintmax_t kLargest = 64 * 1024;
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto extension = entry.path().extension().string();
    if (!entry.is_regular_file() || entry.file_size() > kLargest) continue;
    if (std::ranges::find(extensions, extension) != extensions.end()) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::vector<Bytes> seeds;
  for (const auto& file : files) seeds.push_back(contentOf(file));
  return seeds;
}

void append(std::vector<Bytes>& seeds, std::vector<Bytes> more) {
  seeds.insert(seeds.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// What every line that users see must be.
void requireLine(const std::string& line) {
  constexpr std::size_t kLongest = 500;
  if (line.empty() || line.size() > kLongest) {
    throw std::logic_error("a line of " + std::to_string(line.size()) + " bytes: " + line.substr(0, 200));
  }
  for (const char c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) throw std::logic_error("a control character in: " + line);
  }
}

/// Runs a reader that may refuse its input, in one good line. That memory is short means that it took too much: inputs
/// are small.
template <class Work>
void refusing(const Work& work) {
  try {
    work();
  } catch (const engine::Error& error) {
    requireLine(error.what());
    if (error.kind() != engine::ErrorKind::badInput) throw std::logic_error(error.what());
  }
}

Target shotTarget(const fs::path& folder) {
  // Shots name files, which must be there.
  for (const auto& entry : fs::directory_iterator(kRoot / "samples/scenes")) {
    fs::create_symlink(entry.path(), folder / entry.path().filename());
  }
  const fs::path file = folder / "fuzzed.json";
  return {.name = "shot", .seeds = seedsIn(kRoot / "samples/scenes", {".json"}), .run = [file](const Bytes& bytes) {
            write(file, bytes);
            refusing([&] { host::readShot(file); });
          }};
}

Target gltfTarget(const fs::path& folder) {
  Target target{.name = "gltf", .seeds = seedsIn(kRoot / "samples/scenes", {".glb"}), .run = {}};
  append(target.seeds, seedsIn(kRoot / "tests/fuzz/seeds", {".gltf", ".glb"}));
  const fs::path file = folder / "fuzzed.gltf";
  target.run = [file](const Bytes& bytes) {
    write(file, bytes);
    for (const bool isLit : {false, true}) {
      refusing([&] {
        engine::Scene scene;
        for (const auto& warning : engine::appendGltf(scene, file, glm::dmat4(1.0), {.isLit = isLit})) {
          requireLine(warning);
        }
        if (const auto problems = engine::findProblems(scene); !problems.empty()) {
          throw std::logic_error("a broken scene was accepted: " + problems.front());
        }
      });
    }
  };
  return target;
}

Target pictureTarget(const fs::path&) {
  Target target{.name = "picture", .seeds = seedsIn(kRoot / "tests/fuzz/seeds", {".exr", ".png", ".hdr"}), .run = {}};
  target.run = [](const Bytes& bytes) {
    const auto view = std::as_bytes(std::span(bytes));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const char* name = text.starts_with("\x89PNG") ? "fuzzed.png"
                       : text.starts_with("#?")    ? "fuzzed.hdr"
                                                   : "fuzzed.exr";
    refusing([&] { engine::readImage(view, name, {}); });
    refusing([&] { engine::readDepth(view, name, {}); });
  };
  return target;
}

/// Words that are put together to command lines, at random. Files that are written lie in the folder of the target: no
/// word has a slash.
constexpr std::string_view kWords[] = {"render",
                                       "apply",
                                       "compare",
                                       "graph",
                                       "techniques",
                                       "capture-view",
                                       "capture-diff",
                                       "devices",
                                       "--technique",
                                       "pinhole",
                                       "accumulation",
                                       "--set",
                                       "lensSamples=4",
                                       "=",
                                       "a=b",
                                       "--size",
                                       "8x8",
                                       "0x0",
                                       "99999x1",
                                       "--exposure",
                                       "nan",
                                       "1e999",
                                       "--json",
                                       "-o",
                                       "out.exr",
                                       "out.png",
                                       "out.hdr",
                                       "good.json",
                                       "bad.json",
                                       "good.exr",
                                       "bad.exr",
                                       "--color",
                                       "--depth",
                                       "--fovy",
                                       "40",
                                       "--focus",
                                       "infinity",
                                       "--fstop",
                                       "-1",
                                       "--help",
                                       "--version",
                                       "--capture",
                                       "c.json",
                                       "--",
                                       "-",
                                       "",
                                       "--dump-image",
                                       "list",
                                       "--device",
                                       "0",
                                       "-v",
                                       "--faces",
                                       "both",
                                       "material",
                                       "--config",
                                       "--depth-scale",
                                       "--depth-kind",
                                       "ray",
                                       "normalized",
                                       "--depth-near",
                                       ".1",
                                       "--color-layer",
                                       "--depth-channel",
                                       "\xff\xfe"};

std::vector<std::string> commandLine(const Bytes& bytes) {
  std::vector<std::string> words = {"lensgraph"};
  for (const uint8_t byte : bytes) {
    if (byte < 0xf0) {
      words.emplace_back(kWords[byte % std::size(kWords)]);
    } else {
      // A control character or such at the end of the word before.
      words.back().push_back(static_cast<char>(byte - 0xf0 + 1));
    }
    if (words.size() > 24) break;
  }
  return words;
}

Target commandLineTarget(const fs::path& folder) {
  const fs::path scenes = kRoot / "samples/scenes";
  for (const auto& entry : fs::directory_iterator(scenes)) {
    fs::create_symlink(entry.path(), folder / entry.path().filename());
  }
  fs::copy_file(scenes / "figure.json", folder / "good.json");
  std::ofstream(folder / "bad.json") << "{\"scene\": [1, }";
  engine::writeImage(folder / "good.exr", engine::FloatImage(8, 8, 1, 2.0f));
  std::ofstream(folder / "bad.exr") << "no picture";
  // No device is opened: that takes long, and is not what is fuzzed.
  ::setenv("VK_DRIVER_FILES", "/nonexistent", 1);
  ::setenv("VK_ICD_FILENAMES", "/nonexistent", 1);

  Target target{.name = "command_line", .seeds = {}, .run = {}};
  for (std::size_t first = 0; first + 6 < std::size(kWords); first += 3) {
    Bytes seed;
    for (std::size_t i = 0; i < 6; ++i) seed.push_back(static_cast<uint8_t>(first + i));
    target.seeds.push_back(seed);
  }
  target.run = [folder](const Bytes& bytes) {
    fs::current_path(folder);
    std::vector<std::string> words = commandLine(bytes);
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    try {
      cli::run(static_cast<int>(argv.size()), argv.data());
    } catch (const engine::Error& error) {
      requireLine(error.what());
    } catch (const rendergraph::GraphError&) {
      throw std::logic_error("a graph without a device");
    }
  };
  return target;
}

}  // namespace

Target makeTarget(const std::string& name, const fs::path& folder) {
  if (name == "shot") return shotTarget(folder);
  if (name == "gltf") return gltfTarget(folder);
  if (name == "picture") return pictureTarget(folder);
  if (name == "command_line") return commandLineTarget(folder);
  throw std::invalid_argument("no target " + name + "; there are shot, gltf, picture, command_line");
}

}  // namespace lensgraph::fuzz
