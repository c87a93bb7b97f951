// The two-pass filter on a device: against the CPU reference, and held to the five laws of every technique.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/gpu/techniques/image_technique.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/two_pass_filter_reference.h"

namespace lensgraph {

namespace {

using support::ImageInput;
using support::Rgba;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNear = 0.1f;  // m

/// Focus at 2 m; K in px·m.
shared::LensConstants lens(float cocScale, float focusDistance = 2.0f) {
  return {.cocScale = cocScale,
          .focusVergence = 1.0f / focusDistance,
          .maxCocRadius = 1e30f,
          .vergenceScale = 1.0f / kNear,
          .vergenceOffset = 0.0f};
}

float depthBuffer(float viewDepth) {
  return kNear / viewDepth;
}

std::size_t at(const ImageInput& input, uint32_t x, uint32_t y) {
  return std::size_t{y} * input.extent.width + x;
}

ImageInput uniform(VkExtent2D extent, Rgba color, float viewDepth, float cocScale) {
  const std::size_t count = std::size_t{extent.width} * extent.height;
  return {extent, std::vector<Rgba>(count, color), std::vector<float>(count, depthBuffer(viewDepth)), lens(cocScale)};
}

/// Rectangles at random depths in front of and behind focus, some in focus, over the sky; random colours, a
/// few bright.
ImageInput randomRectangles(VkExtent2D extent, uint32_t seed, float cocScale) {
  std::mt19937 random(seed);
  const auto upTo = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
  ImageInput input = uniform(extent, {0.2f, 0.4f, 0.8f, 1.0f}, kInfinity, cocScale);
  for (auto& texel : input.color) texel[0] = static_cast<float>(upTo(100)) / 100.0f;
  for (int i = 0; i < 24; ++i) {
    const uint32_t left = upTo(extent.width), top = upTo(extent.height);
    const uint32_t right = std::min(extent.width, left + 1 + upTo(40)),
                   bottom = std::min(extent.height, top + 1 + upTo(40));
    const float depth = i % 3 == 0 ? 2.0f : 0.503f + 0.251f * static_cast<float>(upTo(40));
    const float bright = i % 8 == 0 ? 20.0f : 1.0f;
    for (uint32_t y = top; y < bottom; ++y) {
      for (uint32_t x = left; x < right; ++x) {
        const float checker = (x + y) % 2 == 0 ? bright : 0.1f;
        input.color[at(input, x, y)] = {checker, static_cast<float>(i) / 24.0f, 0.3f, 1.0f};
        input.depth[at(input, x, y)] = depthBuffer(depth);
      }
    }
  }
  return input;
}

std::vector<std::array<double, 3>> reference(const ImageInput& input, const passes::ParameterSet& parameters = {}) {
  const auto number = [&](const char* name, double fallback) {
    const auto found = parameters.find(name);
    return found == parameters.end() ? fallback : std::get<double>(found->second);
  };
  support::RgbzPicture picture{static_cast<int>(input.extent.width), static_cast<int>(input.extent.height), {}, {}};
  for (const auto& c : input.color) {
    picture.rgb.push_back({static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])});
  }
  for (const float z : input.depth) {
    picture.viewDepth.push_back(1.0 / (static_cast<double>(input.lens.vergenceScale) * static_cast<double>(z)));
  }
  return filterTwoPass(picture, {.pixelsPerTangent = static_cast<double>(input.lens.cocScale),
                                 .apertureRadius = 1.0,
                                 .focusDistance = 1.0 / static_cast<double>(input.lens.focusVergence),
                                 .maxRadius = number("maxRadius", 256.0),
                                 .minRadius = number("minRadius", 0.5),
                                 .leakage = number("leakage", 0.25)});
}

