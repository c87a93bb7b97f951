// Surfaces behind a pixel, counted in scenes where the number is known.
#include "heavy/depth_complexity.h"

#include <gtest/gtest.h>

#include "generate/mesh.h"

namespace scenes {
namespace {

constexpr Camera kAhead{.position = {0, 0, 0}, .target = {0, 0, -1}, .fovyDeg = 40.0f};

Glb sceneOf(const Mesh& mesh) {
  Glb glb;
  glb.add("mesh", mesh, glb.addMaterial({.name = "plain"}), {});
  return glb;
}

TEST(DepthComplexity, CountsEverySheetThatFacesTheCamera) {
  Mesh sheets;
  for (const float z : {-0.5f, -2.0f, -7.0f}) append(sheets, makeRectangle({1, -3, z}, {20, 0, 0}, {0, 20, 0}));
  const DepthComplexity found = depthComplexityOf(sceneOf(sheets), kAhead, 32);
  EXPECT_EQ(found.mean(), 3.0);
  EXPECT_EQ(found.shareOfAtLeast(3), 1.0);
  EXPECT_EQ(found.shareOfAtLeast(4), 0.0);
}

TEST(DepthComplexity, CountsNoBackFacesAndNothingBehindTheCamera) {
  Mesh mesh = makeRectangle({0, 0, -2}, {-20, 0, 0}, {0, 20, 0});
  append(mesh, makeRectangle({0, 0, 2}, {20, 0, 0}, {0, 20, 0}));
  append(mesh, makeRectangle({0, 0, 2}, {-20, 0, 0}, {0, 20, 0}));
  EXPECT_EQ(depthComplexityOf(sceneOf(mesh), kAhead, 32).mean(), 0.0);
}

TEST(DepthComplexity, SeesTheFrontOfABoxOnceAndOnlyWhereItIs) {
  // Its front is 1 m away and as wide as half the picture, as high as half of it.
  const float halfHeight = 0.5f * 0.36397023f;  // tan 20°
  const Mesh box = makeBox({0, 0, -1.5f}, {halfHeight * 16.0f / 9.0f, halfHeight, 0.5f});
  const DepthComplexity found = depthComplexityOf(sceneOf(box), kAhead, 64);
  EXPECT_NEAR(found.mean(), 0.25, 1e-6);
  EXPECT_EQ(found.surfaces[static_cast<size_t>(18 * 64 + 32)], 1);
  EXPECT_EQ(found.surfaces[0], 0);
}

TEST(DepthComplexity, CountsAFloorThatReachesBehindTheCamera) {
  const Mesh floor = makeRectangle({0, -1, 0}, {50, 0, 0}, {0, 0, -50});
  EXPECT_NEAR(depthComplexityOf(sceneOf(floor), kAhead, 64).mean(), 0.5, 0.04);
}

}  // namespace
}  // namespace scenes
