// Pictures inside of a page: see page_pictures.h.
#include "samples/lensgraph/pages/page_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/image/image_io.h"
#include "engine/image/srgb.h"
#include "engine/metrics/displayed.h"

namespace lensgraph::cli {
namespace {

/// The pixels of the source, from `first` on, whose weighted mean a pixel of the target takes.
struct Footprint {
  uint32_t first = 0;
  std::vector<float> weights;  ///< Their sum is 1.
};

/// By the area that pixels of the one side cover on the other.
std::vector<Footprint> footprints(uint32_t targetSize, uint32_t sourceSize) {
  const double scale = static_cast<double>(sourceSize) / targetSize;
  std::vector<Footprint> result(targetSize);
  for (uint32_t i = 0; i < targetSize; ++i) {
    const double begin = i * scale, end = std::min<double>(sourceSize, (i + 1) * scale);
    result[i].first = static_cast<uint32_t>(begin);
    for (uint32_t source = result[i].first; source < end; ++source) {
      const double covered = std::min<double>(end, source + 1.0) - std::max<double>(begin, source);
      result[i].weights.push_back(static_cast<float>(covered / (end - begin)));
    }
  }
  return result;
}

engine::FloatImage scaledDown(engine::FloatImage image, uint32_t longestSide) {
  const uint32_t longest = std::max(image.width, image.height);
  if (longest <= longestSide) return image;
  const auto scaled = [&](uint32_t side) {
    return std::max(1u, static_cast<uint32_t>(std::lround(static_cast<double>(longestSide) * side / longest)));
  };
  engine::FloatImage result(scaled(image.width), scaled(image.height), image.channels);
  const auto columns = footprints(result.width, image.width), rows = footprints(result.height, image.height);
  for (uint32_t y = 0; y < result.height; ++y) {
    for (uint32_t x = 0; x < result.width; ++x) {
      float* target = result.pixel(x, y);
      for (uint32_t dy = 0; dy < rows[y].weights.size(); ++dy) {
        for (uint32_t dx = 0; dx < columns[x].weights.size(); ++dx) {
          const float weight = rows[y].weights[dy] * columns[x].weights[dx];
          const float* source = image.pixel(columns[x].first + dx, rows[y].first + dy);
          for (uint32_t c = 0; c < image.channels; ++c) target[c] += weight * source[c];
        }
      }
    }
  }
  return result;
}

std::string base64(std::span<const unsigned char> bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    uint32_t word = uint32_t{bytes[i]} << 16;
    if (count > 1) word |= uint32_t{bytes[i + 1]} << 8;
    if (count > 2) word |= bytes[i + 2];
    for (std::size_t digit = 0; digit < 4; ++digit) {
      text += digit <= count ? kDigits[word >> (18 - 6 * digit) & 63] : '=';
    }
  }
  return text;
}

std::string uriOf(const engine::FloatImage& linear) {
  return "data:image/png;base64," + base64(engine::encodePng(linear));
}

}  // namespace

std::string pictureUri(const engine::FloatImage& picture, double exposureEv, uint32_t longestSide) {
  // displayed() clamps; what a display emits is averaged as light.
  engine::FloatImage light = engine::displayed(picture, exposureEv);
  for (float& sample : light.samples) sample = engine::linearFromSrgb(sample);
  return uriOf(scaledDown(std::move(light), longestSide));
}

std::string mapUri(const engine::FloatImage& map, uint32_t longestSide) {
  engine::FloatImage scaled = scaledDown(map, longestSide);
  // The encoding of the PNG file turns these back into the map's own values.
  for (float& sample : scaled.samples) sample = engine::linearFromSrgb(std::clamp(sample, 0.0f, 1.0f));
  return uriOf(scaled);
}

}  // namespace lensgraph::cli
