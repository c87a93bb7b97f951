// The large scenes hold what their documentation promises, and the loader takes them as they are.
#include "heavy/heavy_scenes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/gltf/load_gltf.h"
#include "engine/image/image_io.h"
#include "engine/scene/scene.h"
#include "heavy/depth_complexity.h"
#include "samples/host/shot.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph {
namespace {

using testing::IsEmpty;

/// What is written of a scene, and what is read back.
struct WrittenScene {
  scenes::HeavyScene made;
  std::vector<uint8_t> bytes;
  engine::Scene loaded;
  std::vector<std::string> warnings;
};

WrittenScene writeAndLoad(scenes::HeavyScene (*make)(), const test::TemporaryFolder& folder) {
  WrittenScene scene{make(), {}, {}, {}};
  const std::filesystem::path file = folder / "scene.glb";
  scene.made.scene.glb.write(file);
  scene.bytes = test::readBytes(file);
  scene.warnings = engine::appendGltf(scene.loaded, file);
  return scene;
}

uint64_t texelsOf(const engine::Scene& scene) {
  uint64_t texels = 0;
  for (const engine::SceneImage& image : scene.images) texels += uint64_t{image.width} * image.height;
  return texels;
}

bool isLitByTextures(const engine::Material& material) {
  return !material.unlit && material.baseColorTexture.isUsed() && material.normalTexture.isUsed() &&
         material.metallicRoughnessTexture.isUsed();
}

/// What all three have in common. texturedMaterials: with base color, normals and roughness from textures, at least.
void expectUsable(const WrittenScene& scene, int64_t texturedMaterials, size_t lights) {
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_THAT(engine::findProblems(scene.loaded), IsEmpty());
  EXPECT_GE(std::ranges::count_if(scene.loaded.materials, isLitByTextures), texturedMaterials);
  EXPECT_GE(texelsOf(scene.loaded), 500'000u);
  EXPECT_GE(scene.loaded.lights.size(), lights);
  const auto glows = [](const engine::Material& material) {
    return material.emissiveStrength * material.emissiveFactor.x > 10.0f;
  };
  const bool isNight = lights > 1;
  EXPECT_EQ(std::ranges::any_of(scene.loaded.materials, glows), isNight) << "highlights";
  EXPECT_LT(scene.bytes.size(), 150'000'000u);
}

/// Near and far field are blurred by 10 px or more, by at most 32.
void expectBlur(const scenes::HeavyScene& scene) {
  const scenes::Extent extent = measure(scene.scene.shots.front(), scene.scene.glb);
  EXPECT_LT(extent.nearCocPx, -10.0);
  EXPECT_GT(extent.nearCocPx, -32.0);
  EXPECT_GT(extent.farCocPx, 10.0);
}

TEST(HeavyScenes, TheStreetHasItsTrianglesTexturesAndLights) {
  const test::TemporaryFolder folder;
  const WrittenScene street = writeAndLoad(scenes::makeStreet, folder);
  expectUsable(street, 12, 5);
  expectBlur(street.made);
  EXPECT_GE(engine::triangleCount(street.loaded), scenes::kStreetTriangles);
  EXPECT_EQ(engine::triangleCount(street.loaded), street.made.scene.glb.worldTriangles().size());
}

TEST(HeavyScenes, TheForestHasItsTrianglesAndTextures) {
  const test::TemporaryFolder folder;
  const WrittenScene forest = writeAndLoad(scenes::makeForest, folder);
  expectUsable(forest, 4, 1);
  expectBlur(forest.made);
  EXPECT_GE(engine::triangleCount(forest.loaded), scenes::kForestTriangles);
}

TEST(HeavyScenes, TheDeepOneHasTenSurfacesBehindAPixelFromAHandToFiftyMeters) {
  const test::TemporaryFolder folder;
  const WrittenScene deep = writeAndLoad(scenes::makeDeep, folder);
  expectUsable(deep, 6, 4);
  expectBlur(deep.made);
  const scenes::Shot& shot = deep.made.scene.shots.front();
  const scenes::DepthComplexity complexity = depthComplexityOf(deep.made.scene.glb, shot.camera, 96);
  EXPECT_GE(complexity.mean(), scenes::kDeepSurfaces);
  EXPECT_GE(complexity.shareOfAtLeast(10), 0.8) << "ten are to lie behind most pixels, not many behind a few";
  const scenes::Extent extent = measure(shot, deep.made.scene.glb);
  EXPECT_LT(extent.nearDepth, 0.34);
  EXPECT_GT(extent.farDepth, 50.0);
}

TEST(HeavyScenes, AreTheSameBytesEachTime) {
  const test::TemporaryFolder folder;
  for (scenes::HeavyScene (*make)() : {scenes::makeStreet, scenes::makeForest, scenes::makeDeep}) {
    std::vector<std::vector<uint8_t>> bytes;
    for (int run = 0; run < 2; ++run) {
      make().scene.glb.write(folder / "scene.glb");
      bytes.push_back(test::readBytes(folder / "scene.glb"));
    }
    EXPECT_TRUE(bytes[0] == bytes[1]) << make().name;
  }
}

TEST(HeavyScenes, AShotFileNamesItsSceneItsSkyAndLitShading) {
  const test::TemporaryFolder folder;
  const scenes::Shot made{.name = "deep",
                          .description = "",
                          .camera = {},
                          .lens = {.apertureRadius = 0.02},
                          .lit = true,
                          .environment = "deep_sky.exr"};
  scenes::writeSky(folder / "deep_sky.exr", {});
  test::writeBytes(folder / "deep.glb", {});
  writeShot(folder / "deep.json", made, "deep.glb");
  const host::Shot shot = host::readShot(folder / "deep.json");
  EXPECT_EQ(shot.shading, host::Shading::lit);
  EXPECT_EQ(shot.width, 640);
  EXPECT_EQ(shot.height, 360);
  EXPECT_EQ(shot.scene.at(0).path, folder / "deep.glb");
  EXPECT_EQ(shot.environment, folder / "deep_sky.exr");
}

}  // namespace
}  // namespace lensgraph
