// Nodes, cameras, lights, extensions, and several files in one scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/error.h"
#include "engine/gltf/load_gltf.h"
#include "gltf_builder.h"

namespace lensgraph {

namespace {

using engine::FileTransform;
using engine::Scene;
using test::GltfBuilder;
using test::Json;
using test::TemporaryFolder;
using test::triangleFile;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Scene load(GltfBuilder& builder, std::vector<std::string>* warnings = nullptr) {
  const TemporaryFolder folder;
  Scene scene;
  const auto found = engine::appendGltf(scene, builder.write(folder));
  if (warnings != nullptr) *warnings = found;
  return scene;
}

void expectPoint(const glm::dmat4& matrix, const glm::dvec3& point, const glm::dvec3& expected,
                 double tolerance = 1e-12) {
  EXPECT_LT(glm::distance(glm::dvec3(matrix * glm::dvec4(point, 1.0)), expected), tolerance);
}

TEST(GltfScene, NodesComposeTranslationRotationScale) {
  GltfBuilder builder = triangleFile();
  const double half = std::sqrt(0.5);
  builder.json["nodes"][0]["translation"] = {1, 0, 0};
  // 90 degrees about +Z, then twice as large: child point (1,0,0) -> (2,0,0) scaled before the turn.
  builder.addNode(
      {{"children", {0}}, {"translation", {0, 0, 5}}, {"rotation", {0, 0, half, half}}, {"scale", {2, 2, 2}}});
  builder.json["scenes"][0]["nodes"] = {1};
  const Scene scene = load(builder);
  ASSERT_EQ(scene.instances.size(), 1u);
  expectPoint(scene.instances[0].worldFromObject, {0, 0, 0}, {0, 2, 5});
  expectPoint(scene.instances[0].worldFromObject, {0, 1, 0}, {-2, 2, 5});
}

TEST(GltfScene, MatricesAreColumnMajor) {
  GltfBuilder builder = triangleFile();
  builder.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1};
  expectPoint(load(builder).instances[0].worldFromObject, {0, 0, 0}, {7, 8, 9});
}

TEST(GltfScene, PositionsAroundAMillionKeepDoublePrecision) {
  GltfBuilder builder = triangleFile();
  builder.json["nodes"][0]["translation"] = {1000000.001, 0, 0};
  builder.addNode({{"children", {0}}, {"translation", {1000000.0, 0, 0}}});
  builder.json["scenes"][0]["nodes"] = {1};
  expectPoint(load(builder).instances[0].worldFromObject, {0, 0, 0}, {2000000.001, 0, 0}, 1e-9);
}

TEST(GltfScene, AMeshPlacedTwiceIsStoredOnce) {
  GltfBuilder builder = triangleFile();
  builder.addNode({{"mesh", 0}, {"translation", {3, 0, 0}}, {"name", "second"}});
  const Scene scene = load(builder);
  EXPECT_EQ(scene.primitives.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].name, "second");
  EXPECT_EQ(engine::triangleCount(scene), 2u);
  EXPECT_EQ(engine::worldBounds(scene), (engine::Bounds{{0, 0, 0}, {4, 1, 0}}));
}

TEST(GltfScene, OnlyTheDefaultSceneIsDrawn) {
  GltfBuilder builder = triangleFile();
  builder.json["nodes"].push_back({{"mesh", 0}, {"name", "other"}});
  builder.json["scenes"].push_back({{"nodes", {1}}});
  builder.json["scene"] = 1;
  const Scene scene = load(builder);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].name, "other");
}

TEST(GltfScene, WithoutScenesTheRootsAreDrawn) {
  GltfBuilder builder = triangleFile();
  builder.json["nodes"].push_back({{"children", {0}}, {"translation", {0, 0, 2}}});
  builder.json.erase("scenes");
  builder.json.erase("scene");
  const Scene scene = load(builder);
  ASSERT_EQ(scene.instances.size(), 1u);
  expectPoint(scene.instances[0].worldFromObject, {0, 0, 0}, {0, 0, 2});
}

TEST(GltfScene, ScaleZeroHides) {
  GltfBuilder builder = triangleFile();
  builder.json["nodes"][0]["scale"] = {0, 0, 0};
  EXPECT_THAT(load(builder).instances, IsEmpty());
}

TEST(GltfScene, EmptyFilesAreLegal) {
  GltfBuilder builder;
  const Scene scene = load(builder);
  EXPECT_THAT(scene.instances, IsEmpty());
  EXPECT_TRUE(engine::worldBounds(scene).isEmpty());
  GltfBuilder bare;
  bare.json = {{"asset", {{"version", "2.0"}}}};
  EXPECT_THAT(load(bare).instances, IsEmpty());
}