/// Largest |a - b| / max(|b|, 0.01) over pixels and channels. Float sums of some hundred terms stay below
/// 1e-4; a wrong or missing tap is far above. Where a radius is within rounding of a whole number, a tap may
/// weigh 1e-6 or nothing: the pictures avoid such radii and keep highlights moderate.
double largestError(const std::vector<Rgba>& color, const std::vector<std::array<double, 3>>& expected) {
  double worst = 0.0;
  for (std::size_t i = 0; i < color.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = std::abs(static_cast<double>(color[i][c]) - expected[i][c]);
      worst = std::max(worst, std::isfinite(error) ? error / std::max(std::abs(expected[i][c]), 0.01) : 1e30);
    }
  }
  return worst;
}

class TwoPassFilterGpu : public support::GpuTest {
 protected:
  support::ImageOutput run(const ImageInput& input, const passes::ParameterSet& parameters = {}) {
    return runner_.run("two_pass_filter", input, parameters);
  }

 private:
  support::ImageTechniqueRunner runner_;
};

TEST_F(TwoPassFilterGpu, EqualsTheReference) {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const auto input = randomRectangles({150, 101}, seed, 30.0f);
    const auto output = run(input);
    EXPECT_LT(largestError(output.color, reference(input)), 1e-4) << seed;
    EXPECT_GT(largestError(input.color, reference(input)), 0.5) << "the filter would be idle";
    for (const auto& texel : output.color) ASSERT_EQ(texel[3], 1.0f);
  }
}

TEST_F(TwoPassFilterGpu, EqualsTheReferenceForAllParameters) {
  const auto input = randomRectangles({97, 64}, 4, 60.0f);
  for (const passes::ParameterSet& parameters :
       {passes::ParameterSet{{"maxRadius", 5.5}}, passes::ParameterSet{{"minRadius", 2.0}},
        passes::ParameterSet{{"leakage", 0.0}}, passes::ParameterSet{{"leakage", 0.05}, {"minRadius", 0.1}}}) {
    EXPECT_LT(largestError(run(input, parameters).color, reference(input, parameters)), 1e-4);
  }
}

TEST_F(TwoPassFilterGpu, EqualsTheReferenceAtEverySize) {
  for (const VkExtent2D extent : {VkExtent2D{1, 1}, VkExtent2D{1, 83}, VkExtent2D{67, 1}, VkExtent2D{15, 17},
                                  VkExtent2D{16, 16}, VkExtent2D{131, 7}}) {
    const auto input = randomRectangles(extent, 5, 40.0f);
    EXPECT_LT(largestError(run(input).color, reference(input)), 1e-4) << extent.width << 'x' << extent.height;
  }
}

// A blur far wider than the picture, and a single near pixel whose blur just reaches into tiles far away:
// taps that the tiles leave out must be those that weigh nothing.
TEST_F(TwoPassFilterGpu, TilesLeaveOutNothingThatCounts) {
  EXPECT_LT(largestError(run(randomRectangles({70, 50}, 6, 4000.0f)).color,
                         reference(randomRectangles({70, 50}, 6, 4000.0f))),
            1e-4);
  for (const float radius : {1.01f, 16.5f, 17.1f, 31.9f, 33.01f, 48.5f}) {
    for (const uint32_t x : {47u, 48u, 63u}) {
      auto input = uniform({112, 40}, {0.1f, 0.1f, 0.1f, 1.0f}, 2.0f, 100.0f);
      const auto pixel = at(input, x, 17);
      input.color[pixel] = {1e6f, 1e5f, 10.0f, 1.0f};
      input.depth[pixel] = kNear * (0.5f + radius / 100.0f);
      EXPECT_LT(largestError(run(input).color, reference(input)), 1e-4) << radius << ' ' << x;
    }
  }
}

// Law 1.
TEST_F(TwoPassFilterGpu, WithoutAnApertureThePictureStaysBitForBit) {
  auto input = randomRectangles({40, 30}, 7, 0.0f);
  input.color[5] = {1e38f, -1.0f, 1e-42f, 0.25f};
  EXPECT_EQ(run(input).color, input.color);
}

