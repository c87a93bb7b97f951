// A picture in memory: float samples, row by row from the top, channels interleaved.
//
// Colour is linear, scene-referred, Rec.709 primaries, premultiplied where there is alpha. Values are
// unrestricted: negative, above one, infinite and NaN samples are kept as they are.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lensgraph::engine {

struct FloatImage {
  uint32_t width = 0;          ///< px
  uint32_t height = 0;         ///< px
  uint32_t channels = 0;       ///< 1 (depth, luminance), 3 (RGB) or 4 (RGBA) in this project; any number is legal.
  std::vector<float> samples;  ///< width · height · channels, top row first.

  FloatImage() = default;
  FloatImage(uint32_t imageWidth, uint32_t imageHeight, uint32_t channelCount, float value = 0.0f)
      : width(imageWidth),
        height(imageHeight),
        channels(channelCount),
        samples(size_t{imageWidth} * imageHeight * channelCount, value) {}

  size_t pixelCount() const { return size_t{width} * height; }
  bool isEmpty() const { return samples.empty(); }

  /// The channels of one pixel; x to the right, y down, both from 0.
  float* pixel(uint32_t x, uint32_t y) {
    assert(x < width && y < height);
    return samples.data() + (size_t{y} * width + x) * channels;
  }
  const float* pixel(uint32_t x, uint32_t y) const {
    assert(x < width && y < height);
    return samples.data() + (size_t{y} * width + x) * channels;
  }
};

}  // namespace lensgraph::engine
