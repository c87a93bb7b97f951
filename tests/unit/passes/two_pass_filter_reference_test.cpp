// The CPU reference of the two-pass filter against values worked out by hand from the paper's formulas.
#include "tests/support/two_pass_filter_reference.h"

#include <gtest/gtest.h>

#include <limits>

namespace lensgraph {

namespace {

using support::RgbzPicture;
using support::TwoPassFilterSettings;

constexpr double kSky = std::numeric_limits<double>::infinity();

/// Focus at 1 m, S·E = 10 px·m: the sky blurs to 10 px, 2 m to 5 px, 0.5 m to -10 px.
TwoPassFilterSettings settings() {
  return {.pixelsPerTangent = 1000.0,
          .apertureRadius = 0.01,
          .focusDistance = 1.0,
          .maxRadius = 64.0,
          .minRadius = 0.5,
          .leakage = 1.0};
}

RgbzPicture row(std::vector<double> gray, std::vector<double> depth) {
  RgbzPicture picture{static_cast<int>(gray.size()), 1, {}, std::move(depth)};
  for (const double g : gray) picture.rgb.push_back({g, g, g});
  return picture;
}

TEST(TwoPassFilterReference, InFocusNothingChanges) {
  const auto out = filterTwoPass(row({1, 0, 5, 2}, {1, 1, 1, 1}), settings());
  EXPECT_EQ(out[0][0], 1.0);
  EXPECT_EQ(out[2][0], 5.0);
}

// A near pixel of radius 2.5 between focused ones: O is 1 at distance 1, 0.5 at 2, 0 at 3; I is 1/2.5²
// against 1/0.5².
TEST(TwoPassFilterReference, ANearPixelSpreadsOverFocusedOnes) {
  const double depth = 1.0 / 1.25;
  const auto out = filterTwoPass(row({0, 0, 0, 8, 0}, {1, 1, 1, depth, 1}), settings());
  const double intensity = 1.0 / 6.25;
  EXPECT_NEAR(out[2][0], 8 * intensity / (4 + intensity), 1e-12);
  EXPECT_NEAR(out[1][0], 8 * 0.5 * intensity / (4 + 0.5 * intensity), 1e-12);
  EXPECT_EQ(out[0][0], 0.0);
}

// The same pixel behind focus: nothing of it may reach a focused pixel.
TEST(TwoPassFilterReference, TheBackgroundDoesNotLeakIntoFocus) {
  const auto out = filterTwoPass(row({0, 0, 0, 8, 0}, {1, 1, 1, 4, 1}), settings());
  EXPECT_EQ(out[2][0], 0.0);
  EXPECT_EQ(out[3][0], 8.0);
}

// A uniform background of radius 1.5: O(1) = 0.5, the centre counts fully; the border repeats itself.
TEST(TwoPassFilterReference, AUniformBlurIsABoxWithSoftEnds) {
  const double depth = 1.0 / 0.85;
  const auto out = filterTwoPass(row({4, 0, 0, 0}, {depth, depth, depth, depth}), settings());
  EXPECT_NEAR(out[0][0], 4 * 1.5 / 2.0, 1e-12);
  EXPECT_NEAR(out[1][0], 4 * 0.5 / 2.0, 1e-12);
  EXPECT_NEAR(out[2][0], 0.0, 1e-12);
}

TEST(TwoPassFilterReference, RadiiAreLimited) {
  auto limited = settings();
  limited.maxRadius = 1.5;
  const auto out = filterTwoPass(row({4, 0, 0, 0}, {kSky, kSky, kSky, kSky}), limited);
  EXPECT_NEAR(out[1][0], 1.0, 1e-12);
}

TEST(TwoPassFilterReference, BothDirectionsAreFiltered) {
  RgbzPicture picture{3, 3, std::vector<std::array<double, 3>>(9), std::vector<double>(9, 1.0 / 0.85)};
  picture.rgb[4] = {16, 0, 0};
  const auto out = filterTwoPass(picture, settings());
  EXPECT_NEAR(out[4][0], 16.0 / 4.0, 1e-12);
  EXPECT_NEAR(out[0][0], 16.0 / 16.0, 1e-12);
}

}  // namespace

}  // namespace lensgraph
