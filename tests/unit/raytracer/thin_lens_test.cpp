// Blur of lights and edges against the thin lens in closed form: size, profile, shape.
#include <gmock/gmock.h>

#include <vector>

#include "traced.h"

namespace lensgraph::test {
namespace {

using std::numbers::pi;

/// A light large enough for many rays to meet it. Its variance per axis and the pixel's add to the blur's.
constexpr double kSide = 8.0, kSquares = (kSide * kSide + 1.0) / 12.0;
constexpr uint32_t kSamples = 512;
constexpr double kFar = 20.0, kNear = 1.2;

class RayTracedLens : public testing::Test {
 protected:
  RayTracedLens() { view_.lens.apertureRadius = 0.4; }
  Moments spot(double depth, double x = 0.0, double y = 0.0) const {
    return momentsOf(trace(lightScene(view_, depth, kSide, x, y), view_, kSamples).color);
  }
  engine::RayTracedView view_ = smallView(48, 48);
};

TEST_F(RayTracedLens, ALightBehindOrBeforeTheFocusBecomesADiscOfTheThinLensRadius) {
  for (const double depth : {kNear, kFar}) {
    const Moments m = spot(depth);
    const double radius = blurRadius(view_, depth);
    ASSERT_GT(radius, 7.0);
    EXPECT_NEAR(m.flux, kSide * kSide, 0.4) << depth;
    EXPECT_NEAR(2.0 * std::sqrt(m.varianceX - kSquares), radius, 0.01 * radius) << depth;
    EXPECT_NEAR(2.0 * std::sqrt(m.varianceY - kSquares), radius, 0.01 * radius) << depth;
  }
}

TEST_F(RayTracedLens, FocusAtInfinityBlursByTheInverseOfTheDepth) {
  view_.lens.focusDistance = std::numeric_limits<double>::infinity();
  const double radius = pixelsPerTangent(view_) * 0.4 / 2.5;
  EXPECT_NEAR(2.0 * std::sqrt(spot(2.5).varianceX - kSquares), radius, 0.01 * radius);
}

TEST_F(RayTracedLens, ABreathingLensHasTheFieldOfViewOfItsImageDistance) {
  view_.lens.focusDistance = 0.5;
  view_.lens.breathing = {.focalLength = 0.1, .sensorHeight = 0.05};
  view_.lens.apertureRadius = 0.0;
  // Image distance 0.125 m: the picture is 0.4 high at 1 m.
  engine::Scene scene;
  addQuad(scene, 1.0, 0.1, 0.0, 0.1, 0.1, addMaterial(scene, {1.0f, 1.0f, 1.0f, 1.0f}));
  const Moments m = momentsOf(trace(scene, view_, 64).color);
  EXPECT_NEAR(m.flux, 24.0 * 24.0, 1.0);
  EXPECT_NEAR(m.x, 36.0, 0.02);
}

// The light that passes an edge is the part of the disc on its bright side.
TEST_F(RayTracedLens, AnEdgeOutOfFocusHasTheProfileOfTheDisc) {
  engine::Scene scene;
  addQuad(scene, 20.0, 50.0, 0.0, 50.0, 50.0, addMaterial(scene, {1.0f, 1.0f, 1.0f, 1.0f}));
  const auto picture = trace(scene, view_, 256).color;
  const double radius = blurRadius(view_, kFar);
  const auto share = [&](double x) {
    const double t = std::clamp(x / radius, -1.0, 1.0);
    return 0.5 + (t * std::sqrt(1.0 - t * t) + std::asin(t)) / pi;
  };
  for (uint32_t x = 0; x < picture.width; ++x) {
    double mean = 0.0, expected = 0.0;
    for (uint32_t y = 0; y < picture.height; ++y) mean += static_cast<double>(picture.pixel(x, y)[0]) / picture.height;
    for (int i = 0; i < 16; ++i) expected += share(x + (i + 0.5) / 16.0 - 24.0) / 16.0;
    EXPECT_NEAR(mean, expected, 2e-3) << x;
  }
}

// A triangle has its corner up: the third moment about its centroid tells up from down.
TEST_F(RayTracedLens, ATriangularApertureStandsUprightBehindTheFocusAndInvertedBefore) {
  view_.lens.bladeCount = 3;
  EXPECT_LT(spot(kFar).thirdY, -10.0);  // The long tail points up, where y is small.
  EXPECT_GT(spot(kNear).thirdY, 10.0);
  view_.lens.bladeRotation = pi;
  EXPECT_GT(spot(kFar).thirdY, 10.0);
}

TEST_F(RayTracedLens, BladesHaveTheMomentsOfTheirPolygonAndCurvatureMakesThemRound) {
  view_.lens.bladeCount = 4;
  const double radius = blurRadius(view_, kFar);
  // A square of circumradius r: variance r²/6 on either axis.
  EXPECT_NEAR((spot(kFar).varianceX - kSquares) / (radius * radius), 1.0 / 6.0, 0.002);
  view_.lens.bladeCurvature = 1.0;
  EXPECT_NEAR((spot(kFar).varianceX - kSquares) / (radius * radius), 1.0 / 4.0, 0.003);
}

TEST_F(RayTracedLens, TheAnamorphicRatioIsThatOfWidthToHeightAndKeepsTheArea) {
  view_.lens.anamorphicRatio = 2.0;
  const Moments m = spot(kFar);
  const double radius = blurRadius(view_, kFar), x = m.varianceX - kSquares, y = m.varianceY - kSquares;
  EXPECT_NEAR(std::sqrt(x / y), 2.0, 0.02);
  EXPECT_NEAR(4.0 * std::sqrt(x * y), radius * radius, 0.01 * radius * radius);
}

// Mean of ρ² under the weight 1 + a (2ρ² - 1) is 1/2 + a/6.
TEST_F(RayTracedLens, SphericalAberrationMovesLightToTheRimOrTheCenter) {
  const double squared = std::pow(blurRadius(view_, kFar), 2.0);
  for (const double a : {-1.0, 0.5, 1.0}) {
    view_.lens.sphericalAberration = a;
    const Moments m = spot(kFar);
    EXPECT_NEAR((m.varianceX - kSquares) / squared, 0.25 * (1.0 + a / 3.0), 0.004) << a;
    EXPECT_NEAR(m.flux, kSide * kSide, 0.8) << a;
  }
}

// The cat's eye cuts the side away from the picture's center; each pixel keeps the mean over what is left of its lens.
TEST_F(RayTracedLens, TheCatsEyeCutsTheSideAwayFromTheCenter) {
  view_.lens.apertureRadius = 0.2;
  const Moments whole = spot(kFar, 14.0, 14.0);
  view_.lens.opticalVignetting = 1.0;
  const Moments cut = spot(kFar, 14.0, 14.0);
  EXPECT_LT(cut.x, whole.x - 0.5);
  EXPECT_LT(cut.y, whole.y - 0.5);
  EXPECT_NEAR(spot(kFar).x, 24.0, 0.1);
}

TEST_F(RayTracedLens, AUnitOfCentimetresGivesThePictureOfMetres) {
  const auto metres = trace(lightScene(view_, 20.0, kSide), view_, 64);
  auto scene = lightScene(view_, 20.0, kSide);
  for (auto& position : scene.primitives[0].positions) position *= 100.0f;
  view_.viewpoint.metersPerUnit = 0.01;
  const auto centimetres = trace(scene, view_, 64);
  EXPECT_NEAR(momentsOf(centimetres.color).varianceX, momentsOf(metres.color).varianceX, 1e-3);
  EXPECT_NEAR(centimetres.depth.pixel(24, 24)[0], 20.0f, 1e-4f);
}

// What each filter gives a pixel of a light that covers exactly it, and of one a quarter of a pixel to the right.
TEST(RayTracedFilter, EachFilterWeighsThePixelAndItsNeighborhoodAsItSays) {
  auto view = smallView(8, 8);
  view.lens.apertureRadius = 0.0;
  const auto pixel = [&](engine::PixelFilter filter, double shift) {
    return trace(lightScene(view, 2.0, 1.0, 0.5 + shift, 0.5), view, 4096, filter).color.pixel(4, 4)[0];
  };
  EXPECT_NEAR(pixel(engine::PixelFilter::box, 0.0), 1.0, 1e-3);
  EXPECT_NEAR(pixel(engine::PixelFilter::box, 0.25), 0.75, 1e-3);
  EXPECT_NEAR(pixel(engine::PixelFilter::tent, 0.0), std::pow(3.0 / 4.0, 2.0), 2e-3);
  EXPECT_NEAR(pixel(engine::PixelFilter::gauss, 0.0), std::pow(std::erf(std::sqrt(0.5)), 2.0), 4e-3);
  EXPECT_EQ(pixel(engine::PixelFilter::point, 0.25), 1.0f);
}

}  // namespace
}  // namespace lensgraph::test
