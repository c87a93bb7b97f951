// Pictures for tests of metrics: a scene of ramps, edges, lines, points and noise, and what a bad technique makes of it.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "engine/image/image.h"

namespace lensgraph {

/// RGB in [0, brightest]: a colour ramp, a disc, thin lines, one pixel in 97 as bright as `brightest`.
inline engine::FloatImage metricScene(uint32_t width, uint32_t height, float brightest) {
  engine::FloatImage image(width, height, 3);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      float* p = image.pixel(x, y);
      const float u = static_cast<float>(x) / static_cast<float>(width);
      const float v = static_cast<float>(y) / static_cast<float>(height);
      p[0] = u * u;
      p[1] = 0.5f * v;
      p[2] = 0.3f * (1.0f - u) * v;
      if (std::hypot(u - 0.6f, v - 0.4f) < 0.25f) p[0] = 0.8f, p[1] = 0.1f, p[2] = 0.05f;
      if (x % 11 == 3 || y % 17 == 5) p[0] = p[1] = p[2] = 0.02f;
      if ((x + 31 * y) % 97 == 0) p[0] = p[1] = p[2] = brightest;
    }
  }
  return image;
}

/// The scene with noise, a shift of one pixel in its right half, and a green tint in its lower half.
inline engine::FloatImage metricMistake(const engine::FloatImage& scene, unsigned seed) {
  engine::FloatImage image = scene;
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0.0f, 0.05f);
  for (uint32_t y = 0; y < scene.height; ++y) {
    for (uint32_t x = 0; x < scene.width; ++x) {
      const bool shifted = 2 * x > scene.width && x > 0;
      for (uint32_t c = 0; c < 3; ++c) {
        image.pixel(x, y)[c] = std::fmax(0.0f, scene.pixel(shifted ? x - 1 : x, y)[c] * (1.0f + noise(random)));
      }
      if (2 * y > scene.height) image.pixel(x, y)[1] += 0.1f;
    }
  }
  return image;
}

}  // namespace lensgraph
