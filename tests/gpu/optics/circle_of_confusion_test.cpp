// The blur of a point light, measured in the picture, against the thin-lens formula; and the orientation of
// the bokeh.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/spot.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph {

namespace {

using support::render;
using support::Spot;

constexpr int kSide = 96;

/// A square light that covers `sidePx` pixels in the pinhole picture, centred.
host::Renderer lightAt(double depth, double sidePx, double pixelsPerTangent) {
  return host::Renderer(support::device(), support::lightScene(depth, sidePx, pixelsPerTangent), std::nullopt);
}

class CircleOfConfusion : public support::GpuTest {};

TEST_F(CircleOfConfusion, APointLightBlursByTheThinLensFormula) {
  auto shot = support::smallShot(kSide, kSide);
  shot.lens.focusDistance = 2.0;
  shot.lens.apertureRadius = 0.2;
  const double s = support::pixelsPerTangent(shot);
  // Both sides of focus, from 1.01 near planes away to practically infinity.
  const double nearPlane = 0.8;
  shot.camera.nearPlane = nearPlane;
  constexpr double kSidePx = 1.0;
  for (const double depth : {1.01 * nearPlane, 1.0, 1.2, 1.4, 1.6, 1.8, 1.9, 2.1, 2.3, 2.7, 3.5, 6.0, 20.0, 1e3, 1e6}) {
    auto renderer = lightAt(depth, kSidePx, s);
    const auto picture = render(renderer, shot, "accumulation", {{"lensSamples", int64_t{256}}});
    const double expected = s * shot.lens.apertureRadius * std::abs(1.0 / shot.lens.focusDistance - 1.0 / depth);
    // The light and the pixel are squares of 1 px: each adds 1/6 px² to the mean squared distance, in both
    // axes.
    const Spot spot = support::measureSpot(picture.color);
    const double radius = std::sqrt(std::max(0.0, spot.radius * spot.radius - 2.0 * 2.0 / 6.0));
    EXPECT_NEAR(radius, expected, std::max(0.01 * expected, 0.25)) << "depth " << depth;
    EXPECT_NEAR(spot.x, 0.5 * kSide, 0.05) << "depth " << depth;
    EXPECT_NEAR(spot.y, 0.5 * kSide, 0.05) << "depth " << depth;
    EXPECT_LE(spot.extent, expected + 2.2) << "depth " << depth;
    RecordProperty("depth_" + std::to_string(depth), std::to_string(radius) + " px of " + std::to_string(expected));
    std::printf("depth %10.4g m: measured %8.4f px, thin lens %8.4f px\n", depth, radius, expected);
  }
}

TEST_F(CircleOfConfusion, VanishesAtFocusAndDoesNotDependOnItElsewhere) {
  auto shot = support::smallShot(kSide, kSide);
  shot.lens.apertureRadius = 0.2;
  const double s = support::pixelsPerTangent(shot);
  auto renderer = lightAt(2.0, 3.0, s);
  const auto picture = render(renderer, shot, "accumulation", {{"lensSamples", int64_t{64}}}).color;
  EXPECT_LT(support::measureSpot(picture).extent, 3.0);
}

/// Third moment of the spot along y: positive when its mass trails upwards (y is down), as an upright
/// triangle's does not.
double skewness(const engine::FloatImage& picture) {
  const Spot spot = support::measureSpot(picture);
  double third = 0.0, sum = 0.0;
  for (uint32_t y = 0; y < picture.height; ++y) {
    for (uint32_t x = 0; x < picture.width; ++x) {
      const double value = double(picture.pixel(x, y)[0]);
      third += value * std::pow(y + 0.5 - spot.y, 3.0);
      sum += value;
    }
  }
  return third / sum;
}

TEST_F(CircleOfConfusion, TriangularApertureIsUprightBehindFocusAndInvertedInFront) {
  auto shot = support::smallShot(kSide, kSide);
  shot.lens.apertureRadius = 0.2;
  shot.lens.bladeCount = 3;
  const double s = support::pixelsPerTangent(shot);
  auto farLight = lightAt(20.0, 1.0, s);
  auto nearLight = lightAt(1.1, 1.0, s);
  const auto farPicture = render(farLight, shot, "accumulation", {{"lensSamples", int64_t{256}}}).color;
  const auto nearPicture = render(nearLight, shot, "accumulation", {{"lensSamples", int64_t{256}}}).color;
  support::keepPicture(farPicture, "triangle_far");
  support::keepPicture(nearPicture, "triangle_near");
  // A triangle with its corner up has its tail towards smaller y.
  EXPECT_LT(skewness(farPicture), -1.0);
  EXPECT_GT(skewness(nearPicture), 1.0);
}

}  // namespace

}  // namespace lensgraph
