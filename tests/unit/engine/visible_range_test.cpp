// The depth range of what a camera sees, on scenes whose answer is known.
#include "engine/visible_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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
  EXPECT_TRUE(visibleRange({}, camera90(), 100, 100, 0.0, 1.0).isEmpty);
}

TEST(VisibleRange, HiddenSurfacesCount) {
  Scene scene;
  addSquare(scene, 2.0, 0.0, 50.0);
  addSquare(scene, 7.0, 0.0, 1.0);
  const auto range = visibleRange(scene, camera90(), 100, 100, 0.0, 1.0);
  EXPECT_DOUBLE_EQ(range.nearestDepth, 2.0);
  EXPECT_DOUBLE_EQ(range.farthestDepth, 7.0);
}

TEST(VisibleRange, WhatIsOutsideTheFrustumDoesNotCount) {
  Scene scene;
  addSquare(scene, 5.0, 0.0, 1.0);
  addSquare(scene, 1.0, 1.6, 0.5);    // its edge is at 1.1, the frustum's side at 1.0
  addSquare(scene, -3.0, 0.0, 10.0);  // behind the camera
  addSquare(scene, 0.05, 0.0, 10.0);  // in front of the near plane
  const auto range = visibleRange(scene, camera90(), 100, 100, 0.0, 1.0);
  EXPECT_DOUBLE_EQ(range.nearestDepth, 5.0);
  EXPECT_DOUBLE_EQ(range.farthestDepth, 5.0);
  // 100 px are 2 m wide at depth 1: 6 px more on each side reach to 1.12.
  EXPECT_DOUBLE_EQ(visibleRange(scene, camera90(), 100, 100, 6.0, 1.0).nearestDepth, 1.0);
}

TEST(VisibleRange, TrianglesAreClipped) {
  // A floor from behind the camera to 40 m, 1 m below: seen from where the lower side of a 90 degree view meets it.
  Scene scene;
  engine::Primitive floor;
  floor.positions = {{-50, -1, 10}, {50, -1, 10}, {50, -1, -40}, {-50, -1, -40}};
  floor.indices = {0, 1, 2, 0, 2, 3};
  scene.primitives.push_back(floor);
  scene.instances.push_back({.primitive = 0, .worldFromObject = glm::dmat4(1.0), .name = ""});
  const auto range = visibleRange(scene, camera90(), 100, 100, 0.0, 1.0);
  EXPECT_NEAR(range.nearestDepth, 1.0, 1e-9);
  EXPECT_NEAR(range.farthestDepth, 40.0, 1e-9);
}

TEST(VisibleRange, IsInMetres) {
  Scene scene;
  addSquare(scene, 200.0, 0.0, 10.0);
  EXPECT_DOUBLE_EQ(visibleRange(scene, camera90(), 100, 100, 0.0, 0.01).nearestDepth, 2.0);
}

}  // namespace
