// The aperture's shape in the picture: moments, areas and outlines of a point light's blur, known in closed
// form.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/spot.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSide = 96;
constexpr double kDepth = 20.0;
/// Variance that the light and the pixel, squares of 1 px, add to either axis.
constexpr double kSquares = 2.0 / 12.0;

class ApertureShape : public support::GpuTest {
 protected:
  ApertureShape() : shot_(support::smallShot(kSide, kSide)) { shot_.lens.apertureRadius = 0.5; }

  double radius() const { return std::abs(support::thinLensRadius(shot_, kDepth)); }

  /// The light `x`, `y` px from the picture's middle, through `samples` points of the lens.
  engine::FloatImage blur(double x = 0.0, double y = 0.0, bool gaussian = false, int64_t samples = 1024) {
    host::Renderer renderer(support::device(), support::lightScene(kDepth, 1.0, support::pixelsPerTangent(shot_), x, y),
                            std::nullopt);
    return support::render(renderer, shot_, "accumulation",
                           {{"lensSamples", samples}, {"viewsPerFrame", int64_t{64}}, {"gaussian", gaussian}})
        .color;
  }

  /// Area of a blur of even brightness, px²: all its light over the brightness near its middle.
  static double areaOf(const engine::FloatImage& picture, double coreRadius) {
    const auto spot = support::measureSpot(picture);
    double core = 0.0;
    int pixels = 0;
    for (uint32_t y = 0; y < picture.height; ++y) {
      for (uint32_t x = 0; x < picture.width; ++x) {
        if (std::hypot(x + 0.5 - spot.x, y + 0.5 - spot.y) > coreRadius) continue;
        core += static_cast<double>(picture.pixel(x, y)[0]);
        ++pixels;
      }
    }
    return spot.flux * pixels / core;
  }

  host::Shot shot_;
};

TEST_F(ApertureShape, TheDiscHasItsAreaAndMoments) {
  const auto picture = blur();
  const auto spot = support::measureSpot(picture);
  const double r2 = radius() * radius();
  EXPECT_NEAR(spot.flux, 100.0, 1.0);
  EXPECT_NEAR(spot.varianceX - kSquares, r2 / 4.0, 0.01 * r2 / 4.0);
  EXPECT_NEAR(spot.varianceY - kSquares, r2 / 4.0, 0.01 * r2 / 4.0);
  EXPECT_NEAR(areaOf(picture, 0.5 * radius()), kPi * r2, 0.03 * kPi * r2);
}

TEST_F(ApertureShape, AnamorphicRatioTwoIsTwiceAsWideAsHighWithTheSameArea) {
  shot_.lens.anamorphicRatio = 2.0;
  const auto picture = blur();
  const auto spot = support::measureSpot(picture);
  const double x = spot.varianceX - kSquares, y = spot.varianceY - kSquares;
  EXPECT_NEAR(std::sqrt(x / y), 2.0, 0.02);
  EXPECT_NEAR(4.0 * std::sqrt(x * y), radius() * radius(), 0.01 * radius() * radius());
  EXPECT_NEAR(areaOf(picture, 0.4 * radius()), kPi * radius() * radius(), 0.03 * kPi * radius() * radius());
  EXPECT_NEAR(spot.covariance, 0.0, 0.01 * x);
}

TEST_F(ApertureShape, TheHexagonHasItsAreaMomentsAndCorners) {
  shot_.lens.bladeCount = 6;
  const auto picture = blur();
  support::keepPicture(picture, "hexagon");
  const auto spot = support::measureSpot(picture);
  const double r = radius();
  // Corners on the circle of radius r: area 3√3/2 r², variance 5/24 r² in every direction.
  const double area = 1.5 * std::sqrt(3.0) * r * r, variance = 5.0 / 24.0 * r * r;
  EXPECT_NEAR(areaOf(picture, 0.5 * r), area, 0.03 * area);
  EXPECT_NEAR(spot.varianceX - kSquares, variance, 0.01 * variance);
  EXPECT_NEAR(spot.varianceY - kSquares, variance, 0.01 * variance);
  // One corner up: as high as the circle, narrower by cos 30°.
  double width = 0.0, height = 0.0;
  for (uint32_t y = 0; y < picture.height; ++y) {
    for (uint32_t x = 0; x < picture.width; ++x) {
      if (picture.pixel(x, y)[0] == 0.0f) continue;
      width = std::max(width, std::abs(x + 0.5 - spot.x));
      height = std::max(height, std::abs(y + 0.5 - spot.y));
    }
  }
  EXPECT_NEAR(width, r * std::cos(kPi / 6.0), 1.5);
  EXPECT_NEAR(height, r, 1.5);
}

