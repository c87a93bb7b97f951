// Failure masks against their definitions carried out pixel by pixel, and on pictures whose masks are known by hand.
#include "engine/metrics/failure_masks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "engine/error.h"

namespace lensgraph {
namespace {

using engine::FloatImage;

int64_t squaredDistance(int64_t x0, int64_t y0, int64_t x1, int64_t y1) {
  return (x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0);
}

/// Calls test(c_p, c_q, squared distance, are neighbours) for all q until it is true; the mask of the p for which it is.
template <class Test>
FloatImage bruteForce(const FloatImage& coc, const Test& test) {
  FloatImage mask(coc.width, coc.height, 1);
  for (uint32_t y = 0; y < coc.height; ++y) {
    for (uint32_t x = 0; x < coc.width; ++x) {
      bool inside = false;
      for (uint32_t v = 0; v < coc.height && !inside; ++v) {
        for (uint32_t u = 0; u < coc.width && !inside; ++u) inside = test(x, y, u, v);
      }
      *mask.pixel(x, y) = inside ? 1.0f : 0.0f;
    }
  }
  return mask;
}

FloatImage bruteNearEdge(const FloatImage& coc) {
  const auto at = [&](int64_t x, int64_t y) {
    return double{*coc.pixel(static_cast<uint32_t>(x), static_cast<uint32_t>(y))};
  };
  FloatImage nearerSides(coc.width, coc.height, 1);
  for (int64_t y = 0; y < coc.height; ++y) {
    for (int64_t x = 0; x < coc.width; ++x) {
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= coc.width || y + dy >= coc.height) continue;
        if (at(x, y) < -1.0 && at(x + dx, y + dy) - at(x, y) > 1.0) {
          *nearerSides.pixel(static_cast<uint32_t>(x), static_cast<uint32_t>(y)) = 1.0f;
        }
      }
    }
  }
  return bruteForce(coc, [&](uint32_t x, uint32_t y, uint32_t u, uint32_t v) {
    const double radius = *coc.pixel(u, v);
    return *nearerSides.pixel(u, v) > 0.0f && static_cast<double>(squaredDistance(x, y, u, v)) <= radius * radius;
  });
}

FloatImage brutePartialOcclusion(const FloatImage& coc) {
  return bruteForce(coc, [&](uint32_t x, uint32_t y, uint32_t u, uint32_t v) {
    const double p = *coc.pixel(x, y), q = *coc.pixel(u, v), reach = std::fmax(std::fabs(p), std::fabs(q));
    return std::fabs(p - q) > 1.0 && static_cast<double>(squaredDistance(x, y, u, v)) <= reach * reach;
  });
}

/// Rectangles of constant c, slopes, and noise, with radii up to `largest`.
FloatImage randomCoc(uint32_t width, uint32_t height, float largest, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> radius(-largest, largest), slope(-0.3f, 0.3f), noise(-0.3f, 0.3f);
  const auto below = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
  FloatImage coc(width, height, 1, 0.3f);
  for (int i = 0; i < 6; ++i) {
    const uint32_t x0 = below(width), y0 = below(height);
    const uint32_t x1 = std::min(width, x0 + 1 + below(30)), y1 = std::min(height, y0 + 1 + below(30));
    const float c = radius(random), dx = i % 2 == 0 ? slope(random) : 0.0f, disturbance = i % 3 == 0 ? 1.0f : 0.0f;
    for (uint32_t y = y0; y < y1; ++y) {
      for (uint32_t x = x0; x < x1; ++x) {
        *coc.pixel(x, y) = c + dx * static_cast<float>(x - x0) + disturbance * noise(random);
      }
    }
  }
  return coc;
}

TEST(FailureMasks, EqualTheirDefinitions) {
  const struct {
    uint32_t width, height;
    float largest;
  } cases[] = {{70, 53, 4.0f}, {65, 40, 12.0f}, {40, 75, 60.0f}, {1, 70, 9.0f},
               {50, 1, 9.0f},  {1, 1, 5.0f},    {33, 20, 1e6f}};
  unsigned seed = 0;
  for (const auto& one : cases) {
    for (int repeat = 0; repeat < 3; ++repeat) {
      const FloatImage coc = randomCoc(one.width, one.height, one.largest, ++seed);
      EXPECT_EQ(engine::nearEdgeMask(coc).samples, bruteNearEdge(coc).samples) << seed;
      EXPECT_EQ(engine::partialOcclusionMask(coc).samples, brutePartialOcclusion(coc).samples) << seed;
    }
  }
}