// Law 2, with depths of all kinds.
TEST_F(TwoPassFilterGpu, AConstantColourStaysIncludingTheBorder) {
  auto input = randomRectangles({130, 90}, 8, 50.0f);
  for (const float level : {1e-6f, 0.18f, 65504.0f, 1e30f}) {
    for (auto& texel : input.color) texel = {level, level, level, 1.0f};
    for (const auto& texel : run(input).color) ASSERT_NEAR(texel[0] / level, 1.0f, 1e-5f) << level;
  }
}

// ---- Alpha

/// Transparent on the left, opaque on the right, at depths of all kinds; red holds the same as alpha.
ImageInput halfTransparent() {
  auto input = randomRectangles({90, 60}, 13, 50.0f);
  for (uint32_t y = 0; y < 60; ++y) {
    for (uint32_t x = 0; x < 90; ++x) {
      auto& texel = input.color[at(input, x, y)];
      const float alpha = x < 40 ? 0.0f : x < 60 ? 0.5f : 1.0f;
      texel = {alpha, alpha * texel[1], alpha * texel[2], alpha};
    }
  }
  input.colorHasAlpha = true;
  return input;
}

TEST_F(TwoPassFilterGpu, AlphaIsBlurredAsAColourIs) {
  const auto input = halfTransparent();
  const auto output = run(input);
  EXPECT_LT(largestError(output.color, reference(input)), 1e-4);
  float largestChange = 0.0f;
  for (std::size_t i = 0; i < output.color.size(); ++i) {
    ASSERT_EQ(output.color[i][3], output.color[i][0]) << i;
    largestChange = std::max(largestChange, std::abs(output.color[i][3] - input.color[i][3]));
  }
  EXPECT_GT(largestChange, 0.2f) << "nothing was blurred";
}

TEST_F(TwoPassFilterGpu, AlphaChangesNoColour) {
  auto input = halfTransparent();
  const auto kept = run(input).color;
  input.colorHasAlpha = false;
  const auto dropped = run(input).color;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(kept[i][c], dropped[i][c]) << i;
    ASSERT_EQ(dropped[i][3], 1.0f) << i;
  }
}

TEST_F(TwoPassFilterGpu, AlphaThatIsNoNumberBecomesOpaque) {
  auto input = halfTransparent();
  input.color[17][3] = kNaN;
  input.color[3000][3] = -kInfinity;
  for (const auto& texel : run(input).color) ASSERT_TRUE(std::isfinite(texel[3]));
}

// Law 3: finite in, finite out …
TEST_F(TwoPassFilterGpu, TheLargestFloatsStayFinite) {
  auto input = randomRectangles({90, 60}, 9, 50.0f);
  for (std::size_t i = 0; i < input.color.size(); ++i) {
    const float sign = i % 2 == 0 ? 1.0f : -1.0f;
    input.color[i] = {sign * std::numeric_limits<float>::max(), 65504.0f, 1e-45f, 1.0f};
    if (i % 7 == 0) input.depth[i] = std::numeric_limits<float>::max();
    if (i % 7 == 1) input.depth[i] = -1.0f;
  }
  const auto output = run(input);
  for (const auto& texel : output.color) {
    for (const float channel : texel) ASSERT_TRUE(std::isfinite(channel));
  }
  EXPECT_EQ(output.statistics.replacedTexels, 0u);
}

