// The accumulation reference: how fast it converges, what its own error estimate is worth, that its number of
// views per execution does not show, and pictures known in closed form.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/spot.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph {

namespace {

using support::render;

passes::ParameterSet samples(int64_t count, int64_t viewsPerFrame = 64) {
  return {{"lensSamples", count}, {"viewsPerFrame", viewsPerFrame}};
}

host::Shot wideShot(int width, int height) {
  auto shot = support::smallShot(width, height);
  shot.lens.apertureRadius = 0.1;
  return shot;
}

double luma(const float* p) {
  return 0.2126 * static_cast<double>(p[0]) + 0.7152 * static_cast<double>(p[1]) + 0.0722 * static_cast<double>(p[2]);
}

double lumaError(const engine::FloatImage& a, const engine::FloatImage& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixelCount(); ++i) {
    sum += std::pow(luma(&a.samples[i * 4]) - luma(&b.samples[i * 4]), 2.0);
  }
  return std::sqrt(sum / static_cast<double>(a.pixelCount()));
}

class Accumulation : public support::GpuTest {};

// Independent samples would give N^-0.5. The estimate takes them as independent, so it lies above the true
// error, ever farther as N grows: 2 times at 16 and 4 at 256.
TEST_F(Accumulation, ConvergesFasterThanRandomSamplingAndKnowsItsError) {
  host::Renderer renderer(support::device(), support::layeredScene(), std::nullopt);
  const auto shot = wideShot(64, 36);
  const auto truth = render(renderer, shot, "accumulation", samples(4096)).color;
  support::keepPicture(truth, "accumulation_4096");
  for (const char* pattern : {"sobol", "halton", "r2"}) {
    std::array<double, 3> errors{};
    const std::array<int64_t, 3> counts = {16, 64, 256};
    for (std::size_t i = 0; i < counts.size(); ++i) {
      auto parameters = samples(counts[i]);
      parameters["pattern"] = std::string(pattern);
      const auto rendering = render(renderer, shot, "accumulation", parameters);
      errors[i] = lumaError(rendering.color, truth);
      std::printf("%-6s %4d samples: RMS error %.5f, estimate %.5f\n", pattern, static_cast<int>(counts[i]), errors[i],
                  rendering.estimatedError);
      EXPECT_GE(rendering.estimatedError, errors[i]) << pattern << ' ' << counts[i];
      EXPECT_LE(rendering.estimatedError, 8.0 * errors[i]) << pattern << ' ' << counts[i];
    }
    const double exponent = std::log(errors[2] / errors[0]) / std::log(16.0);
    std::printf("%-6s error ~ N^%.2f\n", pattern, exponent);
    EXPECT_LT(exponent, -0.6) << pattern;
    EXPECT_LT(errors[1], errors[0]) << pattern;
    EXPECT_LT(errors[2], errors[1]) << pattern;
  }
}

TEST_F(Accumulation, ViewsPerFrameDoNotShow) {
  auto scene = support::layeredScene();
  support::addFacingQuad(scene, 1.2, 0.2, 0.0, 0.1, 0.3, support::addMaterial(scene, {0.1f, 0.9f, 0.2f, 0.4f}));
  host::Renderer renderer(support::device(), scene, std::nullopt);
  auto shot = wideShot(61, 35);
  shot.lens.sphericalAberration = 0.5;
  shot.lens.opticalVignetting = 0.5;
  const auto one = render(renderer, shot, "accumulation", samples(64, 1));
  const auto eight = render(renderer, shot, "accumulation", samples(64, 8));
  const auto uneven = render(renderer, shot, "accumulation", samples(64, 9));
  const auto all = render(renderer, shot, "accumulation", samples(64, 64));
  EXPECT_TRUE(one.color.samples == eight.color.samples);
  EXPECT_TRUE(one.color.samples == uneven.color.samples);
  EXPECT_TRUE(one.color.samples == all.color.samples);
  EXPECT_EQ(one.estimatedError, all.estimatedError);
  EXPECT_GT(one.statistics.transparentNodes, 0u);
}

// Law 2 with every kind of surface: masked with holes, blended, crossing each other, before and behind focus.
TEST_F(Accumulation, MaskedAndBlendedSurfacesOfOneColourStayThatColour) {
  const glm::vec3 color(0.25f, 3.0f, 0.001f);
  auto scene = support::constantScene(color);
  const uint32_t pane = support::addMaterial(scene, {color, 0.3f});
  const uint32_t masked = support::addMaterial(scene, {color, 1.0f});
  scene.materials[masked].alphaMode = engine::AlphaMode::mask;
  support::addQuad(scene, {glm::vec3(-1, -1, -0.9f), {1, -1, -5}, {1, 1, -5}, {-1, 1, -0.9f}}, pane);
  support::addQuad(scene, {glm::vec3(-1, -1, -5), {1, -1, -0.9f}, {1, 1, -0.9f}, {-1, 1, -5}}, pane);
  for (const double depth : {0.9, 1.9, 2.0, 4.0}) {
    support::addFacingQuad(scene, depth, 0.0, 0.0, 0.3, 0.3, masked);
    // Alpha falls below the cutoff towards the right edge.
    for (const float alpha : {1.0f, 0.0f, 0.0f, 1.0f})
      scene.primitives.back().colors.emplace_back(1.0f, 1.0f, 1.0f, alpha);
  }
  host::Renderer renderer(support::device(), scene, std::nullopt);
  auto shot = support::smallShot(97, 61);
  shot.background = {color.x, color.y, color.z};
  shot.lens.apertureRadius = 0.05;
  const auto rendering = render(renderer, shot, "accumulation", samples(32, 8));
  EXPECT_GT(rendering.statistics.transparentNodes, 0u);
  double worst = 0.0;
  for (std::size_t i = 0; i < rendering.color.pixelCount(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double value = static_cast<double>(rendering.color.samples[i * 4 + static_cast<std::size_t>(c)]);
      worst = std::max(worst, std::abs(value / static_cast<double>(color[c]) - 1.0));
    }
  }
  EXPECT_LE(worst, 1e-5);
}