// Radii and differences that are exactly at the limits, where an inexact distance would show.
TEST(FailureMasks, EqualTheirDefinitionsForWholeNumbers) {
  std::mt19937 random(77);
  const auto below = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
  for (int repeat = 0; repeat < 4; ++repeat) {
    FloatImage coc(60, 45, 1, static_cast<float>(repeat));
    for (int i = 0; i < 12; ++i) {
      *coc.pixel(below(60), below(45)) = static_cast<float>(below(21)) - 10.0f;
    }
    EXPECT_EQ(engine::nearEdgeMask(coc).samples, bruteNearEdge(coc).samples);
    EXPECT_EQ(engine::partialOcclusionMask(coc).samples, brutePartialOcclusion(coc).samples);
  }
}

TEST(FailureMasks, ANearEdgeReachesAsFarAsItsBlur) {
  FloatImage coc(40, 1, 1, 0.0f);
  for (uint32_t x = 0; x < 20; ++x) *coc.pixel(x, 0) = -6.0f;
  const FloatImage mask = engine::nearEdgeMask(coc);
  for (uint32_t x = 0; x < 40; ++x) EXPECT_EQ(*mask.pixel(x, 0), x >= 13 && x <= 25 ? 1.0f : 0.0f) << x;
}

TEST(FailureMasks, ABlurredBackgroundHasNoNearEdge) {
  FloatImage coc(40, 1, 1, 9.0f);
  for (uint32_t x = 0; x < 20; ++x) *coc.pixel(x, 0) = 0.0f;
  const FloatImage mask = engine::nearEdgeMask(coc);
  EXPECT_EQ(std::count(mask.samples.begin(), mask.samples.end(), 1.0f), 0);
  const FloatImage occlusion = engine::partialOcclusionMask(coc);
  for (uint32_t x = 0; x < 40; ++x) EXPECT_EQ(*occlusion.pixel(x, 0), x >= 11 && x <= 28 ? 1.0f : 0.0f) << x;
}

TEST(FailureMasks, OneSurfaceInBlurIsNoPartialOcclusion) {
  const FloatImage mask = engine::partialOcclusionMask(FloatImage(90, 90, 1, -25.0f));
  EXPECT_EQ(std::count(mask.samples.begin(), mask.samples.end(), 1.0f), 0);
}

TEST(FailureMasks, FocusIsHalfAPixelOfBlur) {
  FloatImage coc(4, 1, 1);
  coc.samples = {-0.5f, -0.49f, 0.49f, 0.5f};
  EXPECT_EQ(engine::inFocusMask(coc).samples, (std::vector<float>{0.0f, 1.0f, 1.0f, 0.0f}));
}

TEST(FailureMasks, HighlightsAreBrighterThanADisplay) {
  FloatImage reference(4, 1, 4, 1.0f);
  reference.pixel(1, 0)[2] = 1.01f;
  reference.pixel(2, 0)[3] = 5.0f;  // alpha
  reference.pixel(3, 0)[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(engine::highlightMask(reference).samples, (std::vector<float>{0.0f, 1.0f, 0.0f, 0.0f}));
}

TEST(FailureMasks, AreFourInAFixedOrder) {
  const auto masks = engine::failureMasks(FloatImage(3, 2, 1), FloatImage(3, 2, 3, 2.0f));
  ASSERT_EQ(masks.size(), 4u);
  EXPECT_EQ(masks[0].name, "nearEdge");
  EXPECT_EQ(masks[1].name, "inFocus");
  EXPECT_EQ(masks[2].name, "partialOcclusion");
  EXPECT_EQ(masks[3].name, "highlight");
  EXPECT_EQ(masks[3].pixels.samples, std::vector<float>(6, 1.0f));
}

TEST(FailureMasks, RefuseWhatDoesNotFit) {
  const FloatImage reference(3, 2, 3);
  EXPECT_THROW(engine::failureMasks(FloatImage(2, 2, 1), reference), engine::Error);
  EXPECT_THROW(engine::failureMasks(FloatImage(3, 2, 3), reference), engine::Error);
  EXPECT_THROW(engine::failureMasks(FloatImage{}, reference), engine::Error);
  EXPECT_THROW(engine::failureMasks(FloatImage(3, 2, 1, std::numeric_limits<float>::infinity()), reference),
               engine::Error);
}

}  // namespace
}  // namespace lensgraph
