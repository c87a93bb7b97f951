// Maps as files: see map_files.h.
#include "samples/lensgraph/compare/map_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "engine/error.h"
#include "engine/files/output_file.h"
#include "engine/image/image_io.h"
#include "engine/image/srgb.h"

namespace lensgraph::cli {
namespace {

using std::filesystem::path;

// Nine of matplotlib's colours "magma" (0, 1/8, …, 1), sRGB-encoded; CC0.
constexpr std::array<std::array<uint8_t, 3>, 9> kMagma = {{{0x00, 0x00, 0x04},
                                                           {0x1d, 0x11, 0x47},
                                                           {0x51, 0x12, 0x7c},
                                                           {0x82, 0x26, 0x81},
                                                           {0xb6, 0x36, 0x79},
                                                           {0xe6, 0x51, 0x64},
                                                           {0xfb, 0x88, 0x61},
                                                           {0xfe, 0xc2, 0x87},
                                                           {0xfc, 0xfd, 0xbf}}};

std::array<float, 3> magmaColor(float value) {
  constexpr auto last = static_cast<float>(kMagma.size() - 1);
  const float at = value > 0.0f ? std::min(value, 1.0f) * last : 0.0f;
  const auto left = static_cast<size_t>(std::min(std::floor(at), last - 1.0f));
  std::array<float, 3> linear{};
  for (size_t i = 0; i < 3; ++i) {
    const float encoded = std::lerp(static_cast<float>(kMagma[left][i]), static_cast<float>(kMagma[left + 1][i]),
                                    at - static_cast<float>(left));
    linear[i] = engine::linearFromSrgb(encoded / 255.0f);
  }
  return linear;
}

[[noreturn]] void failFolder(const path& folder, const std::string& reason) {
  throw engine::Error(
      {.file = folder.string(), .field = "--maps", .reason = reason, .remedy = "choose another folder"});
}

// Writes pictures into one folder, but over none of the files that are compared.
class MapWriter {
 public:
  MapWriter(const Comparison& comparison, path folder) : folder_(std::move(folder)) {
    inputs_.push_back(engine::writtenPath(comparison.referenceFile));
    for (const auto& picture : comparison.pictures) inputs_.push_back(engine::writtenPath(picture.file));
  }

  void write(const std::string& name, const engine::FloatImage& image) const {
    const path file = folder_ / name;
    if (std::find(inputs_.begin(), inputs_.end(), engine::writtenPath(file)) != inputs_.end()) {
      throw engine::Error({.file = file.string(),
                           .field = "--maps",
                           .reason = "would replace one of the pictures compared",
                           .remedy = "choose another folder"});
    }
    engine::writeImage(file, image);
  }

 private:
  path folder_;
  std::vector<path> inputs_;
};

std::string nameFor(const path& file, std::set<std::string>& taken) {
  const std::string stem = file.stem().string();
  std::string name = stem;
  for (int i = 2; !taken.insert(name).second; ++i) name = stem + "_" + std::to_string(i);
  return name;
}

}  // namespace

void checkMapFolder(const path& folder) {
  path missing;  // The topmost folder that would have to be made.
  for (path at = folder; !at.empty() && !std::filesystem::exists(at); at = at.parent_path()) missing = at;
  if (!missing.empty()) return engine::requireWritable(missing, "--maps");
  if (!std::filesystem::is_directory(folder)) failFolder(folder, "is a file");
  engine::requireWritable(folder / "mask.nearEdge.png", "--maps");
}

void writeMaps(const Comparison& comparison, const path& folder) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (!std::filesystem::is_directory(folder)) failFolder(folder, "cannot be made: " + code.message());
  const MapWriter writer(comparison, folder);
  std::set<std::string> taken;
  for (const auto& picture : comparison.pictures) {
    const std::string name = nameFor(picture.file, taken);
    writer.write(name + ".flip.exr", picture.flipMap);
    writer.write(name + ".flip.png", magmaPicture(picture.flipMap));
    writer.write(name + ".hdr_flip.exr", picture.hdrFlipMap);
    writer.write(name + ".hdr_flip.png", magmaPicture(picture.hdrFlipMap));
    writer.write(name + ".difference.png", picture.differenceMap);
  }
  for (const auto& mask : comparison.masks) writer.write("mask." + std::string(mask.name) + ".png", mask.pixels);
}

engine::FloatImage magmaPicture(const engine::FloatImage& map) {
  engine::FloatImage picture(map.width, map.height, 3);
  for (size_t i = 0; i < map.samples.size(); ++i) {
    const auto color = magmaColor(map.samples[i]);
    std::copy(color.begin(), color.end(), picture.samples.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  return picture;
}

}  // namespace lensgraph::cli
