// The multiview synthesis, detail by detail: each test fails when its detail is taken out.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "engine/draw/environment.h"
#include "engine/metrics/metrics.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/spot.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph {

namespace {

using passes::ParameterSet;
using support::render;

constexpr const char* kName = "multiview_synthesis";

double psnr(const engine::FloatImage& a, const engine::FloatImage& b) {
  return engine::compareImages(a, b).psnr;
}

double largestDifference(const engine::FloatImage& a, const engine::FloatImage& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    largest = std::max(largest, std::abs(double(a.samples[i]) - double(b.samples[i])));
  }
  return largest;
}

/// Largest relative difference of any channel from one colour.
double distanceFrom(const engine::FloatImage& picture, const glm::vec3& color) {
  double largest = 0.0;
  for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
    for (int c = 0; c < 3; ++c) {
      largest = std::max(largest, std::abs(double(picture.samples[4 * i + c]) / double(color[c]) - 1.0));
    }
  }
  return largest;
}

const glm::vec3 kColor(0.25f, 3.0f, 0.05f);

class MultiviewSynthesis : public support::GpuTest {
 protected:
  engine::FloatImage picture(const engine::Scene& scene, const host::Shot& shot, const ParameterSet& parameters = {}) {
    host::Renderer renderer(support::device(), scene, std::nullopt);
    return render(renderer, shot, kName, parameters).color;
  }
  engine::FloatImage reference(const engine::Scene& scene, const host::Shot& shot, bool pixelJitter = true) {
    host::Renderer renderer(support::device(), scene, std::nullopt);
    return render(renderer, shot, "accumulation",
                  {{"lensSamples", int64_t{512}}, {"viewsPerFrame", int64_t{64}}, {"pixelJitter", pixelJitter}})
        .color;
  }
};

TEST_F(MultiviewSynthesis, CullingChangesNoPicture) {
  const auto shot = support::smallShot(101, 67);
  for (const ParameterSet& parameters : {ParameterSet{},
                                         {{"delta", 0.5}},
                                         {{"jitter", std::string("noise")}, {"lensSamples", int64_t{8}}},
                                         {{"border", 0.0}, {"coneWidth", 4.0}},
                                         {{"views", int64_t{3}}, {"search", std::string("falsePosition")}}}) {
    auto all = parameters;
    all["culling"] = false;
    EXPECT_LE(largestDifference(picture(support::layeredScene(), shot, parameters),
                                picture(support::layeredScene(), shot, all)),
              1e-6);
  }
}

// An empty texel is no surface: rays go on beside a bar whose layer they cross over several pixels. Were empty texels
// taken as a surface, even a far one, the bar would connect to it and widen.
TEST_F(MultiviewSynthesis, EmptyTexelsLetRaysPass) {
  auto shot = support::smallShot(160, 40);
  shot.background = {1.0f, 1.0f, 1.0f};
  shot.lens.apertureRadius = 0.1;
  const double width = 4.0;  // px, all along
  const auto s = static_cast<float>(support::pixelsPerTangent(shot));
  const auto half = [&](float depth) { return static_cast<float>(0.5 * width) * depth / s; };
  engine::Scene scene;  // top nearer than bottom, so that the layer is thick
  support::addQuad(
      scene,
      {glm::vec3(-half(1.6f), -0.6, -1.6), {half(1.6f), -0.6, -1.6}, {half(0.7f), 0.5, -0.7}, {-half(0.7f), 0.5, -0.7}},
      support::addMaterial(scene, {0.0f, 0.0f, 0.0f, 1.0f}));
  // It takes away as much light as it covers, wherever its blur spreads that to.
  const auto darkness = [&](const engine::FloatImage& image) {
    double sum = 0.0;
    for (uint32_t x = 0; x < image.width; ++x) sum += 1.0 - double(image.pixel(x, 20)[0]);
    return sum;
  };
  for (const int64_t layers : {0, 1}) {
    const auto image = picture(scene, shot, {{"lensSamples", int64_t{256}}, {"layers", layers}, {"coneWidth", 0.0}});
    support::keepPicture(image, "multiview_bar");
    EXPECT_NEAR(darkness(image), width, 0.25) << layers << " layers";
  }
}

