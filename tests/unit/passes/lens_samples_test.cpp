// Patterns and aperture shapes: uniform, of low discrepancy, inside the shape, the same every time.
#include "passes/lens/lens_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <set>

namespace lensgraph {

namespace {

using passes::LensPattern;
using shared::ApertureShape;
constexpr double kPi = std::numbers::pi;
constexpr std::array kPatterns = {LensPattern::sobol, LensPattern::halton, LensPattern::r2};

ApertureShape disc() {
  ApertureShape shape{};
  shape.anamorphicRatio = 1.0f;
  return shape;
}

ApertureShape polygon(uint32_t blades, float curvature = 0.0f, float rotation = 0.0f) {
  ApertureShape shape = disc();
  shape.bladeCount = blades;
  shape.bladeCurvature = curvature;
  shape.bladeRotation = rotation;
  return shape;
}

std::vector<passes::LensSample> sobolSamples(const ApertureShape& shape, uint32_t count) {
  return passes::lensSamples(shape, LensPattern::sobol, count, true);
}

double meanOf(const std::vector<passes::LensSample>& samples, const std::function<double(double, double)>& f) {
  double sum = 0.0;
  for (const auto& s : samples) sum += f(static_cast<double>(s.v.x), static_cast<double>(s.v.y));
  return sum / static_cast<double>(samples.size());
}

// The corner polygon of an aperture, y up, and whether a point lies in it (convex, counter-clockwise).
bool insidePolygon(uint32_t blades, double rotation, double x, double y, double margin) {
  for (uint32_t k = 0; k < blades; ++k) {
    const double middle = rotation + kPi / 2 + (2.0 * k + 1.0) * kPi / blades;
    if (x * std::cos(middle) + y * std::sin(middle) > std::cos(kPi / blades) + margin) return false;
  }
  return true;
}

TEST(LensSamples, TheDiscHasTheMomentsOfADisc) {
  for (const auto pattern : kPatterns) {
    const auto samples = passes::lensSamples(disc(), pattern, 4096, true);
    EXPECT_NEAR(meanOf(samples, [](double x, double) { return x; }), 0.0, 2e-3);
    EXPECT_NEAR(meanOf(samples, [](double, double y) { return y; }), 0.0, 2e-3);
    EXPECT_NEAR(meanOf(samples, [](double x, double y) { return x * x + y * y; }), 0.5, 2e-3);
    EXPECT_NEAR(meanOf(samples, [](double x, double) { return x * x; }), 0.25, 2e-3);
    EXPECT_NEAR(meanOf(samples, [](double x, double y) { return x * y; }), 0.0, 2e-3);
    EXPECT_NEAR(meanOf(samples, [](double x, double y) { return std::pow(x * x + y * y, 2); }), 1.0 / 3.0, 2e-3);
    EXPECT_LE(meanOf(samples, [](double x, double y) { return std::hypot(x, y) > 1.0 + 1e-7 ? 1.0 : 0.0; }), 0.0);
  }
}

// The share of samples in any smaller circle, off centre too, is its share of the area: no holes, no clumps.
TEST(LensSamples, TheDiscIsCoveredEvenly) {
  for (const auto pattern : kPatterns) {
    const auto samples = passes::lensSamples(disc(), pattern, 4096, true);
    for (const auto& [cx, cy, r] : {std::array{0.0, 0.0, 0.5}, std::array{0.3, -0.4, 0.3}, std::array{-0.6, 0.1, 0.25},
                                    std::array{0.0, 0.7, 0.2}}) {
      const auto in = [&](double x, double y) { return std::hypot(x - cx, y - cy) < r ? 1.0 : 0.0; };
      EXPECT_NEAR(meanOf(samples, in), r * r, 6e-3) << static_cast<int>(pattern) << ' ' << cx << ' ' << cy;
    }
  }
}

TEST(LensSamples, SmoothIntegrandsConvergeLikeOneOverN) {
  // ∫ exp(x) over the unit disc / π = 2 I_1(1).
  const double exact = 2.0 * std::cyl_bessel_i(1.0, 1.0);
  for (const auto pattern : kPatterns) {
    const auto error = [&](uint32_t count) {
      const auto samples = passes::lensSamples(disc(), pattern, count, true);
      return std::abs(meanOf(samples, [](double x, double) { return std::exp(x); }) - exact);
    };
    // N·error stays bounded where random points, σ = 0.55/√N, reach 35 at 4096 and 140 at 65536.
    const double bound = pattern == LensPattern::sobol ? 0.5 : pattern == LensPattern::halton ? 2.0 : 6.5;
    for (const uint32_t count : {256u, 1024u, 4096u, 16384u, 65536u}) {
      EXPECT_LT(count * error(count), bound) << static_cast<int>(pattern) << ' ' << count;
    }
  }
}

TEST(LensSamples, SobolLensPointsFillEveryElementaryInterval) {
  for (uint32_t log = 0; log <= 10; ++log) {
    for (uint32_t first = 0; first < 3; ++first) {
      for (uint32_t xBits = 0; xBits <= log; ++xBits) {
        std::set<std::pair<uint32_t, uint32_t>> cells;
        for (uint32_t i = 0; i < (1u << log); ++i) {
          const auto u = passes::patternPoint(LensPattern::sobol, (first << log) + i);
          cells.insert({static_cast<uint32_t>(std::ldexp(u[0], static_cast<int>(xBits))),
                        static_cast<uint32_t>(std::ldexp(u[1], static_cast<int>(log - xBits)))});
        }
        EXPECT_EQ(cells.size(), 1u << log) << log << ' ' << xBits;
      }
    }
  }
}

// Pixel offsets spread evenly over the pixel, and tell nothing about the lens point.
TEST(LensSamples, PixelOffsetsAreUniformAndIndependentOfTheLens) {
  for (const auto pattern : kPatterns) {
    const auto samples = passes::lensSamples(disc(), pattern, 4096, true);
    double sumX = 0, sumXX = 0, worst = 0;
    std::array<std::array<double, 2>, 2> cross{};
    for (const auto& s : samples) {
      ASSERT_GE(s.pixelOffset.x, -0.5f);
      ASSERT_LT(s.pixelOffset.x, 0.5f);
      ASSERT_GE(s.pixelOffset.y, -0.5f);
      ASSERT_LT(s.pixelOffset.y, 0.5f);
      const std::array v = {static_cast<double>(s.v.x), static_cast<double>(s.v.y)};
      const std::array j = {static_cast<double>(s.pixelOffset.x), static_cast<double>(s.pixelOffset.y)};
      sumX += j[0];
      sumXX += j[0] * j[0];
      for (std::size_t a = 0; a < 2; ++a) {
        for (std::size_t b = 0; b < 2; ++b) cross[a][b] += v[a] * j[b];
      }
    }
    const auto n = static_cast<double>(samples.size());
    for (const auto& row : cross) {
      for (const double c : row) worst = std::max(worst, std::abs(c / n));
    }
    EXPECT_NEAR(sumX / n, 0.0, 2e-3);
    EXPECT_NEAR(sumXX / n, 1.0 / 12.0, 2e-3);
    EXPECT_LT(worst, 3e-3);  // 0.144 would be full correlation.
  }
}

TEST(LensSamples, WithoutJitterEverySampleLooksThroughThePixelsCentre) {
  for (const auto& s : passes::lensSamples(disc(), LensPattern::r2, 64, false)) {
    EXPECT_EQ(s.pixelOffset, (shared::vec2{0.0f, 0.0f}));
  }
}

TEST(LensSamples, PointsDiffer) {
  for (const auto pattern : kPatterns) {
    std::set<std::pair<float, float>> points;
    for (const auto& s : passes::lensSamples(disc(), pattern, 65536, true)) points.insert({s.v.x, s.v.y});
    EXPECT_EQ(points.size(), 65536u);
  }
}

TEST(LensSamples, ALargerSetContinuesASmallerOne) {
  auto shape = polygon(7, 0.4f);
  shape.sphericalAberration = 0.5f;
  for (const auto pattern : kPatterns) {
    const auto few = passes::lensSamples(shape, pattern, 37, true);
    const auto many = passes::lensSamples(shape, pattern, 1000, true);
    for (std::size_t i = 0; i < few.size(); ++i) {
      EXPECT_EQ(few[i].v, many[i].v);
      EXPECT_EQ(few[i].pixelOffset, many[i].pixelOffset);
    }
  }
}

// Fixed numbers: a change of the patterns changes every reference picture and must not happen by accident.
TEST(LensSamples, HaltonIsHalton) {
  const auto first = passes::patternPoint(LensPattern::halton, 0);
  const auto sixth = passes::patternPoint(LensPattern::halton, 5);
  EXPECT_DOUBLE_EQ(first[0], 1.0 / 2.0);
  EXPECT_DOUBLE_EQ(first[3], 1.0 / 7.0);
  EXPECT_DOUBLE_EQ(sixth[0], 3.0 / 8.0);
  EXPECT_DOUBLE_EQ(sixth[1], 2.0 / 9.0);
  EXPECT_DOUBLE_EQ(sixth[2], 6.0 / 25.0);
  EXPECT_DOUBLE_EQ(sixth[3], 6.0 / 7.0);
}

TEST(LensSamples, TheRecurrenceStepsByThePlasticNumber) {
  const auto first = passes::patternPoint(LensPattern::r2, 0);
  const auto second = passes::patternPoint(LensPattern::r2, 1);
  const auto step = [&](std::size_t d) { return second[d] - first[d] + (second[d] < first[d] ? 1.0 : 0.0); };
  EXPECT_NEAR(std::pow(step(0), -3), 1.0 / step(0) + 1.0, 1e-14);  // ρ³ = ρ + 1
  EXPECT_NEAR(step(1), step(0) * step(0), 1e-15);
}

TEST(LensSamples, PolygonsAreFilledAndNotLeft) {
  for (const uint32_t blades : {3u, 5u, 6u, 8u, 16u}) {
    const auto samples = sobolSamples(polygon(blades, 0.0f, 0.3f), 8192);
    for (const auto& s : samples) {
      ASSERT_TRUE(insidePolygon(blades, static_cast<double>(0.3f), static_cast<double>(s.v.x),
                                -static_cast<double>(s.v.y), 1e-6));
    }
    // ⟨|v|²⟩ of a regular polygon of circumradius 1: (2 + cos(2π/n))/6.
    EXPECT_NEAR(meanOf(samples, [](double x, double y) { return x * x + y * y; }),
                (2.0 + std::cos(2 * kPi / blades)) / 6.0, 1e-3);
    // Scaled by 1/2 it holds a quarter of the points.
    const double quarter = meanOf(samples, [&](double x, double y) {
      return insidePolygon(blades, static_cast<double>(0.3f), 2 * x, -2 * y, 0.0) ? 1.0 : 0.0;
    });
    EXPECT_NEAR(quarter, 0.25, 3e-3) << blades;
  }
}

// The share of samples in a small circle gives the aperture's area: the density is 1/area everywhere inside.
double areaBySamples(const ApertureShape& shape, double cx, double cy, double r) {
  const auto samples = sobolSamples(shape, 65536);
  return kPi * r * r / meanOf(samples, [&](double x, double y) { return std::hypot(x - cx, y - cy) < r ? 1.0 : 0.0; });
}

TEST(LensSamples, CurvedBladesAreArcsThroughTheirCorners) {
  for (const uint32_t blades : {3u, 6u}) {
    for (const float curvature : {1e-5f, 1e-3f, 0.3f, 0.7f, 1.0f}) {
      // Polygon plus one circular segment of radius 1/curvature per blade.
      const double k = static_cast<double>(curvature), s = std::sin(kPi / blades);
      const double half = std::asin(s * k);
      const double segments = blades * (half - std::sin(half) * std::cos(half)) / (k * k);
      const double area = 0.5 * blades * std::sin(2 * kPi / blades) + segments;
      const auto shape = polygon(blades, curvature);
      EXPECT_NEAR(areaBySamples(shape, 0.0, 0.0, 0.3) / area, 1.0, 0.01) << blades << ' ' << curvature;
      EXPECT_NEAR(areaBySamples(shape, 0.2, 0.1, 0.2) / area, 1.0, 0.02) << blades << ' ' << curvature;
    }
  }
}

TEST(LensSamples, FullCurvatureIsTheDisc) {
  for (uint32_t i = 0; i < 200; ++i) {
    const auto u = passes::patternPoint(LensPattern::r2, i);
    const auto round = passes::aperturePoint(disc(), u[0], u[1]);
    const auto bladed = passes::aperturePoint(polygon(5, 1.0f), u[0], u[1]);
    EXPECT_NEAR(std::hypot(round.x, round.y), std::hypot(bladed.x, bladed.y), 1e-6f);
  }
}

// At rotation 0 a corner points up: y is down, so the triangle's tip is at (0, -1) and its base lies below
// the centre.
TEST(LensSamples, TheTriangleStandsUpright) {
  const auto samples = sobolSamples(polygon(3), 4096);
  float top = 0, bottom = 0, left = 0, right = 0;
  for (const auto& s : samples) {
    top = std::min(top, s.v.y);
    bottom = std::max(bottom, s.v.y);
    left = std::min(left, s.v.x);
    right = std::max(right, s.v.x);
  }
  EXPECT_NEAR(top, -1.0f, 0.05f);
  EXPECT_NEAR(bottom, 0.5f, 0.02f);
  EXPECT_NEAR(left, -0.866f, 0.05f);
  EXPECT_NEAR(right, 0.866f, 0.05f);
}

TEST(LensSamples, RotationIsCounterClockwiseInThePicture) {
  const auto upright = passes::aperturePoint(polygon(3), 0.9, 0.4);
  const auto turned = passes::aperturePoint(polygon(3, 0.0f, 0.5f), 0.9, 0.4);
  const double before = std::atan2(-upright.y, upright.x), after = std::atan2(-turned.y, turned.x);
  EXPECT_NEAR(std::remainder(after - before, 2 * kPi), 0.5, 1e-5);
}

TEST(LensSamples, TheAnamorphicRatioStretchesAndKeepsTheArea) {
  auto shape = disc();
  shape.anamorphicRatio = 2.0f;
  const auto samples = sobolSamples(shape, 4096);
  const double xx = meanOf(samples, [](double x, double) { return x * x; });
  const double yy = meanOf(samples, [](double, double y) { return y * y; });
  EXPECT_NEAR(std::sqrt(xx / yy), 2.0, 0.01);
  EXPECT_NEAR(std::sqrt(xx * yy), 0.25, 1e-3);
  EXPECT_NEAR(shared::apertureReach(shape), std::sqrt(2.0f), 1e-6f);
}

TEST(LensSamples, TheGaussianHasUnitVarianceAndStaysFinite) {
  auto shape = disc();
  shape.gaussian = 1;
  for (const auto pattern : kPatterns) {
    const auto samples = passes::lensSamples(shape, pattern, 65536, true);
    EXPECT_NEAR(meanOf(samples, [](double x, double) { return x; }), 0.0, 3e-3);
    EXPECT_NEAR(meanOf(samples, [](double x, double) { return x * x; }), 1.0, 5e-3);
    EXPECT_NEAR(meanOf(samples, [](double x, double) { return x * x * x * x; }), 3.0, 0.05);
    EXPECT_NEAR(meanOf(samples, [](double x, double y) { return x * x * y * y; }), 1.0, 0.03);
  }
  for (const double corner : {0.0, 0x1.fffffffffffffp-1}) {
    const auto v = passes::aperturePoint(shape, corner, corner);
    EXPECT_TRUE(std::isfinite(v.x) && std::isfinite(v.y));
  }
}

TEST(LensSamples, AberrationWeightsHaveMeanOneAndMoveLight) {
  for (const uint32_t blades : {0u, 3u, 7u}) {
    for (const float aberration : {-1.0f, -0.4f, 0.0f, 1.0f}) {
      auto shape = polygon(blades, 0.3f);
      shape.sphericalAberration = aberration;
      shape.anamorphicRatio = 1.5f;
      const auto samples = sobolSamples(shape, 4096);
      double sum = 0, raw = 0, radial = 0;
      for (const auto& s : samples) {
        ASSERT_GE(s.weight, 0.0f);
        const double rho2 = static_cast<double>(shared::apertureRadiusSquared(shape, s.v));
        ASSERT_LE(rho2, 1.0 + 1e-5);
        sum += static_cast<double>(s.weight);
        raw += static_cast<double>(shared::apertureRingWeight(shape, s.v));
        radial += static_cast<double>(s.weight) * rho2;
      }
      const auto n = static_cast<double>(samples.size());
      EXPECT_NEAR(sum / n, 1.0, 1e-6);
      EXPECT_NEAR(raw / n, 1.0, 2e-3) << "before normalisation";
      EXPECT_NEAR(radial / n, 0.5 + static_cast<double>(aberration) / 6.0, 2e-3);  // ∫ρ²(1 + a(2ρ² - 1))
    }
  }
}

TEST(LensSamples, ALoneSampleAlwaysCounts) {
  auto shape = disc();
  shape.sphericalAberration = 1.0f;
  EXPECT_EQ(passes::lensSamples(shape, LensPattern::r2, 1, true)[0].weight, 1.0f);
  EXPECT_TRUE(passes::lensSamples(shape, LensPattern::r2, 0, true).empty());
}

TEST(Aperture, CatsEyeIsTheOverlapOfTwoDiscs) {
  auto shape = disc();
  shape.opticalVignetting = 1.0f;
  const auto samples = sobolSamples(shape, 65536);
  const auto share = [&](shared::vec2 place) {
    double sum = 0;
    for (const auto& s : samples) sum += static_cast<double>(shared::apertureVignette(shape, s.v, place));
    return sum / static_cast<double>(samples.size());
  };
  EXPECT_EQ(share({0.0f, 0.0f}), 1.0);
  // Two unit discs at distance d overlap in 2 acos(d/2) - d/2 √(4 - d²).
  for (const double d : {0.3, 0.6, 1.0}) {
    const double overlap = 2 * std::acos(d / 2) - d / 2 * std::sqrt(4 - d * d);
    EXPECT_NEAR(share({static_cast<float>(d), 0.0f}), overlap / kPi, 2e-3);
    EXPECT_NEAR(share({0.0f, static_cast<float>(-d)}), overlap / kPi, 2e-3);
  }
  // To the right of the picture the lens loses its right side.
  EXPECT_EQ(shared::apertureVignette(shape, {0.9f, 0.0f}, {0.5f, 0.0f}), 0.0f);
  EXPECT_EQ(shared::apertureVignette(shape, {-0.9f, 0.0f}, {0.5f, 0.0f}), 1.0f);
}

TEST(Aperture, AGaussianLensHasNeitherRingsNorCatsEye) {
  auto shape = disc();
  shape.gaussian = 1;
  shape.opticalVignetting = 1.0f;
  shape.sphericalAberration = 1.0f;
  EXPECT_EQ(shared::apertureWeight(shape, {2.0f, 1.0f}, {0.7f, 0.7f}), 1.0f);
}

}  // namespace

}  // namespace lensgraph
