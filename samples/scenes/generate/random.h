// Random numbers that are the same on every machine (the standard distributions are not): PCG32, O'Neill
// 2014.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace scenes {

class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed * 2654435769u + 1013904223u) { next(); }

  uint32_t next() {
    const uint64_t old = state_;
    state_ = old * 6364136223846793005ull + 1442695040888963407ull;
    const auto shifted = static_cast<uint32_t>(((old >> 18u) ^ old) >> 27u);
    const auto rotation = static_cast<uint32_t>(old >> 59u);
    return (shifted >> rotation) | (shifted << ((32u - rotation) & 31u));
  }

  /// Uniform in [0, 1).
  float unit() { return static_cast<float>(next() >> 8u) * 0x1p-24f; }
  float between(float low, float high) { return low + (high - low) * unit(); }
  /// Each component uniform in [-1, 1).
  glm::vec3 cube() {
    const float x = between(-1.0f, 1.0f);
    const float y = between(-1.0f, 1.0f);
    const float z = between(-1.0f, 1.0f);
    return {x, y, z};
  }

 private:
  uint64_t state_;
};

}  // namespace scenes
