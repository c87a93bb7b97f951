// The five laws that every technique is held to.
//   1. aperture 0 gives the pinhole picture, bit for bit
//   2. a scene of one constant colour gives that colour everywhere, border included
//   3. nothing non-finite comes out, whatever finite goes in; what is not finite does not spread
//   4. the same inputs give the same bits, run to run
//   5. exactly the fields of the lens that it lists as ignored change nothing
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "passes/registry/registry.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph {

namespace {

using passes::ParameterSet;
using support::render;

/// Few enough views to take little time; the laws hold for any number.
const passes::QuickSettings& quickSettings(const std::string& technique) {
  return passes::findTechnique(technique)->quick;
}

ParameterSet quick(const std::string& technique) {
  return quickSettings(technique).parameters;
}

std::vector<std::string> techniqueNames() {
  std::vector<std::string> names;
  for (const auto& technique : passes::techniques()) names.emplace_back(technique.name);
  return names;
}

class Laws : public support::GpuTest, public testing::WithParamInterface<std::string> {};

TEST_P(Laws, ApertureZeroIsThePinholePictureBitForBit) {
  host::Renderer renderer(support::device(), support::layeredScene(), std::nullopt);
  auto shot = support::smallShot(160, 90);
  shot.lens.apertureRadius = 0.0;
  const ParameterSet sharp = {{"pixelSamples", int64_t{quickSettings(GetParam()).pixelSamples}}};
  const auto pinhole = render(renderer, shot, "pinhole", sharp);
  const auto picture = render(renderer, shot, GetParam(), quick(GetParam()));
  EXPECT_TRUE(picture.color.samples == pinhole.color.samples);

  shot.lens.apertureRadius = -1.0;
  shot.lens.fStop = 0.0;
  EXPECT_TRUE(render(renderer, shot, GetParam(), quick(GetParam())).color.samples == pinhole.color.samples);
}

TEST_P(Laws, ConstantColourStaysConstant) {
  const glm::vec3 color(0.25f, 3.0f, 0.001f);
  host::Renderer renderer(support::device(), support::constantScene(color), std::nullopt);
  auto shot = support::smallShot(97, 61);
  shot.background = {color.x, color.y, color.z};
  shot.lens.apertureRadius = 0.05;
  const auto picture = render(renderer, shot, GetParam(), quick(GetParam())).color;
  double worst = 0.0;
  for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(double(picture.samples[i * 4 + c]) / double(color[c]) - 1.0));
    EXPECT_EQ(picture.samples[i * 4 + 3], 1.0f);
  }
  EXPECT_LE(worst, 1e-3);
}

TEST_P(Laws, FiniteInputsGiveFinitePictures) {
  for (const float radiance : {0.0f, 1e-40f, 65504.0f, 1e30f, std::numeric_limits<float>::max()}) {
    engine::Scene scene = support::layeredScene();
    support::addFacingQuad(scene, 1.0, 0.2, 0.1, 0.05, 0.1,
                           support::addMaterial(scene, {radiance, -radiance, radiance, 1.0f}));
    host::Renderer renderer(support::device(), scene, std::nullopt);
    const auto picture = render(renderer, support::smallShot(64, 36), GetParam(), quick(GetParam()));
    EXPECT_EQ(support::nonFiniteCount(picture.color), 0u) << "radiance " << radiance;
  }
}

TEST_P(Laws, NonFiniteInputDoesNotSpread) {
  engine::Scene scene = support::layeredScene();
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  support::addFacingQuad(scene, 1.0, 0.2, 0.1, 0.01, 0.01, support::addMaterial(scene, {nan, inf, 0.0f, 1.0f}));
  host::Renderer renderer(support::device(), scene, std::nullopt);
  const auto picture = render(renderer, support::smallShot(64, 36), GetParam(), quick(GetParam()));
  EXPECT_EQ(support::nonFiniteCount(picture.color), 0u);
  EXPECT_GT(picture.statistics.replacedTexels, 0u);
}

TEST_P(Laws, EveryRunGivesTheSameBits) {
  host::Renderer renderer(support::device(), support::layeredScene(), std::nullopt);
  host::Renderer another(support::device(), support::layeredScene(), std::nullopt);
  const auto shot = support::smallShot(131, 77);
  const auto first = render(renderer, shot, GetParam(), quick(GetParam())).color.samples;
  EXPECT_TRUE(first == render(renderer, shot, GetParam(), quick(GetParam())).color.samples);
  EXPECT_TRUE(first == render(another, shot, GetParam(), quick(GetParam())).color.samples);
}

/// One change of a lens that has an aperture of five straight blades.
struct LensChange {
  std::string field;
  std::function<void(passes::Lens&)> make;
};

TEST_P(Laws, ExactlyTheListedLensFieldsAreIgnored) {
  if (GetParam() == "pinhole") return;  // It has no lens.
  const LensChange changes[] = {
      {"bladeCount", [](auto& lens) { lens.bladeCount = 3; }},
      {"bladeRotation", [](auto& lens) { lens.bladeRotation = 0.6; }},
      {"bladeCurvature", [](auto& lens) { lens.bladeCurvature = 1.0; }},
      {"anamorphicRatio", [](auto& lens) { lens.anamorphicRatio = 2.0; }},
      {"opticalVignetting", [](auto& lens) { lens.opticalVignetting = 1.0; }},
      {"sphericalAberration", [](auto& lens) { lens.sphericalAberration = 1.0; }},
      {"maxCocRadius", [](auto& lens) { lens.maxCocRadius = 0.01; }},
  };
  host::Renderer renderer(support::device(), support::layeredScene(), std::nullopt);
  auto shot = support::smallShot(64, 36);
  shot.lens.apertureRadius = 0.1;
  shot.lens.bladeCount = 5;
  const auto plain = render(renderer, shot, GetParam(), quick(GetParam())).color.samples;
  const auto& ignored = passes::findTechnique(GetParam())->ignoredLensFields;
  for (const auto& [field, make] : changes) {
    auto changed = shot;
    make(changed.lens);
    const bool isSame = render(renderer, changed, GetParam(), quick(GetParam())).color.samples == plain;
    EXPECT_EQ(isSame, std::ranges::find(ignored, field) != ignored.end())
        << field << (isSame ? " changed nothing" : " changed the picture");
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Laws, testing::ValuesIn(techniqueNames()), [](const auto& info) { return info.param; });

class LawsOfApply : public support::GpuTest, public testing::WithParamInterface<double> {};

TEST_P(LawsOfApply, BrokenPixelsOfAPictureDoNotComeOut) {
  engine::FloatImage color(33, 17, 3, 0.5f), depth(33, 17, 1, 4.0f);
  color.pixel(7, 5)[1] = std::numeric_limits<float>::quiet_NaN();
  color.pixel(20, 3)[0] = std::numeric_limits<float>::infinity();
  passes::Lens lens;
  lens.apertureRadius = GetParam();
  lens.focusDistance = 2.0;
  host::Renderer renderer(support::device());
  host::RenderOptions options;
  options.technique = "two_pass_filter";
  const auto rendering = renderer.apply(color, depth, 40.0, lens, options);
  EXPECT_EQ(support::nonFiniteCount(rendering.color), 0u);
  EXPECT_EQ(rendering.statistics.replacedTexels, 2u);
  EXPECT_NEAR(rendering.color.pixel(28, 14)[2], 0.5f, 1e-4f);
}

INSTANTIATE_TEST_SUITE_P(Apertures, LawsOfApply, testing::Values(0.0, 0.05));

}  // namespace

}  // namespace lensgraph