// A slanted wall that lies in many layers has no seam through which what is behind it shows.
TEST_F(MultiviewSynthesis, LayersOverlapWithoutSeams) {
  engine::Scene scene;
  const uint32_t wall = support::addMaterial(scene, {kColor, 1.0f}), behind = support::addMaterial(scene, {9, 0, 9, 1});
  support::addFacingQuad(scene, 90.0, 0.0, 0.0, 99.0, 99.0, behind);
  support::addQuad(scene, {glm::vec3(-3, -9, -0.7), {9, -9, -12}, {9, 9, -12}, {-3, 9, -0.7}}, wall);
  auto shot = support::smallShot(128, 72);
  shot.camera.fovyDeg = 20.0;
  for (const double delta : {0.5, 3.0}) {
    for (const char* search : {"scan", "falsePosition"}) {
      for (const bool split : {true, false}) {
        const auto image = picture(scene, shot,
                                   {{"delta", delta},
                                    {"search", std::string(search)},
                                    {"splitTriangles", split},
                                    {"coneWidth", 0.0},
                                    {"lensSamples", int64_t{64}}});
        EXPECT_LE(distanceFrom(image, kColor), 1e-3) << delta << " " << search << " split " << split;
      }
    }
  }
}

// What is outside the layers' picture is not known: it must not count as the background.
TEST_F(MultiviewSynthesis, RaysThatLeaveThePictureAreDropped) {
  engine::Scene scene;
  const uint32_t wall = support::addMaterial(scene, {kColor, 1.0f});
  support::addFacingQuad(scene, 9.0, 0.0, 0.0, 20.0, 20.0, wall);
  support::addFacingQuad(scene, 0.6, 0.0, 0.0, 0.1, 0.01, wall);
  auto shot = support::smallShot(96, 54);
  shot.lens.apertureRadius = 0.1;
  for (const double border : {0.0, 0.3, 1.0}) {
    for (const char* jitter : {"none", "halton"}) {
      const auto image =
          picture(scene, shot, {{"border", border}, {"coneWidth", 0.0}, {"jitter", std::string(jitter)}});
      EXPECT_LE(distanceFrom(image, kColor), 1e-3) << border;
    }
  }
}

// Nor does what is at the picture's edge stand for what is beyond it.
TEST_F(MultiviewSynthesis, TheEdgeOfThePictureIsNotStretched) {
  engine::Scene scene;
  auto shot = support::smallShot(96, 54);
  shot.lens.apertureRadius = 0.4;
  support::addFacingQuad(scene, 9.0, 0.0, 0.0, 20.0, 20.0, support::addMaterial(scene, {0.1f, 0.1f, 0.1f, 1.0f}));
  const double edge = 0.5 * 96 / support::pixelsPerTangent(shot) * 8.0;
  support::addFacingQuad(scene, 8.0, -edge - 0.1, 0.0, 0.1, 9.0, support::addMaterial(scene, {5.0f, 5.0f, 5.0f, 1.0f}));
  const auto truth = reference(scene, shot);
  const auto image = picture(scene, shot, {{"border", 0.0}, {"lensSamples", int64_t{256}}});
  EXPECT_LT(image.pixel(0, 27)[0], 2.0f * truth.pixel(0, 27)[0]);
}

// A bar that the pinhole does not see blurs into the picture: with a border it is there, without it is lost.
TEST_F(MultiviewSynthesis, TheBorderHoldsWhatBlursIntoThePicture) {
  engine::Scene scene;
  support::addFacingQuad(scene, 2.0, 0.0, 0.0, 9.0, 9.0, support::addMaterial(scene, {0.2f, 0.2f, 0.2f, 1.0f}));
  auto shot = support::smallShot(96, 54);
  shot.lens.apertureRadius = 0.1;
  const double edge = 0.5 * 96 / support::pixelsPerTangent(shot);
  support::addFacingQuad(scene, 0.5, 0.5 * edge + 0.051, 0.0, 0.05, 9.0, support::addMaterial(scene, {5, 1, 1, 1}));
  const auto truth = reference(scene, shot);
  const ParameterSet many = {{"lensSamples", int64_t{256}}};
  auto without = many;
  without["border"] = 0.0;
  EXPECT_GE(psnr(picture(scene, shot, many), truth), psnr(picture(scene, shot, without), truth) + 10.0);
}

