// Each warning comes when it should, names what to change, and stays away otherwise.
#include "samples/host/warnings.h"

#include <gmock/gmock.h>

#include "engine/scene/camera.h"
#include "passes/registry/registry.h"

namespace lensgraph::host {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Optional;

const passes::Technique& techniqueNamed(std::string_view name) {
  return *passes::findTechnique(name);
}

/// One triangle that faces a camera at the origin, at that view depth.
engine::Scene sceneAt(float depth) {
  engine::Scene scene;
  scene.materials.emplace_back();
  engine::Primitive& primitive = scene.primitives.emplace_back();
  primitive.positions = {{0, 0, -depth}, {1, 0, -depth}, {0, 1, -depth}};
  primitive.indices = {0, 1, 2};
  primitive.material = 0;
  for (const auto& position : primitive.positions) primitive.bounds.add(glm::dvec3(position));
  scene.instances.push_back({.primitive = 0, .worldFromObject = glm::dmat4(1.0), .name = {}});
  return scene;
}

TEST(IgnoredLensWarning, NamesTheFieldsThatAreSetAndIgnored) {
  passes::Lens lens;
  EXPECT_FALSE(ignoredLensWarning(lens, techniqueNamed("two_pass_filter")));
  lens.bladeCount = 5;
  lens.anamorphicRatio = 2.0;
  lens.maxCocRadius = 0.1;
  EXPECT_THAT(ignoredLensWarning(lens, techniqueNamed("two_pass_filter")),
              Optional(std::string("two_pass_filter ignores lens.bladeCount and lens.anamorphicRatio")));
  EXPECT_THAT(ignoredLensWarning(lens, techniqueNamed("accumulation")),
              Optional(std::string("accumulation ignores lens.maxCocRadius")));
  EXPECT_FALSE(ignoredLensWarning(lens, techniqueNamed("pinhole")));
  EXPECT_THAT(ignoredLensWarning(lens, techniqueNamed("multilayer_filtering")),
              Optional(std::string("multilayer_filtering lets only the blur's size follow lens.bladeCount and "
                                   "lens.anamorphicRatio")));
  lens.bladeRotation = 0.1;
  EXPECT_THAT(ignoredLensWarning(lens, techniqueNamed("multilayer_filtering")),
              Optional(HasSubstr("ignores lens.bladeRotation, and lets only")));
  lens.fStop = 0.0;
  EXPECT_FALSE(ignoredLensWarning(lens, techniqueNamed("two_pass_filter"))) << "nothing is blurred";
}

TEST(InvisibleSceneWarning, SaysWhy) {
  engine::Camera camera;
  camera.viewFromWorld = glm::dmat4(1.0);
  camera.nearPlane = 0.01;
  EXPECT_THAT(invisibleSceneWarning(engine::Scene{}, camera, 1.0), HasSubstr("nothing to draw"));
  EXPECT_THAT(invisibleSceneWarning(sceneAt(-1.0f), camera, 1.0), HasSubstr("behind the camera"));
  EXPECT_THAT(
      invisibleSceneWarning(sceneAt(5.0f), camera, 0.001),
      AllOf(HasSubstr("near plane of 0.01 m"), HasSubstr("ends at 0.005 m"), HasSubstr("camera.near to 0.0025")));
  EXPECT_THAT(invisibleSceneWarning(sceneAt(5.0f), camera, 1.0), HasSubstr("check the camera"));
}

TEST(BackFacesWarning, ComesForAPictureOfTheBackgroundAlone) {
  engine::Scene scene = sceneAt(1.0f);
  engine::FloatImage picture(4, 4, 4, 0.5f);
  const std::array background = {0.5f, 0.5f, 0.5f};
  EXPECT_THAT(backFacesWarning(picture, background, scene), Optional(HasSubstr("seen from behind")));
  EXPECT_FALSE(backFacesWarning(picture, {0.5f, 0.5f, 0.0f}, scene));
  scene.materials[0].doubleSided = true;
  EXPECT_FALSE(backFacesWarning(picture, background, scene));
}

TEST(UnlitSceneWarning, ComesOnlyWhereEverythingIsBlack) {
  engine::Scene scene = sceneAt(1.0f);
  EXPECT_THAT(unlitSceneWarning(scene, false), Optional(HasSubstr("no lights")));
  EXPECT_FALSE(unlitSceneWarning(scene, true));
  scene.materials[0].emissiveFactor = glm::vec3(0.5f);
  EXPECT_FALSE(unlitSceneWarning(scene, false));
  scene.materials[0] = {};
  scene.materials[0].unlit = true;
  EXPECT_FALSE(unlitSceneWarning(scene, false));
  scene.materials[0] = {};
  scene.lights.emplace_back();
  EXPECT_FALSE(unlitSceneWarning(scene, false));
}

TEST(ListRoomWarning, CountsWhatIsMissing) {
  shared::FrameStatistics statistics{};
  EXPECT_FALSE(listRoomWarning(statistics));
  statistics.fragmentNodes = 100;
  statistics.fragmentNodesDropped = 7;
  EXPECT_THAT(listRoomWarning(statistics), Optional(HasSubstr("no room for 7 of 100 fragments")));
}

TEST(LimitedBlurWarning, NamesTheLimitThatCounts) {
  const auto& technique = techniqueNamed("two_pass_filter");
  passes::Lens lens;
  EXPECT_FALSE(limitedBlurWarning(0, lens, technique, {}, 360));
  EXPECT_THAT(limitedBlurWarning(7, lens, technique, {}, 360),
              Optional(std::string("maxRadius (256 px) limited the blur of 7 pixels")));
  EXPECT_THAT(limitedBlurWarning(7, lens, technique, {{"maxRadius", 20.0}}, 360),
              Optional(HasSubstr("maxRadius (20 px)")));
  lens.maxCocRadius = 0.05;  // 18 px
  EXPECT_THAT(limitedBlurWarning(7, lens, technique, {{"maxRadius", 20.0}}, 360),
              Optional(HasSubstr("lens.maxCocRadius (0.05 of the picture's height)")));
  EXPECT_THAT(limitedBlurWarning(7, lens, techniqueNamed("multilayer_filtering"), {}, 360),
              Optional(HasSubstr("lens.maxCocRadius")));
}

TEST(ClippedPictureWarning, GivesAnExposureThatHelps) {
  engine::FloatImage picture(10, 10, 4, 1.0f);
  EXPECT_FALSE(clippedPictureWarning(picture, 0.0)) << "white is not clipped";
  EXPECT_TRUE(clippedPictureWarning(picture, 1.0));
  for (std::size_t i = 0; i < 50; ++i) picture.samples[4 * i + 1] = 100.0f;
  EXPECT_FALSE(clippedPictureWarning(picture, 0.0)) << "half of it is";
  picture.samples[4 * 50] = 8.0f;
  EXPECT_THAT(clippedPictureWarning(picture, 0.0),
              Optional(AllOf(HasSubstr("51 % of the pixels"), HasSubstr("--exposure -6.7"))));
  EXPECT_FALSE(clippedPictureWarning(picture, -6.7));
}

}  // namespace
}  // namespace lensgraph::host
