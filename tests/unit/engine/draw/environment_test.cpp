// Environment maps: constant light, a single direction, broken texels, mips.
#include "engine/draw/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/error.h"

namespace lensgraph {

namespace {

/// Irradiance / π of a direction, as the shader evaluates it.
glm::vec3 irradianceAt(const engine::Environment& environment, const glm::vec3& n) {
  const auto& l = environment.irradiance;
  return l[0] + l[1] * n.y + l[2] * n.z + l[3] * n.x + l[4] * n.x * n.y + l[5] * n.y * n.z +
         l[6] * (3.0f * n.z * n.z - 1.0f) + l[7] * n.x * n.z + l[8] * (n.x * n.x - n.y * n.y);
}

TEST(Environment, ConstantLightGivesConstantIrradiance) {
  const auto environment = engine::prepareEnvironment(engine::FloatImage(64, 32, 3, 2.0f));
  for (const glm::vec3& n : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, -1), glm::vec3(0.6f, 0.8f, 0)}) {
    EXPECT_NEAR(irradianceAt(environment, n).x, 2.0f, 0.01f);
  }
}

TEST(Environment, LinearLightKeepsTwoThirdsOfItsSlope) {
  // Radiance 1 + n·a has irradiance/π of 1 + (2/3) n·a, exactly (Ramamoorthi & Hanrahan 2001).
  engine::FloatImage map(128, 64, 3);
  const glm::dvec3 a(0.3, -0.4, 0.5);
  for (uint32_t y = 0; y < map.height; ++y) {
    for (uint32_t x = 0; x < map.width; ++x) {
      const double theta = M_PI * (y + 0.5) / map.height, azimuth = 2.0 * M_PI * ((x + 0.5) / map.width - 0.5);
      const glm::dvec3 n(std::sin(theta) * std::sin(azimuth), std::cos(theta), -std::sin(theta) * std::cos(azimuth));
      for (int c = 0; c < 3; ++c) map.pixel(x, y)[c] = float(1.0 + glm::dot(n, a));
    }
  }
  const auto environment = engine::prepareEnvironment(map);
  for (const glm::vec3& n : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)}) {
    EXPECT_NEAR(irradianceAt(environment, n).y, 1.0 + 2.0 / 3.0 * glm::dot(glm::dvec3(n), a), 0.005);
  }
}

TEST(Environment, BrokenTexelsAreBlackAndMipsReachOneTexel) {
  engine::FloatImage map(6, 3, 4, 1.0f);
  map.pixel(2, 1)[0] = std::numeric_limits<float>::quiet_NaN();
  map.pixel(3, 1)[1] = std::numeric_limits<float>::infinity();
  const auto environment = engine::prepareEnvironment(map);
  EXPECT_TRUE(std::isfinite(irradianceAt(environment, {0, 0, -1}).x));
  EXPECT_EQ(environment.desc.mips, 3u);  // 6x3, 3x1, 1x1
  EXPECT_EQ(environment.texels.size(), (18u + 3u + 1u) * 8u);
  EXPECT_THROW(engine::prepareEnvironment({}), engine::Error);
}

}  // namespace

}  // namespace lensgraph