// A long triangle that is routed whole deletes what lies in its layer behind it; split at the borders it does not.
TEST_F(MultiviewSynthesis, SplitTrianglesHideNothing) {
  engine::Scene scene;
  const uint32_t slat = support::addMaterial(scene, {0.9f, 0.2f, 0.1f, 1.0f});
  for (int i = -6; i < 6; ++i) {  // a fence that recedes, seen at a slant
    const float y = 0.12f * static_cast<float>(i);
    support::addQuad(scene, {glm::vec3(-0.5, y, -0.8), {2.0, y, -6.1}, {2.0, y + 0.05, -6.1}, {-0.5, y + 0.05, -0.8}},
                     slat);
  }
  for (int x = -8; x < 8; ++x) {
    support::addFacingQuad(scene, 6.0, 0.6 * x, 0.0, 0.15, 3.0, support::addMaterial(scene, {0.1f, 0.2f, 0.5f, 1.0f}));
  }
  auto shot = support::smallShot(128, 72);
  shot.background = {1.0f, 1.0f, 0.9f};
  shot.lens.apertureRadius = 0.08;
  const auto truth = reference(scene, shot, false);
  const auto split = picture(scene, shot, {{"lensSamples", int64_t{256}}, {"delta", 1.0}});
  const auto whole = picture(scene, shot, {{"lensSamples", int64_t{256}}, {"delta", 1.0}, {"splitTriangles", false}});
  support::keepPicture(split, "multiview_split");
  support::keepPicture(whole, "multiview_whole");
  support::keepPicture(truth, "multiview_split_reference");
  std::printf("split %.2f dB, whole %.2f dB\n", psnr(split, truth), psnr(whole, truth));
  EXPECT_GE(psnr(split, truth), psnr(whole, truth) + 3.0);
}

// With a view for each ray nothing is left to be traced: it is the accumulation buffer.
TEST_F(MultiviewSynthesis, AsManyViewsAsRaysAreTheAccumulation) {
  const auto shot = support::smallShot(96, 54);
  const auto views = picture(
      support::layeredScene(), shot,
      {{"lensSamples", int64_t{16}}, {"views", int64_t{16}}, {"jitter", std::string("none")}, {"coneWidth", 0.0}});
  host::Renderer renderer(support::device(), support::layeredScene(), std::nullopt);
  const auto mean = render(renderer, shot, "accumulation", {{"lensSamples", int64_t{16}}}).color;
  EXPECT_GE(psnr(views, mean), 60.0);
}

// Thousands of rays through 64 layers: no device's limit on loops may end them silently.
TEST_F(MultiviewSynthesis, ManyRaysThroughManyLayersAreAllTraced) {
  engine::Scene scene = support::constantScene(kColor);
  auto shot = support::smallShot(16, 9);
  shot.lens.apertureRadius = 0.05;
  const auto image = picture(
      scene, shot,
      {{"lensSamples", int64_t{4096}}, {"layers", int64_t{64}}, {"culling", false}, {"jitter", std::string("none")}});
  EXPECT_LE(distanceFrom(image, kColor), 1e-3);
  const auto whole = picture(support::layeredScene(), shot, {{"lensSamples", int64_t{4096}}});
  const auto part = picture(support::layeredScene(), shot, {{"lensSamples", int64_t{1024}}});
  EXPECT_GE(psnr(whole, part), 45.0);
}

TEST_F(MultiviewSynthesis, EveryWayOfTracingKeepsAConstantColour) {
  const engine::Scene scene = support::constantScene(kColor);
  auto shot = support::smallShot(61, 33);
  shot.background = {kColor.x, kColor.y, kColor.z};
  shot.lens.apertureRadius = 0.05;
  for (const char* jitter : {"none", "noise", "halton"}) {
    for (const char* search : {"scan", "falsePosition"}) {
      for (const double cone : {0.0, 1.0, 8.0}) {
        const auto image = picture(scene, shot,
                                   {{"jitter", std::string(jitter)},
                                    {"search", std::string(search)},
                                    {"coneWidth", cone},
                                    {"lensSamples", int64_t{8}}});
        EXPECT_LE(distanceFrom(image, kColor), 1e-3) << jitter << " " << search << " " << cone;
      }
    }
  }
}

