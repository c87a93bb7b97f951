// What depth values mean, and samples that no technique can use.
#include "samples/host/picture_inputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lensgraph {

namespace {

using engine::FloatImage;
using host::convertDepth;
using host::DepthFindings;
using host::DepthKind;
using host::DepthMeaning;
using testing::ElementsAre;
using testing::FloatEq;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

FloatImage row(std::vector<float> values) {
  FloatImage image(static_cast<uint32_t>(values.size()), 1, 1);
  image.samples = std::move(values);
  return image;
}

std::vector<float> converted(std::vector<float> values, const DepthMeaning& meaning) {
  FloatImage depth = row(std::move(values));
  convertDepth(depth, meaning, 40.0);
  return depth.samples;
}

TEST(ConvertDepth, WhatIsNotPositiveIsCountedAndInfinitelyFar) {
  FloatImage depth = row({1.0f, 0.0f, -2.0f, kNan, -kInfinity, kInfinity, 1e10f, 3.0f});
  const DepthFindings found = convertDepth(depth, {}, 40.0);
  EXPECT_EQ(found.holes, 4u) << "infinity and 1e10 are the background, no holes";
  EXPECT_THAT(depth.samples, ElementsAre(1.0f, kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, 3.0f));
  EXPECT_EQ(found.nearest, 1.0f);
  EXPECT_EQ(found.farthest, 3.0f);
}

TEST(ConvertDepth, WithoutAnyDepthThereIsNoRange) {
  FloatImage depth = row({0.0f, kInfinity});
  EXPECT_EQ(convertDepth(depth, {}, 40.0).nearest, std::nullopt);
}

TEST(ConvertDepth, AScaleMultiplies) {
  EXPECT_THAT(converted({1500.0f, 0.0f, 1e10f}, {.scale = 0.001}), ElementsAre(FloatEq(1.5f), kInfinity, kInfinity));
}

TEST(ConvertDepth, RaysAreLongerThanTheirPartAlongTheAxis) {
  FloatImage depth(41, 31, 1);
  const double tangent = std::tan(20.0 * M_PI / 180.0);
  for (uint32_t y = 0; y < 31; ++y) {
    for (uint32_t x = 0; x < 41; ++x) {
      const double right = (x - 20.0) / 15.5 * tangent, down = (y - 15.0) / 15.5 * tangent;
      *depth.pixel(x, y) = static_cast<float>(2.0 * std::hypot(right, down, 1.0));
    }
  }
  EXPECT_GT(*depth.pixel(0, 0), 2.2f);
  convertDepth(depth, {.kind = DepthKind::ray}, 40.0);
  for (const float z : depth.samples) ASSERT_NEAR(z, 2.0f, 1e-6f) << "a plane across the axis";
}

TEST(ConvertDepth, DisparityIsTheInverseBetweenItsEnds) {
  DepthMeaning meaning{.kind = DepthKind::disparity, .nearest = 0.5, .farthest = 4.0, .white = 255.0};
  EXPECT_THAT(converted({255.0f, 0.0f, 127.5f}, meaning),
              ElementsAre(FloatEq(0.5f), FloatEq(4.0f), FloatEq(1.0f / 1.125f)));
  meaning.isWhiteNear = false;
  EXPECT_THAT(converted({255.0f, 0.0f}, meaning), ElementsAre(FloatEq(4.0f), FloatEq(0.5f)));
}

TEST(ConvertDepth, DisparityMayEndAtInfinity) {
  FloatImage depth = row({1.0f, 0.5f, 0.0f, -0.1f, kNan});
  const DepthFindings found =
      convertDepth(depth, {.kind = DepthKind::disparity, .nearest = 0.5, .farthest = HUGE_VAL}, 40.0);
  EXPECT_THAT(depth.samples, ElementsAre(0.5f, 1.0f, kInfinity, kInfinity, kInfinity));
  EXPECT_EQ(found.holes, 2u);
}

TEST(ConvertDepth, NormalizedIsLinearBetweenItsEnds) {
  DepthMeaning meaning{
      .kind = DepthKind::normalized, .nearest = 1.0, .farthest = 5.0, .isWhiteNear = false, .white = 65535.0};
  EXPECT_THAT(converted({0.0f, 65535.0f, 32767.5f}, meaning), ElementsAre(1.0f, 5.0f, 3.0f));
  meaning.isWhiteNear = true;
  EXPECT_THAT(converted({0.0f, 65535.0f}, meaning), ElementsAre(5.0f, 1.0f));
}

TEST(CleanColor, IsFiniteRgbaAndCounted) {
  FloatImage color(4, 1, 3, 0.5f);
  color.samples[1] = kNan;
  color.samples[3] = 2e30f;
  color.samples[7] = -3e38f;
  const auto found = host::cleanColor(color);
  EXPECT_EQ(found.notFinite, 1u);
  EXPECT_EQ(found.limited, 2u);
  EXPECT_THAT(color.samples, ElementsAre(0, 0, 0, 1, 1e30f, .5f, .5f, 1, .5f, -1e30f, .5f, 1, .5f, .5f, .5f, 1));
  EXPECT_FALSE(host::hasAlpha(color));
}

TEST(CleanColor, KeepsAlphaAndSpreadsGrey) {
  FloatImage transparent(2, 1, 4, 0.25f);
  transparent.samples[7] = -1.0f;
  host::cleanColor(transparent);
  EXPECT_THAT(transparent.samples, ElementsAre(.25f, .25f, .25f, .25f, .25f, .25f, .25f, -1.0f));
  EXPECT_TRUE(host::hasAlpha(transparent));
  FloatImage grey(1, 1, 1, 0.75f);
  EXPECT_EQ(host::cleanColor(grey).notFinite, 0u);
  EXPECT_THAT(grey.samples, ElementsAre(.75f, .75f, .75f, 1.0f));
}

}  // namespace

}  // namespace lensgraph
