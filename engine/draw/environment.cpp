// Mip chain by 2×2 means and projection onto spherical harmonics, on the CPU: environments are small and loaded once.
#include "engine/draw/environment.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <glm/vec4.hpp>
#include <numbers>

#include "engine/error.h"

namespace lensgraph::engine {
namespace {

constexpr float kLargestHalf = 65504.0f;

struct Level {
  uint32_t width, height;
  std::vector<glm::vec3> texels;
  const glm::vec3& at(uint32_t x, uint32_t y) const {
    return texels[std::size_t{std::min(y, height - 1)} * width + std::min(x, width - 1)];
  }
};

float safe(float value) {
  return std::isfinite(value) ? std::clamp(value, 0.0f, kLargestHalf) : 0.0f;
}

Level firstLevel(const FloatImage& map) {
  Level level{map.width, map.height, {}};
  level.texels.reserve(map.pixelCount());
  for (uint32_t y = 0; y < map.height; ++y) {
    for (uint32_t x = 0; x < map.width; ++x) {
      const float* p = map.pixel(x, y);
      const bool grey = map.channels < 3;
      level.texels.emplace_back(safe(p[0]), safe(p[grey ? 0 : 1]), safe(p[grey ? 0 : 2]));
    }
  }
  return level;
}

Level halved(const Level& from) {
  Level to{std::max(from.width / 2, 1u), std::max(from.height / 2, 1u), {}};
  for (uint32_t y = 0; y < to.height; ++y) {
    for (uint32_t x = 0; x < to.width; ++x) {
      to.texels.push_back(0.25f * (from.at(2 * x, 2 * y) + from.at(2 * x + 1, 2 * y) + from.at(2 * x, 2 * y + 1) +
                                   from.at(2 * x + 1, 2 * y + 1)));
    }
  }
  return to;
}

void append(std::vector<std::byte>& out, const Level& level) {
  for (const auto& texel : level.texels) {
    const uint64_t packed = glm::packHalf4x16(glm::vec4(texel, 1.0f));
    const auto* bytes = reinterpret_cast<const std::byte*>(&packed);
    out.insert(out.end(), bytes, bytes + sizeof packed);
  }
}

/// Coefficients L_lm of radiance, then times the cosine lobe A_l / π and twice the basis constant (once for the
/// projection, once for the evaluation), so that the shader only multiplies by the polynomials.
std::array<glm::vec3, 9> project(const Level& map) {
  using std::numbers::pi;
  std::array<glm::dvec3, 9> sum{};
  for (uint32_t y = 0; y < map.height; ++y) {
    const double theta = pi * (y + 0.5) / map.height;
    const double solidAngle = 2.0 * pi / map.width * pi / map.height * std::sin(theta);
    for (uint32_t x = 0; x < map.width; ++x) {
      const double azimuth = 2.0 * pi * ((x + 0.5) / map.width - 0.5);
      const glm::dvec3 n(std::sin(theta) * std::sin(azimuth), std::cos(theta), -std::sin(theta) * std::cos(azimuth));
      const double basis[9] = {
          1.0, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0 * n.z * n.z - 1.0, n.x * n.z, n.x * n.x - n.y * n.y};
      for (int i = 0; i < 9; ++i) sum[i] += glm::dvec3(map.at(x, y)) * (basis[i] * solidAngle);
    }
  }
  constexpr double k0 = 0.282095, k1 = 0.488603, k2 = 1.092548, k20 = 0.315392, k22 = 0.546274;
  const double constants[9] = {k0, k1, k1, k1, k2, k2, k20, k2, k22};
  const double lobe[9] = {1.0, 2.0 / 3, 2.0 / 3, 2.0 / 3, 0.25, 0.25, 0.25, 0.25, 0.25};  // A_l / π
  std::array<glm::vec3, 9> irradiance;
  for (int i = 0; i < 9; ++i) irradiance[i] = glm::vec3(sum[i] * (constants[i] * constants[i] * lobe[i]));
  return irradiance;
}

}  // namespace

Environment prepareEnvironment(const FloatImage& map) {
  if (map.isEmpty() || map.channels == 0) throw Error("environment map has no pixels");
  Level level = firstLevel(map);
  Environment environment;
  environment.irradiance = project(level);
  environment.desc = {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = level.width, .height = level.height};
  append(environment.texels, level);
  while (level.width > 1 || level.height > 1) {
    level = halved(level);
    append(environment.texels, level);
    ++environment.desc.mips;
  }
  return environment;
}

}  // namespace lensgraph::engine