// Weights 1 ± (2ρ² - 1) with ρ² uniform: mean ρ² is 2/3 and 1/3 in place of 1/2.
TEST_F(ApertureShape, SphericalAberrationMovesLightToTheRimOrTheCentre) {
  const double r2 = radius() * radius();
  shot_.lens.sphericalAberration = 1.0;
  const auto rim = support::measureSpot(blur());
  shot_.lens.sphericalAberration = -1.0;
  const auto centre = support::measureSpot(blur());
  EXPECT_NEAR(rim.varianceX + rim.varianceY - 2.0 * kSquares, 2.0 / 3.0 * r2, 0.01 * r2);
  EXPECT_NEAR(centre.varianceX + centre.varianceY - 2.0 * kSquares, 1.0 / 3.0 * r2, 0.01 * r2);
  EXPECT_NEAR(rim.flux, centre.flux, 0.01 * rim.flux);
}

TEST_F(ApertureShape, TheGaussianLensHasTheLensRadiusAsItsSigma) {
  shot_.lens.apertureRadius = 0.15;  // 5 σ stay in the picture.
  const double sigma = radius();
  ASSERT_LT(5.0 * sigma, 0.5 * kSide);
  const auto spot = support::measureSpot(blur(0.0, 0.0, true));
  EXPECT_NEAR(std::sqrt(spot.varianceX - kSquares), sigma, 0.01 * sigma);
  EXPECT_NEAR(std::sqrt(spot.varianceY - kSquares), sigma, 0.01 * sigma);
  EXPECT_GT(spot.extent, 2.5 * sigma);
}

TEST_F(ApertureShape, CatsEyeCutsBokehInTheCornersAndLeavesTheMiddleRound) {
  shot_.lens.apertureRadius = 0.15;
  const double r = radius();
  const auto lit = [](const engine::FloatImage& picture) {
    int pixels = 0;  // Not those that only the faint weight of shut lens points reaches (1e-12).
    for (std::size_t i = 0; i < picture.pixelCount(); ++i) pixels += picture.samples[i * 4] > 1e-6f ? 1 : 0;
    return pixels;
  };
  constexpr double kPlace = 34.0;  // px right of and below the middle, so half a diagonal is 1
  const auto round = blur(kPlace, kPlace);
  shot_.lens.opticalVignetting = 0.9;
  const auto corner = blur(kPlace, kPlace);
  const auto middle = blur();
  support::keepPicture(corner, "cats_eye");

  const auto inMiddle = support::measureSpot(middle);
  EXPECT_NEAR(inMiddle.varianceX / inMiddle.varianceY, 1.0, 0.02);
  EXPECT_NEAR(inMiddle.covariance / inMiddle.varianceX, 0.0, 0.02);
  EXPECT_NEAR(inMiddle.x, 0.5 * kSide, 0.1);

  // What the barrel leaves: v in the unit disc, and v + vignetting·place too, place of the pixel light + r·v.
  int expected = 0;
  constexpr int kGrid = 400;
  for (int i = 0; i < kGrid; ++i) {
    for (int j = 0; j < kGrid; ++j) {
      const double vx = 2.0 * (i + 0.5) / kGrid - 1.0, vy = 2.0 * (j + 0.5) / kGrid - 1.0;
      const double scale = 0.9 / (0.5 * kSide * std::numbers::sqrt2);
      const double bx = vx + scale * (kPlace + r * vx), by = vy + scale * (kPlace + r * vy);
      if (vx * vx + vy * vy <= 1.0 && bx * bx + by * by <= 1.0) ++expected;
    }
  }
  const double share = expected / (0.25 * kPi * kGrid * kGrid);
  const double measured = static_cast<double>(lit(corner)) / lit(round);
  std::printf("cat's eye: %.3f of the disc's pixels are lit, %.3f of its area is left\n", measured, share);
  EXPECT_NEAR(measured, share, 0.08);
  EXPECT_LT(measured, 0.75);
  // The side away from the middle is cut, so the rest lies nearer to it, longer across the diagonal than
  // along it.
  const auto whole = support::measureSpot(round), cut = support::measureSpot(corner);
  EXPECT_LT(cut.x, whole.x - 0.15 * r);
  EXPECT_LT(cut.y, whole.y - 0.15 * r);
  EXPECT_LT(cut.covariance, -0.2 * cut.varianceX);
}

}  // namespace

}  // namespace lensgraph
