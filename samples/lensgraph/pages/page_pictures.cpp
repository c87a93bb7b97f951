// Pictures inside of a page: see page_pictures.h.
#include "samples/lensgraph/pages/page_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "engine/image/image_io.h"
#include "engine/image/srgb.h"
#include "engine/metrics/displayed.h"

namespace lensgraph::cli {
namespace {

/// One pixel of the target takes the mean of these pixels of the source: [first, last].
struct Range {
  uint32_t first, last;
};

Range sourceOf(uint32_t target, uint32_t targetSize, uint32_t sourceSize) {
  const auto begin = static_cast<uint32_t>(uint64_t{target} * sourceSize / targetSize);
  const auto end = static_cast<uint32_t>(uint64_t{target + 1} * sourceSize / targetSize);
  return {begin, std::max(begin, end - 1)};
}

engine::FloatImage scaledDown(engine::FloatImage image, uint32_t longestSide) {
  const uint32_t longest = std::max(image.width, image.height);
  if (longest <= longestSide) return image;
  const auto scaled = [&](uint32_t side) {
    return std::max(1u, static_cast<uint32_t>(std::lround(static_cast<double>(longestSide) * side / longest)));
  };
  engine::FloatImage result(scaled(image.width), scaled(image.height), image.channels);
  for (uint32_t y = 0; y < result.height; ++y) {
    const Range rows = sourceOf(y, result.height, image.height);
    for (uint32_t x = 0; x < result.width; ++x) {
      const Range columns = sourceOf(x, result.width, image.width);
      float* target = result.pixel(x, y);
      for (uint32_t sy = rows.first; sy <= rows.last; ++sy) {
        for (uint32_t sx = columns.first; sx <= columns.last; ++sx) {
          for (uint32_t c = 0; c < image.channels; ++c) target[c] += image.pixel(sx, sy)[c];
        }
      }
      const auto count = static_cast<float>((rows.last - rows.first + 1) * (columns.last - columns.first + 1));
      for (uint32_t c = 0; c < image.channels; ++c) target[c] /= count;
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