TEST(GltfScene, LongChainsOfNodesNeedNoStack) {
  GltfBuilder builder = triangleFile();
  constexpr int kLength = 100000;
  for (int i = 1; i < kLength; ++i) builder.json["nodes"].push_back({{"children", {i - 1}}});
  builder.json["scenes"][0]["nodes"] = {kLength - 1};
  EXPECT_EQ(load(builder).instances.size(), 1u);
}

TEST(GltfScene, Cameras) {
  GltfBuilder builder;
  builder.json["cameras"] = {
      {{"type", "perspective"},
       {"name", "wide"},
       {"perspective", {{"yfov", 1.1}, {"znear", 0.2}, {"aspectRatio", 1.5}}}},
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.3}, {"znear", 0.1}, {"zfar", 50}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 9}}}}};
  builder.addNode({{"camera", 0}, {"name", "node"}, {"translation", {1, 2, 3}}});
  builder.addNode({{"camera", 1}, {"name", "tele"}});
  builder.addNode({{"camera", 2}});
  std::vector<std::string> warnings;
  const Scene scene = load(builder, &warnings);
  ASSERT_EQ(scene.cameras.size(), 3u);
  const engine::SceneCamera* wide = engine::findCamera(scene, "wide");
  ASSERT_NE(wide, nullptr);
  EXPECT_EQ(engine::findCamera(scene, "node"), wide);
  EXPECT_EQ(wide->yfov, 1.1);
  EXPECT_EQ(wide->aspectRatio, 1.5);
  EXPECT_FALSE(wide->zfar.has_value());
  expectPoint(wide->worldFromCamera, {0, 0, 0}, {1, 2, 3});
  ASSERT_NE(engine::findCamera(scene, "tele"), nullptr);
  EXPECT_EQ(engine::findCamera(scene, "tele")->zfar, 50.0);
  EXPECT_EQ(engine::findCamera(scene, "none"), nullptr);
  EXPECT_EQ(scene.cameras[2].type, engine::CameraType::orthographic);
  EXPECT_THAT(warnings, IsEmpty()) << "it is only wrong to choose it";
}

TEST(GltfScene, CamerasAreInTheOrderOfTheFilesListWhateverPlacesThem) {
  GltfBuilder builder;
  for (const char* name : {"first", "unplaced", "second", "third"}) {
    builder.json["cameras"].push_back(
        {{"type", "perspective"}, {"name", name}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  }
  builder.addNode({{"camera", 3}});
  builder.addNode({{"camera", 0}, {"name", "one"}});
  builder.addNode({{"camera", 2}});
  builder.addNode({{"camera", 0}, {"name", "another"}});
  const Scene scene = load(builder);
  std::vector<std::string> names;
  for (const auto& camera : scene.cameras) names.push_back(camera.name + " " + camera.nodeName);
  EXPECT_THAT(names, ElementsAre("first one", "first another", "second ", "third "));
  EXPECT_EQ(scene.cameras[2].fileIndex, 2u);
}

TEST(GltfScene, NonsenseInACameraDoesNotStopTheScene) {
  GltfBuilder builder = triangleFile();
  builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0}, {"znear", 0}}}},
                             {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
  builder.addNode({{"camera", 0}});
  builder.addNode({{"camera", 1}, {"scale", {1e308, 1e308, 1e308}}, {"children", {3}}});
  builder.json["nodes"].push_back({{"camera", 1}, {"scale", {1e308, 1e308, 1e308}}});
  const Scene scene = load(builder);
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.cameras.size(), 3u);
}

