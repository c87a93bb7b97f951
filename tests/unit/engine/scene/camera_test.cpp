// The camera's matrices against points whose place in the picture is known.
#include "engine/scene/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "engine/error.h"

namespace lensgraph {

namespace {

using engine::Camera;
using engine::cameraFromLookAt;
using engine::LookAt;

glm::dvec3 viewPoint(const Camera& camera, const glm::dvec3& world) {
  return glm::dvec3(camera.viewFromWorld * glm::dvec4(world, 1.0));
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

std::string errorOf(const LookAt& lookAt) {
  try {
    cameraFromLookAt(lookAt);
  } catch (const engine::Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Camera, DefaultLooksDownMinusZ) {
  const Camera camera = cameraFromLookAt({});
  expectNear(viewPoint(camera, {1.0, 2.0, -3.0}), {1.0, 2.0, -3.0}, 1e-15);
}

TEST(Camera, TargetLiesOnTheAxisAndUpPointsUp) {
  const Camera camera = cameraFromLookAt({.position = {1, 2, 3}, .target = {4, 2, 3}, .up = {0, 5, 0}});
  expectNear(viewPoint(camera, {4, 2, 3}), {0, 0, -3}, 1e-14);
  expectNear(viewPoint(camera, {4, 3, 3}), {0, 1, -3}, 1e-14);
  expectNear(viewPoint(camera, {4, 2, 4}), {1, 0, -3}, 1e-14);  // right of a camera that looks along +X is +Z
  expectNear(camera.position(), {1, 2, 3}, 1e-14);
}

TEST(Camera, ViewIsRigidForATiltedUp) {
  const Camera camera = cameraFromLookAt({.position = {1, 2, 3}, .target = {-4, 7, 1}, .up = {0.3, 1, 0.2}});
  const glm::dmat3 rotation(camera.viewFromWorld);
  const glm::dmat3 product = rotation * glm::transpose(rotation);
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) EXPECT_NEAR(product[c][r], c == r ? 1.0 : 0.0, 1e-14);
  }
  EXPECT_NEAR(glm::determinant(rotation), 1.0, 1e-14);
}

TEST(Camera, KeepsMicrometresAtAMillionMetres) {
  const Camera camera = cameraFromLookAt({.position = {1e6, 1e6, 1e6}, .target = {1e6, 1e6, 1e6 - 1}});
  expectNear(viewPoint(camera, {1e6 + 1e-3, 1e6, 1e6 - 2}), {1e-3, 0, -2}, 1e-8);
}

TEST(Camera, AcceptsExtremeDistancesBetweenPositionAndTarget) {
  expectNear(viewPoint(cameraFromLookAt({.target = {0, 0, -1e200}}), {0, 0, -5}), {0, 0, -5}, 1e-12);
  expectNear(viewPoint(cameraFromLookAt({.target = {0, 0, -1e-200}}), {0, 0, -5}), {0, 0, -5}, 1e-12);
}

TEST(Camera, RefusesWhatHasNoDirection) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(errorOf({.position = {1, 1, 1}, .target = {1, 1, 1}}),
              testing::StartsWith("camera.target: is the camera's position"));
  EXPECT_THAT(errorOf({.up = {0, 0, 0}}), testing::StartsWith("camera.up: is zero"));
  EXPECT_THAT(errorOf({.up = {0, 0, 3}}), testing::StartsWith("camera.up: is parallel"));
  EXPECT_THAT(errorOf({.up = {0, 1e-7, 1}}), testing::StartsWith("camera.up: is parallel"));
  EXPECT_EQ(errorOf({.up = {0, 1e-5, 1}}), "no error");
  EXPECT_THAT(errorOf({.position = {nan, 0, 0}}), testing::StartsWith("camera.position: is not finite"));
  EXPECT_EQ(errorOf({.fovyDeg = 0}), "camera.fovyDeg: is 0, must be above 0 and below 180 degrees");
  EXPECT_THAT(errorOf({.fovyDeg = 180}), testing::StartsWith("camera.fovyDeg: "));
  EXPECT_THAT(errorOf({.fovyDeg = nan}), testing::StartsWith("camera.fovyDeg: "));
}

TEST(Camera, PixelsPerTangentMapsTheFieldOfViewToTheHeight) {
  const Camera camera = cameraFromLookAt({.fovyDeg = 90});
  EXPECT_NEAR(engine::pixelsPerTangent(camera, 360), 180.0, 1e-10);
  EXPECT_DOUBLE_EQ(camera.nearPlane, 0.01);
}

TEST(Camera, APositionBeyondWhatFloatsDescribeIsTooFarAway) {
  for (const glm::dvec3 position : {glm::dvec3(0, 1e300, 0), glm::dvec3(0, 0, 1e300), glm::dvec3(-1e31, 0, 0)}) {
    EXPECT_THAT(errorOf({.position = position, .target = {0, 0, 0}}),
                testing::StartsWith("camera.position: is too far away; "));
  }
  EXPECT_EQ(errorOf({.position = {0, 0, 1e29}, .target = {0, 0, 0}}), "no error");
}

}  // namespace

}  // namespace lensgraph