// A blended pane covers as its alpha, a masked one by its holes, blurred as any other surface: the whole
// lens's mean.
TEST_F(Accumulation, BlurredPanesKeepTheirCoverage) {
  engine::Scene scene;
  support::addFacingQuad(scene, 1.0, 0.0, 0.0, 0.04, 0.04, support::addMaterial(scene, {1.0f, 0.0f, 0.0f, 0.25f}));
  host::Renderer renderer(support::device(), scene, std::nullopt);
  const auto shot = wideShot(96, 96);
  const auto blurred = support::measureSpot(render(renderer, shot, "accumulation", samples(256)).color);
  auto sharp = shot;
  sharp.lens.apertureRadius = 0.0;
  const auto pinhole = support::measureSpot(render(renderer, sharp, "pinhole", {{"pixelSamples", int64_t{256}}}).color);
  const double sidePx = 0.08 * support::pixelsPerTangent(shot);
  EXPECT_NEAR(pinhole.flux, 0.25 * sidePx * sidePx, 0.01 * pinhole.flux);
  EXPECT_NEAR(blurred.flux, pinhole.flux, 0.005 * pinhole.flux);
  const double radius = std::abs(support::thinLensRadius(shot, 1.0));
  EXPECT_NEAR(blurred.varianceX - pinhole.varianceX, 0.25 * radius * radius, 0.03 * radius * radius);
}

/// Share of a uniform disc of radius 1 that lies right of x = t.
double discRightOf(double t) {
  if (t <= -1.0) return 1.0;
  if (t >= 1.0) return 0.0;
  return (std::acos(t) - t * std::sqrt(1.0 - t * t)) / std::numbers::pi;
}

// A knife edge before a wall: each pixel is the share of the lens that sees past it. 8192 views in 128
// executions.
TEST_F(Accumulation, ManyViewsOfAKnifeEdgeAreTheAnalyticProfile) {
  engine::Scene scene;
  support::addFacingQuad(scene, 1.0, -4.0, 0.0, 4.0, 8.0, support::addMaterial(scene, {0.0f, 0.0f, 0.0f, 1.0f}));
  host::Renderer renderer(support::device(), scene, std::nullopt);
  auto shot = wideShot(16, 8);
  shot.lens.apertureRadius = 0.8;
  shot.background = {1.0f, 1.0f, 1.0f};
  const double radius = std::abs(support::thinLensRadius(shot, 1.0));
  ASSERT_GT(radius, 3.0);
  uint32_t executions = 0;
  host::RenderOptions options;
  options.technique = "accumulation";
  options.parameters = samples(8192);
  options.progress = [&](uint32_t done, uint32_t total) {
    EXPECT_EQ(done, ++executions);
    EXPECT_EQ(total, 128u);
  };
  const auto picture = renderer.render(shot, options).color;
  EXPECT_EQ(executions, 128u);
  double worst = 0.0;
  for (uint32_t y = 0; y < 8; ++y) {
    for (uint32_t x = 0; x < 16; ++x) {
      double expected = 0.0;  // over the pixel's width
      constexpr int kSteps = 64;
      for (int i = 0; i < kSteps; ++i) expected += discRightOf((8.0 - (x + (i + 0.5) / kSteps)) / radius) / kSteps;
      worst = std::max(worst, std::abs(static_cast<double>(picture.pixel(x, y)[0]) - expected));
    }
  }
  std::printf("knife edge, 8192 views: largest error %.2g of 1\n", worst);
  // Stratified points leave an error only in the √N strata that the edge crosses: of the order N^-3/4.
  // Random ones would leave N^-1/2, ten times that.
  EXPECT_LT(worst, 2.0 * std::pow(8192.0, -0.75));
}

// Focus outside the scene's depths, and at infinity: the same affine formula, without a special case.
TEST_F(Accumulation, FocusOutsideTheSceneIsTheThinLensFormulaToo) {
  auto shot = wideShot(96, 96);
  constexpr double kDepth = 4.0;
  host::Renderer renderer(support::device(), support::lightScene(kDepth, 1.0, support::pixelsPerTangent(shot)),
                          std::nullopt);
  for (const double focus : {0.6, 1.0, 40.0, 1e9, std::numeric_limits<double>::infinity()}) {
    shot.lens.focusDistance = focus;
    shot.lens.apertureRadius = focus < kDepth ? 0.1 : 0.4;
    const auto picture = render(renderer, shot, "accumulation", samples(256)).color;
    EXPECT_EQ(support::nonFiniteCount(picture), 0u) << focus;
    const auto spot = support::measureSpot(picture);
    const double expected = std::abs(support::thinLensRadius(shot, kDepth));
    // The light and the pixel are squares of 1 px: each adds 1/12 px² an axis.
    const double radius = std::sqrt(std::max(0.0, spot.radius * spot.radius - 2.0 / 3.0));
    EXPECT_GT(expected, 5.0) << "the test would see little";
    EXPECT_NEAR(radius, expected, 0.01 * expected) << "focus " << focus;
    EXPECT_NEAR(spot.x, 48.0, 0.05) << "focus " << focus;
  }
}

}  // namespace

}  // namespace lensgraph