// One pane in front of the focal plane, one behind it, before a wall: layers keep a pane and what it covers.
TEST_F(MultiviewSynthesis, PanesCoverWhatIsBehindThem) {
  engine::Scene scene;
  support::addFacingQuad(scene, 6.0, 0.0, 0.0, 9.0, 9.0, support::addMaterial(scene, {0.2f, 0.4f, 0.8f, 1.0f}));
  support::addFacingQuad(scene, 4.0, 0.0, 0.0, 9.0, 9.0, support::addMaterial(scene, {1.0f, 0.0f, 0.0f, 0.5f}));
  support::addFacingQuad(scene, 1.0, 0.0, 0.0, 9.0, 9.0, support::addMaterial(scene, {0.0f, 1.0f, 0.0f, 0.25f}));
  const glm::vec3 expected =
      0.25f * glm::vec3(0, 1, 0) + 0.75f * (0.5f * glm::vec3(1, 0, 0) + 0.5f * glm::vec3(0.2f, 0.4f, 0.8f));
  for (const bool culling : {true, false}) {
    const auto image = picture(scene, support::smallShot(64, 36), {{"culling", culling}});
    EXPECT_LE(distanceFrom(image, expected), 2e-3)
        << image.samples[0] << " " << image.samples[1] << " " << image.samples[2];
  }
}

TEST_F(MultiviewSynthesis, BlurOfALightHasTheAperturesShape) {
  auto shot = support::smallShot(96, 96);
  shot.lens.apertureRadius = 0.5;
  shot.lens.bladeCount = 3;
  for (const double depth : {20.0, 1.05}) {
    const auto image = picture(support::lightScene(depth, 2.0, support::pixelsPerTangent(shot)), shot,
                               {{"lensSamples", int64_t{1024}}, {"jitter", std::string("none")}, {"coneWidth", 0.0}});
    support::keepPicture(image, depth > 2.0 ? "multiview_far_triangle" : "multiview_near_triangle");
    const auto spot = support::measureSpot(image);
    const double radius = std::abs(support::thinLensRadius(shot, depth));
    // A triangle with its corners on the circle: variance r²/8 in every direction; one corner up behind the focal plane.
    EXPECT_NEAR(spot.varianceX, radius * radius / 8.0 + 5.0 / 12.0, 0.04 * radius * radius / 8.0);
    EXPECT_NEAR(spot.varianceY, radius * radius / 8.0 + 5.0 / 12.0, 0.04 * radius * radius / 8.0);
    double third = 0.0;
    for (uint32_t y = 0; y < image.height; ++y) {
      for (uint32_t x = 0; x < image.width; ++x) {
        third += double(image.pixel(x, y)[0]) * std::pow(y + 0.5 - spot.y, 3.0);
      }
    }
    EXPECT_TRUE(depth > 2.0 ? third < 0.0 : third > 0.0) << depth;
  }
}

/// Environment of smooth stripes 12 degrees wide.
engine::Environment stripes() {
  engine::FloatImage map(360, 180, 3, 0.0f);
  for (uint32_t y = 0; y < map.height; ++y) {
    for (uint32_t x = 0; x < map.width; ++x) {
      const auto wave = [&](double period, double phase) {
        return static_cast<float>(0.45 + 0.35 * std::sin(2.0 * std::numbers::pi * (x + 0.7 * y) / period + phase));
      };
      float* texel = map.pixel(x, y);
      texel[0] = wave(12.0, 0.0), texel[1] = wave(12.0, 2.0), texel[2] = wave(24.0, 1.0);
    }
  }
  return engine::prepareEnvironment(map);
}

/// Polished panels, the middle one in focus.
engine::Scene polishedScene() {
  engine::Scene scene;
  const auto metal = [&](const glm::vec3& color) {
    const uint32_t index = support::addMaterial(scene, {color, 1.0f});
    auto& material = scene.materials[index];
    material.unlit = false;
    material.metallicFactor = 1.0f;
    material.roughnessFactor = 0.1f;
    return index;
  };
  support::addQuad(scene, {glm::vec3(-0.6, -0.5, -2.1), {0.3, -0.5, -1.9}, {0.3, 0.6, -1.9}, {-0.6, 0.6, -2.1}},
                   metal({0.9f, 0.85f, 0.8f}));
  support::addQuad(scene, {glm::vec3(-4.0, -4.0, -2.8), {4.0, -4.0, -2.4}, {4.0, 4.0, -2.4}, {-4.0, 4.0, -2.8}},
                   metal({0.9f, 0.7f, 0.4f}));
  return scene;
}

