// Layers of view depth and sets of lens rays: the numbers behind the multiview synthesis.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "passes/multiview_synthesis/layers.h"
#include "passes/multiview_synthesis/lens_rays.h"

namespace lensgraph {

namespace {

using namespace passes::multiview_synthesis;
using passes::VergenceInterval;
using shared::SceneLayer;

std::vector<SceneLayer> layersOf(std::vector<VergenceInterval> occupied, const LayerSpacing& spacing) {
  return sceneLayers(occupied, spacing);
}

// Lee 2009 §4.1: M = ceil(K (V_near - V_far) / δ), bounds evenly spaced in vergence from the near side.
TEST(SceneLayers, AreEvenInVergence) {
  const auto layers = layersOf({{0.25f, 2.25f}}, {.pixelsPerVergence = 20.0, .travel = 4.0});
  ASSERT_EQ(layers.size(), 11u);  // ten, and a little for rounding
  for (std::size_t i = 0; i < layers.size(); ++i) {
    EXPECT_NEAR(layers[i].borders.x - layers[i].borders.y, 2.0 / 11.0, 2e-3);
    EXPECT_LE((layers[i].borders.x - layers[i].borders.y) * 20.0, 4.0);
    EXPECT_FLOAT_EQ(layers[i].borders.x, i > 0 ? layers[i - 1].borders.y : layers[i].borders.x);
  }
  EXPECT_GE(layers.front().borders.x, 2.25f);
  EXPECT_LE(layers.back().borders.y, 0.25f);
}

TEST(SceneLayers, OverlapByATenth) {
  const auto layers = layersOf({{0.0f, 1.0f}}, {.pixelsPerVergence = 30.0, .travel = 3.0});
  for (const SceneLayer& layer : layers) {
    const float thickness = layer.borders.x - layer.borders.y;
    EXPECT_NEAR(layer.nearest - layer.borders.x, 0.1f * thickness, 1e-6f);
    EXPECT_NEAR(layer.borders.y - layer.farthest, layer.farthest > 0.0f ? 0.1f * thickness : layer.borders.y, 1e-6f);
    EXPECT_GE(layer.farthest, 0.0f);
  }
}

TEST(SceneLayers, NothingBetweenIntervalsGetsALayer) {
  const auto layers = layersOf({{1.3f, 1.4f}, {0.2f, 0.25f}}, {.pixelsPerVergence = 20.0, .travel = 3.0});
  EXPECT_EQ(layers.size(), 2u);  // of eight from one end to the other
  EXPECT_GT(layers[0].farthest, 1.2f);
  EXPECT_LT(layers[1].nearest, 0.3f);
}

TEST(SceneLayers, LayersAreNeverMoreThanAllowedAndCoverEverything) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  for (int round = 0; round < 300; ++round) {
    std::vector<VergenceInterval> occupied;
    float v = std::pow(10.0f, 6.0f * uniform(random) - 3.0f);
    for (int i = 0, count = 1 + round % 40; i < count; ++i) {
      const float far = v * (0.5f + 0.5f * uniform(random));
      occupied.push_back({far, v});
      v = far * (0.3f + 0.69f * uniform(random));
    }
    LayerSpacing spacing{.pixelsPerVergence = std::pow(10.0, 5.0 * uniform(random) - 2.0),
                         .travel = 0.25 + 10.0 * uniform(random)};
    spacing.fixedCount = round % 3 == 0 ? 1 + round % 64 : 0;
    spacing.mostLayers = round % 2 == 0 ? 64 : 32;
    const auto layers = sceneLayers(occupied, spacing);
    ASSERT_GE(layers.size(), 1u);
    ASSERT_LE(layers.size(), spacing.mostLayers);
    ASSERT_LE(layers.size(), spacing.fixedCount > 0 ? spacing.fixedCount : spacing.mostLayers);
    for (std::size_t i = 0; i < layers.size(); ++i) {
      ASSERT_GT(layers[i].borders.x, layers[i].borders.y);
      ASSERT_GE(layers[i].farthest, 0.0f);
      ASSERT_LE(layers[i].borders.x, i > 0 ? layers[i - 1].borders.y : layers[i].borders.x);
    }
    for (const auto& interval : occupied) {
      for (const float t : {0.0f, 0.31f, 1.0f}) {
        const float at = interval.farthest + t * (interval.nearest - interval.farthest);
        ASSERT_TRUE(
            std::ranges::any_of(layers, [&](const SceneLayer& l) { return at <= l.borders.x && at >= l.borders.y; }))
            << "round " << round << " vergence " << at;
      }
    }
  }
}

TEST(SceneLayers, AFixedCountOfLayersIsUsedUp) {
  for (const uint32_t count : {1u, 2u, 7u, 16u, 64u}) {
    EXPECT_EQ(layersOf({{0.1f, 1.0f}}, {.pixelsPerVergence = 20.0, .fixedCount = count}).size(), count);
  }
}

TEST(SceneLayers, AnEmptySceneHasOneLayer) {
  EXPECT_EQ(layersOf({}, {.pixelsPerVergence = 20.0}).size(), 1u);
}

TEST(SceneLayers, ASurfaceAtOneDepthHasRoom) {
  const auto layers = layersOf({{0.5f, 0.5f}}, {.pixelsPerVergence = 20.0, .travel = 3.0});
  ASSERT_EQ(layers.size(), 1u);
  EXPECT_GT(layers[0].borders.x, 0.5f);
  EXPECT_LT(layers[0].borders.y, 0.5f);
}

shared::ApertureShape disc() {
  return {.anamorphicRatio = 1.0f};
}

uint32_t raysOf(const std::vector<LensView>& views) {
  uint32_t sum = 0;
  for (const auto& view : views) sum += view.raysPerPixel;
  return sum;
}

TEST(LensRays, OneViewIsTheLensCentre) {
  const auto views = lensViews({.aperture = disc(), .rayCount = 32});
  ASSERT_EQ(views.size(), 1u);
  EXPECT_EQ(views[0].lens, (shared::vec2{0.0f, 0.0f}));
  EXPECT_EQ(views[0].pixelOffset, (shared::vec2{0.0f, 0.0f}));
  EXPECT_EQ(views[0].raysPerPixel, 32u);
  EXPECT_LE(views[0].reach, 1.0f);
}

TEST(LensRays, HaltonSetsAreTwiceAsLong) {
  const auto views = lensViews({.aperture = disc(), .rayCount = 32, .jitter = Jitter::halton});
  EXPECT_EQ(views[0].rays.size(), 64u);
  EXPECT_EQ(views[0].raysPerPixel, 32u);
}

TEST(LensRays, EveryRayGoesToTheNearestView) {
  const auto views = lensViews({.aperture = disc(), .rayCount = 256, .viewCount = 8});
  EXPECT_EQ(raysOf(views), 256u);
  for (const auto& view : views) {
    for (const auto& ray : view.rays) {
      const auto distance = [&](const LensView& v) { return std::hypot(ray.lens.x - v.lens.x, ray.lens.y - v.lens.y); };
      EXPECT_LE(distance(view), view.reach);
      for (const auto& other : views) EXPECT_LE(distance(view), distance(other) + 1e-6f);
    }
    EXPECT_LT(view.reach, 1.0f);
  }
}

// Then each view is a view of the accumulation: its one ray does not travel.
TEST(LensRays, AsManyViewsAsRaysLeaveNothingToTravel) {
  const auto views = lensViews({.aperture = disc(), .rayCount = 16, .viewCount = 16});
  ASSERT_EQ(views.size(), 16u);
  for (const auto& view : views) {
    EXPECT_EQ(view.raysPerPixel, 1u);
    EXPECT_EQ(view.reach, 0.0f);
  }
}

TEST(LensRays, NoiseKeepsTheSizeOfTheBlur) {
  for (const uint32_t count : {64u, 256u, 1024u}) {
    const auto views = lensViews({.aperture = disc(), .rayCount = count, .jitter = Jitter::noise});
    double variance = 0.0;
    for (const auto& ray : views[0].rays) variance += ray.lens.x * ray.lens.x / count;
    const double h = noiseReach(count);
    EXPECT_NEAR(variance + h * h / 3.0, 0.25, 0.012) << count;
  }
}

}  // namespace

}  // namespace lensgraph
