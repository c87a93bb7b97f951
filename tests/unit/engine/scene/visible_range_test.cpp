// The depth range of what a camera sees, on scenes whose answer is known.
#include "engine/scene/visible_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lensgraph {

namespace {

using engine::Scene;

/// Square of side 2·half that faces the camera, centre (x, 0, -depth).
void addSquare(Scene& scene, double depth, double x, double half) {
  engine::Primitive square;
  const auto corner = [&](double u, double v) {
    square.positions.emplace_back(float(x + u * half), float(v * half), float(-depth));
  };
  corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1);
  square.indices = {0, 1, 2, 0, 2, 3};
  scene.primitives.push_back(square);
  scene.instances.push_back(
      {.primitive = uint32_t(scene.primitives.size() - 1), .worldFromObject = glm::dmat4(1.0), .name = ""});
}

engine::Camera camera90() {
  engine::Camera camera;
  camera.fovy = std::numbers::pi / 2.0;
  camera.nearPlane = 0.1;
  return camera;
}

TEST(VisibleRange, EmptySceneSeesNothing) {
  EXPECT_TRUE(visibleRange({}, camera90(), 100, 100, {}, 1.0).isEmpty);
}

TEST(VisibleRange, HiddenSurfacesCount) {
  Scene scene;
  addSquare(scene, 2.0, 0.0, 50.0);
  addSquare(scene, 7.0, 0.0, 1.0);
  const auto range = visibleRange(scene, camera90(), 100, 100, {}, 1.0);
  EXPECT_DOUBLE_EQ(range.nearestDepth, 2.0);
  EXPECT_DOUBLE_EQ(range.farthestDepth, 7.0);
}

TEST(VisibleRange, WhatIsOutsideTheFrustumDoesNotCount) {
  Scene scene;
  addSquare(scene, 5.0, 0.0, 1.0);
  addSquare(scene, 1.0, 1.6, 0.5);    // its edge is at 1.1, the frustum's side at 1.0
  addSquare(scene, -3.0, 0.0, 10.0);  // behind the camera
  addSquare(scene, 0.05, 0.0, 10.0);  // in front of the near plane
  const auto range = visibleRange(scene, camera90(), 100, 100, {}, 1.0);
  EXPECT_DOUBLE_EQ(range.nearestDepth, 5.0);
  EXPECT_DOUBLE_EQ(range.farthestDepth, 5.0);
}

TEST(VisibleRange, PointsOfTheLensSeePastTheFrustum) {
  Scene scene;
  addSquare(scene, 5.0, 0.0, 1.0);
  addSquare(scene, 1.0, 1.6, 0.5);  // its edge is at 1.1, the pinhole's frustum ends at 1.0
  // Focused at 2 m, a lens point 0.25 m off the axis sees 0.25·|0.5 - 1| = 0.125 m further to the side.
  EXPECT_DOUBLE_EQ(visibleRange(scene, camera90(), 100, 100, {0.25, 0.5}, 1.0).nearestDepth, 1.0);
  EXPECT_DOUBLE_EQ(visibleRange(scene, camera90(), 100, 100, {0.15, 0.5}, 1.0).nearestDepth, 5.0);
  // Focused on the square's own depth every lens point sees the same there.
  EXPECT_DOUBLE_EQ(visibleRange(scene, camera90(), 100, 100, {5.0, 1.0}, 1.0).nearestDepth, 5.0);
  // Behind the focal plane likewise: at 4 m the frustum ends at 4, and 0.25·|2 - 1| further.
  Scene behind;
  addSquare(behind, 4.0, 4.7, 0.5);
  EXPECT_FALSE(visibleRange(behind, camera90(), 100, 100, {0.25, 0.5}, 1.0).isEmpty);
  EXPECT_TRUE(visibleRange(behind, camera90(), 100, 100, {0.15, 0.5}, 1.0).isEmpty);
}

TEST(VisibleRange, SpansAreWhereThereIsSomething) {
  Scene scene;
  addSquare(scene, 5.0, 0.0, 1.0);
  addSquare(scene, 2.0, 0.0, 1.0);
  addSquare(scene, 2.0, 0.5, 1.0);
  const auto spans = visibleRange(scene, camera90(), 100, 100, {0.1, 0.3}, 1.0).spans;
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_DOUBLE_EQ(spans[0].nearest, 2.0);
  EXPECT_DOUBLE_EQ(spans[0].farthest, 2.0);
  EXPECT_DOUBLE_EQ(spans[1].nearest, 5.0);
}

TEST(VisibleRange, OfManySpansTheSmallestGapsAreClosed) {
  Scene scene;
  for (int i = 1; i <= 80; ++i) addSquare(scene, i, 0.0, 0.1);
  const auto spans = visibleRange(scene, camera90(), 100, 100, {}, 1.0).spans;
  ASSERT_EQ(spans.size(), 64u);  // gaps of vergence shrink with depth
  EXPECT_DOUBLE_EQ(spans[62].farthest, 63.0);
  EXPECT_DOUBLE_EQ(spans[63].nearest, 64.0);
  EXPECT_DOUBLE_EQ(spans[63].farthest, 80.0);
}

TEST(VisibleRange, TrianglesAreClipped) {
  // A floor from behind the camera to 40 m, 1 m below: seen from where the lower side of a 90 degree view meets it.
  Scene scene;
  engine::Primitive floor;
  floor.positions = {{-50, -1, 10}, {50, -1, 10}, {50, -1, -40}, {-50, -1, -40}};
  floor.indices = {0, 1, 2, 0, 2, 3};
  scene.primitives.push_back(floor);
  scene.instances.push_back({.primitive = 0, .worldFromObject = glm::dmat4(1.0), .name = ""});
  const auto range = visibleRange(scene, camera90(), 100, 100, {}, 1.0);
  EXPECT_NEAR(range.nearestDepth, 1.0, 1e-9);
  EXPECT_NEAR(range.farthestDepth, 40.0, 1e-9);
}

TEST(VisibleRange, IsInMetres) {
  Scene scene;
  addSquare(scene, 200.0, 0.0, 10.0);
  EXPECT_DOUBLE_EQ(visibleRange(scene, camera90(), 100, 100, {}, 0.01).nearestDepth, 2.0);
}

}  // namespace

}  // namespace lensgraph