TEST_F(MultiviewSynthesis, ViewDependentShadingFollowsTheLens) {
  auto shot = support::smallShot(160, 90);
  shot.shading = host::Shading::lit;
  shot.lens.apertureRadius = 0.1;
  host::Renderer renderer(support::device(), polishedScene(), stripes());
  const auto truth = render(renderer, shot, "accumulation",
                            {{"lensSamples", int64_t{512}}, {"viewsPerFrame", int64_t{64}}, {"pixelJitter", false}})
                         .color;  // without antialiasing, as the paper's reference
  ParameterSet parameters = {{"lensSamples", int64_t{256}}};
  const auto fixed = render(renderer, shot, kName, parameters).color;
  parameters["viewDependent"] = true;
  const auto moving = render(renderer, shot, kName, parameters).color;
  support::keepPicture(fixed, "multiview_gloss_fixed");
  support::keepPicture(moving, "multiview_gloss_moving");
  support::keepPicture(truth, "multiview_gloss_reference");
  const auto fixedError = engine::compareImages(fixed, truth), movingError = engine::compareImages(moving, truth);
  std::printf("view-independent %.2f dB SSIM %.4f, view-dependent %.2f dB SSIM %.4f\n", fixedError.psnr,
              *fixedError.ssim, movingError.psnr, *movingError.ssim);
  EXPECT_GE(movingError.psnr, fixedError.psnr + 12.0);
  EXPECT_GE(*movingError.ssim, 0.97);
}

TEST_F(MultiviewSynthesis, ViewDependenceOfAnUnlitSceneChangesNothing) {
  const auto shot = support::smallShot(64, 36);
  EXPECT_EQ(largestDifference(picture(support::layeredScene(), shot),
                              picture(support::layeredScene(), shot, {{"viewDependent", true}})),
            0.0);
}

TEST_F(MultiviewSynthesis, ExtremesStayFiniteAndConstant) {
  struct Extreme {
    const char* what;
    int width, height;
    double aperture, focus;
    ParameterSet parameters = {};
  };
  const double infinity = std::numeric_limits<double>::infinity();
  const Extreme extremes[] = {
      {"one pixel", 1, 1, 0.05, 2.0},
      {"a row", 1, 37, 0.05, 2.0},
      {"a column", 53, 1, 0.05, 2.0},
      {"focus at infinity", 64, 36, 0.05, infinity},
      {"focus on the near plane", 64, 36, 0.05, 0.01},
      {"focus a millimetre away", 64, 36, 0.01, 1e-3},
      {"focus behind everything", 64, 36, 0.05, 1e7},
      {"a tiny aperture", 64, 36, 1e-6, 2.0},
      {"blur as wide as the picture", 64, 36, 2.0, 2.0},
      {"blur four times as wide", 64, 36, 8.0, 2.0},
      {"one ray", 64, 36, 0.05, 2.0, {{"lensSamples", int64_t{1}}}},
      {"one layer", 64, 36, 0.05, 2.0, {{"layers", int64_t{1}}}},
      {"most layers", 64, 36, 0.05, 2.0, {{"layers", int64_t{64}}, {"splitTriangles", false}}},
      {"most views", 64, 36, 0.05, 2.0, {{"views", int64_t{64}}, {"lensSamples", int64_t{64}}}},
  };
  for (const Extreme& extreme : extremes) {
    auto shot = support::smallShot(extreme.width, extreme.height);
    shot.background = {kColor.x, kColor.y, kColor.z};
    shot.lens.apertureRadius = extreme.aperture;
    shot.lens.focusDistance = extreme.focus;
    const auto image = picture(support::constantScene(kColor), shot, extreme.parameters);
    EXPECT_EQ(support::nonFiniteCount(image), 0u) << extreme.what;
    EXPECT_LE(distanceFrom(image, kColor), 1e-3) << extreme.what;
  }
}

TEST_F(MultiviewSynthesis, AnEmptySceneIsItsBackground) {
  auto shot = support::smallShot(32, 18);
  shot.background = {kColor.x, kColor.y, kColor.z};
  EXPECT_LE(distanceFrom(picture({}, shot), kColor), 1e-6);
}

}  // namespace

}  // namespace lensgraph