TEST(GltfScene, PunctualLights) {
  GltfBuilder builder;
  builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}},
      {{"type", "point"}, {"color", {1, 0.5, 0.25}}, {"intensity", 20}, {"range", 7}, {"name", "bulb"}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}}};
  for (int i = 0; i < 3; ++i) {
    builder.addNode({{"translation", {i, 0, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  }
  std::vector<std::string> warnings;
  const Scene scene = load(builder, &warnings);
  EXPECT_THAT(warnings, IsEmpty());
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].type, engine::LightType::directional);
  EXPECT_EQ(scene.lights[0].color, glm::vec3(1.0f));
  EXPECT_FALSE(scene.lights[0].range.has_value());
  EXPECT_EQ(scene.lights[1].name, "bulb");
  EXPECT_EQ(scene.lights[1].color, glm::vec3(1.0f, 0.5f, 0.25f));
  EXPECT_EQ(scene.lights[1].intensity, 20.0f);
  EXPECT_EQ(scene.lights[1].range, 7.0f);
  expectPoint(scene.lights[1].worldFromLight, {0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(scene.lights[2].type, engine::LightType::spot);
  EXPECT_EQ(scene.lights[2].innerConeAngle, 0.25f);
  EXPECT_EQ(scene.lights[2].outerConeAngle, 0.5f);
}

// Against the specification, and written by exporters for lights with a hard edge.
TEST(GltfScene, ASpotLightMayHaveAHardEdge) {
  GltfBuilder builder;
  builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}}}}};
  builder.addNode({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  EXPECT_EQ(load(builder).lights.at(0).innerConeAngle, 0.5f);
}

TEST(GltfScene, IgnoredExtensionsAndAnimationsAreWarnings) {
  GltfBuilder builder = triangleFile();
  builder.json["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_unlit"};
  builder.json["animations"] = {{{"channels", Json::array()}, {"samplers", Json::array()}}};
  std::vector<std::string> warnings;
  load(builder, &warnings);
  EXPECT_THAT(warnings,
              ElementsAre(HasSubstr("KHR_materials_clearcoat is ignored"), HasSubstr("animations are ignored")));
}

TEST(GltfScene, RequiredExtensionsThatAreNotReadAreNamed) {
  GltfBuilder builder = triangleFile();
  builder.json["extensionsRequired"] = {"KHR_materials_clearcoat", "KHR_texture_transform", "KHR_texture_basisu"};
  try {
    load(builder);
    FAIL() << "no error";
  } catch (const engine::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("extensionsRequired: needs KHR_materials_clearcoat, KHR_texture_basisu"));
  }
}

// ---- Several files

TEST(GltfScene, AppendedFilesKeepTheirOwnMaterials) {
  const TemporaryFolder folder;
  const auto fileWith = [&](const std::string& name, double red) {
    GltfBuilder builder = triangleFile();
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {red, 0, 0, 1}}}}}};
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    return builder.write(folder, name);
  };
  Scene scene;
  engine::appendGltf(scene, fileWith("a.gltf", 0.25));
  engine::appendGltf(scene, fileWith("b.gltf", 0.5), engine::worldFromFileTransform({.translation = {0, 0, -3}}));
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_THAT(engine::findProblems(scene), IsEmpty());
  const auto redOf = [&](size_t instance) {
    return scene.materials[scene.primitives[scene.instances[instance].primitive].material].baseColorFactor.x;
  };
  EXPECT_EQ(redOf(0), 0.25f);
  EXPECT_EQ(redOf(1), 0.5f);
  expectPoint(scene.instances[1].worldFromObject, {0, 0, 0}, {0, 0, -3});
}

TEST(GltfScene, AFailedFileLeavesTheSceneAsItWas) {
  const TemporaryFolder folder;
  Scene scene;
  engine::appendGltf(scene, triangleFile().write(folder));
  GltfBuilder bad = triangleFile();
  bad.addMesh({{"attributes", {{"POSITION", bad.addAccessor(std::vector<float>(9, NAN), "VEC3")}}}});
  EXPECT_THROW(engine::appendGltf(scene, bad.write(folder, "bad.gltf")), engine::Error);
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.primitives.size(), 1u);
  EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(GltfScene, PlacementScalesThenTurnsThenMoves) {
  const double half = std::sqrt(0.5);
  const glm::dmat4 matrix = engine::worldFromFileTransform(
      {.translation = {1, 2, 3}, .rotation = {0, 2 * half, 0, 2 * half}, .scale = {2, 1, 1}});
  expectPoint(matrix, {1, 0, 0}, {1, 2, 1});  // (2,0,0) turned 90 degrees about +Y is (0,0,-2)
}

TEST(GltfScene, PlacementRefusesNonsense) {
  EXPECT_THROW(engine::worldFromFileTransform({.rotation = {0, 0, 0, 0}}), engine::Error);
  EXPECT_THROW(engine::worldFromFileTransform({.translation = {NAN, 0, 0}}), engine::Error);
  EXPECT_THROW(engine::worldFromFileTransform({.scale = {1, INFINITY, 1}}), engine::Error);
}

TEST(Scene, FindsProblemsOfScenesMadeByHand) {
  Scene scene;
  engine::Primitive primitive;
  primitive.positions = {{0, 0, 0}, {NAN, 0, 0}};
  primitive.indices = {0, 1, 2};
  primitive.uvs[0] = {{0, 0}};
  scene.primitives.push_back(primitive);
  scene.instances.push_back({.primitive = 4, .worldFromObject = glm::dmat4(1.0), .name = ""});
  EXPECT_THAT(engine::findProblems(scene),
              testing::UnorderedElementsAre(HasSubstr("primitives[0].material"), HasSubstr("primitives[0].uvs[0]"),
                                            HasSubstr("primitives[0].indices"), HasSubstr("primitives[0].positions"),
                                            HasSubstr("instances[0].primitive")));
}

}  // namespace

}  // namespace lensgraph