// … and what is not finite is replaced, counted, and does not spread.
TEST_F(TwoPassFilterGpu, BrokenTexelsAreReplacedAndCounted) {
  const auto clean = randomRectangles({90, 60}, 10, 50.0f);
  auto broken = clean;
  auto expected = clean;
  uint32_t count = 0;
  for (std::size_t i = 100; i < broken.color.size(); i += 701, ++count) {
    if (count % 2 == 0) {
      broken.color[i][count % 3] = count % 4 == 0 ? kNaN : -kInfinity;
      expected.color[i] = {0.0f, 0.0f, 0.0f, 1.0f};
    } else {
      broken.depth[i] = count % 4 == 1 ? kNaN : kInfinity;
      expected.depth[i] = 0.0f;
    }
  }
  const auto output = run(broken);
  EXPECT_EQ(output.statistics.replacedTexels, count);
  EXPECT_EQ(output.color, run(expected).color);
  EXPECT_EQ(run(clean).statistics.replacedTexels, 0u);
}

// Law 4.
TEST_F(TwoPassFilterGpu, TheSameInputsGiveTheSameBits) {
  const auto input = randomRectangles({150, 101}, 11, 80.0f);
  EXPECT_EQ(run(input).color, run(input).color);
}

TEST_F(TwoPassFilterGpu, LimitedRadiiAreCounted) {
  auto input = uniform({50, 40}, {1.0f, 1.0f, 1.0f, 1.0f}, 2.0f, 100.0f);
  for (uint32_t x = 0; x < 50; ++x) input.depth[at(input, x, 3)] = 0.0f;               // The sky: 50 px.
  for (uint32_t x = 0; x < 25; ++x) input.depth[at(input, x, 7)] = depthBuffer(1.0f);  // -50 px.
  EXPECT_EQ(run(input).statistics.clampedCoc, 0u);
  EXPECT_EQ(run(input, {{"maxRadius", 49.0}}).statistics.clampedCoc, 75u);
  input.lens.maxCocRadius = 20.0f;
  EXPECT_EQ(run(input).statistics.clampedCoc, 75u);
}

// An object in focus before a blurred background, and in focus behind a blurred foreground.
TEST_F(TwoPassFilterGpu, TheBackgroundDoesNotLeakOntoWhatIsInFocus) {
  auto input = uniform({64, 64}, {9.0f, 9.0f, 9.0f, 1.0f}, kInfinity, 20.0f);
  for (uint32_t y = 16; y < 48; ++y) {
    for (uint32_t x = 16; x < 48; ++x) {
      input.color[at(input, x, y)] = {0.0f, 0.0f, 0.0f, 1.0f};
      input.depth[at(input, x, y)] = depthBuffer(2.0f);
    }
  }
  const auto output = run(input);
  for (uint32_t y = 16; y < 48; ++y) {
    for (uint32_t x = 16; x < 48; ++x) ASSERT_EQ(output.color[at(input, x, y)][0], 0.0f) << x << ' ' << y;
  }
  for (auto& z : input.depth) z = z == 0.0f ? depthBuffer(1.0f) : z;  // The rest comes to the front.
  EXPECT_GT(run(input).color[at(input, 17, 30)][0], 0.0f);
}

// A focus pull in small steps changes the picture in small steps (no popping): four times the steps, about a
// quarter of the largest change between neighbouring frames. With a small lens, since the filter answers
// steeply where a pixel near focus begins to reach over a blurred one: its weight is r_c² times as large
// (passes/two_pass_filter/README.md).
TEST_F(TwoPassFilterGpu, AFocusPullIsContinuous) {
  auto input = randomRectangles({32, 32}, 12, 4.0f);
  const auto largestStep = [&](int steps) {
    float worst = 0.0f;
    std::vector<Rgba> before;
    for (int i = 0; i <= steps; ++i) {
      input.lens.focusVergence = 0.2f + 0.6f * static_cast<float>(i) / static_cast<float>(steps);
      const auto color = run(input).color;
      for (std::size_t p = 0; p < before.size(); ++p) worst = std::max(worst, std::abs(color[p][1] - before[p][1]));
      before = color;
    }
    return worst;
  };
  const float coarse = largestStep(240), fine = largestStep(960);
  EXPECT_LT(fine, 0.35f * coarse);
}

}  // namespace

}  // namespace lensgraph
