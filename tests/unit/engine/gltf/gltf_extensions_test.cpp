// What glTF 2.0 and its extensions say about nodes and vertices beyond the basics: morph targets, visibility, instancing,
// versions, URIs.
#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "gltf_loading.h"

namespace lensgraph {

namespace {

using test::cornersOf;
using test::GltfBuilder;
using test::Json;
using test::load;
using test::Loaded;
using test::loadFile;
using test::TemporaryFolder;
using test::triangleFile;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

using Vec3s = std::vector<glm::vec3>;

const Vec3s kCorners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

// ---- Morph targets

/// The triangle with two targets: everything 10 to the right, and the last vertex 100 up.
GltfBuilder morphFile() {
  GltfBuilder builder = triangleFile();
  Json& primitive = builder.json["meshes"][0]["primitives"][0];
  const int right = builder.addAccessor(std::vector<float>{10, 0, 0, 10, 0, 0, 10, 0, 0}, "VEC3");
  const int up = builder.add("accessors", {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  const int indices = builder.addView(std::vector<uint8_t>{2}), values = builder.addView(std::vector<float>{0, 100, 0});
  builder.json["accessors"][static_cast<size_t>(up)]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
      {"values", {{"bufferView", values}}}};
  primitive["targets"] = {{{"POSITION", right}}, {{"POSITION", up}}};
  return builder;
}

TEST(GltfMorph, WithoutWeightsNothingMoves) {
  GltfBuilder builder = morphFile();
  const Loaded loaded = load(builder);
  EXPECT_EQ(cornersOf(loaded.scene.primitives.at(0)), kCorners);
  EXPECT_THAT(loaded.warnings, IsEmpty());
}

TEST(GltfMorph, TheMeshsWeightsAreApplied) {
  GltfBuilder builder = morphFile();
  builder.json["meshes"][0]["weights"] = {0.5, 0.25};
  const Loaded loaded = load(builder);
  EXPECT_EQ(cornersOf(loaded.scene.primitives.at(0)), (Vec3s{{5, 0, 0}, {6, 0, 0}, {5, 26, 0}}));
  EXPECT_EQ(loaded.scene.primitives[0].bounds, (engine::Bounds{{5, 0, 0}, {6, 26, 0}}));
}

TEST(GltfMorph, ANodesWeightsComeBeforeTheMeshs) {
  GltfBuilder builder = morphFile();
  builder.json["meshes"][0]["weights"] = {0.5, 0.25};
  builder.json["nodes"][0]["weights"] = {-1, 0};
  builder.addNode({{"mesh", 0}});
  builder.addNode({{"mesh", 0}, {"weights", {-1, 0}}});
  const Loaded loaded = load(builder);
  ASSERT_EQ(loaded.scene.instances.size(), 3u);
  const auto cornersOfNode = [&](size_t i) {
    return cornersOf(loaded.scene.primitives[loaded.scene.instances[i].primitive]);
  };
  EXPECT_EQ(cornersOfNode(0), (Vec3s{{-10, 0, 0}, {-9, 0, 0}, {-10, 1, 0}}));
  EXPECT_EQ(cornersOfNode(1), (Vec3s{{5, 0, 0}, {6, 0, 0}, {5, 26, 0}}));
  EXPECT_EQ(loaded.scene.instances[0].primitive, loaded.scene.instances[2].primitive);
  EXPECT_EQ(loaded.scene.primitives.size(), 2u);
}

TEST(GltfMorph, NormalsAndTangentsMoveToo) {
  GltfBuilder builder = triangleFile();
  Json& primitive = builder.json["meshes"][0]["primitives"][0];
  const auto triple = [&](std::vector<float> one, const char* type) {
    std::vector<float> three;
    for (int i = 0; i < 3; ++i) three.insert(three.end(), one.begin(), one.end());
    return builder.addAccessor(three, type);
  };
  primitive["attributes"]["NORMAL"] = triple({0, 0, 1}, "VEC3");
  primitive["attributes"]["TANGENT"] = triple({1, 0, 0, -1}, "VEC4");
  primitive["targets"] = {{{"NORMAL", triple({2, 0, 0}, "VEC3")},
                           {"TANGENT", triple({0, 0, -2}, "VEC3")},
                           {"TEXCOORD_0", triple({0, 0}, "VEC2")}}};
  builder.json["meshes"][0]["weights"] = {0.5};
  const Loaded loaded = load(builder);
  ASSERT_EQ(loaded.error, "");
  EXPECT_NEAR(loaded.scene.primitives[0].normals[0].x, std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(loaded.scene.primitives[0].normals[0].z, std::sqrt(0.5), 1e-6);
  EXPECT_EQ(loaded.scene.primitives[0].tangents[0], glm::vec4(1, 0, -1, -1));
  EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("morph targets move no TEXCOORD_0")));
}

TEST(GltfMorph, FlatNormalsAreThoseOfTheMovedTriangle) {
  GltfBuilder builder = triangleFile();
  builder.json["meshes"][0]["primitives"][0]["targets"] = {
      {{"POSITION", builder.addAccessor(std::vector<float>{0, 0, 0, 0, 0, 0, 0, -1, 1}, "VEC3")}}};
  builder.json["meshes"][0]["weights"] = {1};
  EXPECT_EQ(load(builder).scene.primitives.at(0).normals.at(0), glm::vec3(0, -1, 0));
}

TEST(GltfMorph, BadTargetsAreNamed) {
  const auto errorWith = [](const Json& targets, const Json& weights) {
    GltfBuilder builder = morphFile();
    builder.addAccessor(std::vector<float>(12, 1.0f), "VEC3");  // accessor 3
    builder.json["meshes"][0]["primitives"][0]["targets"] = targets;
    builder.json["meshes"][0]["weights"] = weights;
    return load(builder).error;
  };
  EXPECT_THAT(errorWith({{{"POSITION", 3}}}, {1}),
              StartsWith("meshes[0].primitives[0].targets[0].POSITION: has 4 elements, POSITION has 3"));
  EXPECT_EQ(errorWith({{{"POSITION", 3}}}, {0}), "");
  EXPECT_THAT(errorWith({{{"POSITION", 77}}}, {1}),
              StartsWith("meshes[0].primitives[0].targets[0].POSITION: index 77"));
  EXPECT_THAT(errorWith({{{"POSITION", 1}}}, {1e300}), HasSubstr("targets[0].POSITION: is too large"));
}

TEST(GltfMorph, TheSampleIsNoLongerFlat) {
  const std::filesystem::path file =
      std::filesystem::path(LENSGRAPH_SHOTS_DIR) / "../cases/scenes/17_SimpleMorph_default_weights.gltf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const Loaded loaded = loadFile(file);
  EXPECT_EQ(loaded.scene.primitives.at(0).bounds.max.y, 1.5);
}

// ---- Nodes

TEST(GltfVisibility, HidesANodeAndAllBelow) {
  GltfBuilder builder = triangleFile();
  const Json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
  const Json shown = {{"KHR_node_visibility", {{"visible", true}}}};
  builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_node_visibility"};
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  builder.json["nodes"] = {{{"mesh", 0}, {"children", {1, 2, 3}}, {"extensions", hidden}},
                           {{"mesh", 0}, {"extensions", shown}},
                           {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
                           {{"camera", 0}},
                           {{"mesh", 0}, {"name", "seen"}, {"extensions", {{"KHR_node_visibility", Json::object()}}}}};
  builder.json["scenes"][0]["nodes"] = {0, 4};
  const Loaded loaded = load(builder);
  ASSERT_EQ(loaded.error, "");
  ASSERT_EQ(loaded.scene.instances.size(), 1u);
  EXPECT_EQ(loaded.scene.instances[0].name, "seen");
  EXPECT_THAT(loaded.scene.lights, IsEmpty());
  EXPECT_EQ(loaded.scene.cameras.size(), 1u);  // one may look out of what is hidden
}

/// Where instance i puts a point.
glm::dvec3 moved(const Loaded& loaded, size_t i, const glm::dvec3& point) {
  return glm::dvec3(loaded.scene.instances.at(i).worldFromObject * glm::dvec4(point, 1.0));
}

GltfBuilder instancedFile(const Json& attributes) {
  GltfBuilder builder = triangleFile();
  builder.json["nodes"][0]["translation"] = {0, 0, -5};
  builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
  return builder;
}

TEST(GltfInstancing, PlacesTheMeshInTheNodesSpace) {
  GltfBuilder builder = instancedFile({{"TRANSLATION", 1}, {"ROTATION", 2}, {"SCALE", 3}, {"_COLOR", 1}});
  const float half = std::sqrt(0.5f);
  builder.addAccessor(std::vector<float>{1, 2, 3, 0, 0, 0}, "VEC3");
  builder.addAccessor(std::vector<float>{0, 0, half, half, 0, 0, 0, 1}, "VEC4");
  builder.addAccessor(std::vector<float>{2, 1, 1, 1, 1, 4}, "VEC3");
  builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const Loaded loaded = load(builder);
  ASSERT_EQ(loaded.scene.instances.size(), 2u) << loaded.error;
  EXPECT_THAT(loaded.warnings, IsEmpty());
  EXPECT_EQ(loaded.scene.primitives.size(), 1u);
  EXPECT_LT(glm::distance(moved(loaded, 0, {1, 0, 0}), glm::dvec3(1, 4, -2)), 1e-6);
  EXPECT_LT(glm::distance(moved(loaded, 1, {1, 0, 1}), glm::dvec3(1, 0, -1)), 1e-6);
}

TEST(GltfInstancing, RotationsMayBeNormalizedIntegers) {
  for (bool isByte : {true, false}) {
    GltfBuilder builder = instancedFile({{"ROTATION", 1}});
    if (isByte) builder.addAccessor(std::vector<int8_t>{0, 0, 90, 90}, "VEC4", true);
    if (!isByte) builder.addAccessor(std::vector<int16_t>{0, 0, -23170, 23170}, "VEC4", true);
    const Loaded loaded = load(builder);
    ASSERT_EQ(loaded.error, "");
    EXPECT_LT(glm::distance(moved(loaded, 0, {1, 0, 0}), glm::dvec3(0, isByte ? 1 : -1, -5)), 1e-6);
  }
}

TEST(GltfInstancing, BadAttributesAreNamed) {
  GltfBuilder counts = instancedFile({{"TRANSLATION", 1}, {"SCALE", 2}});
  counts.addAccessor(std::vector<float>(6, 1.0f), "VEC3");
  counts.addAccessor(std::vector<float>(9, 1.0f), "VEC3");
  const std::string field = "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.";
  EXPECT_THAT(load(counts).error, StartsWith(field + "TRANSLATION: has 2 elements, another attribute has 3"));
  GltfBuilder rotation = instancedFile({{"ROTATION", 1}});
  rotation.addAccessor(std::vector<float>(4, 0.0f), "VEC4");
  EXPECT_THAT(load(rotation).error, StartsWith(field + "ROTATION: element 0 has length 0"));
  GltfBuilder type = instancedFile({{"TRANSLATION", 1}});
  type.addAccessor(std::vector<int16_t>(3, 1), "VEC3");
  EXPECT_THAT(load(type).error, StartsWith(field + "TRANSLATION: its accessor's component type 5122"));
  GltfBuilder many = instancedFile({{"TRANSLATION", 1}});
  many.add("accessors", {{"componentType", 5126}, {"count", 16000000}, {"type", "VEC3"}});
  EXPECT_THAT(load(many).error, HasSubstr("asks for more geometry than the file holds"));
}

TEST(GltfNodes, MatricesOfOtherThanTransformsAreRefused) {
  GltfBuilder builder = triangleFile();
  for (size_t i : {3u, 7u, 11u, 15u}) {
    Json matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    builder.json["nodes"][0]["matrix"] = matrix;
    EXPECT_EQ(load(builder).error, "");
    builder.json["nodes"][0]["matrix"][i] = 0.5;
    EXPECT_THAT(load(builder).error, StartsWith("nodes[0].matrix: its last row is not 0 0 0 1"));
  }
}

// ---- Versions and containers

TEST(GltfVersions, OneIsRefusedBeforeItsStructure) {
  const TemporaryFolder folder;
  const auto errorOf = [&](const std::string& text) {
    std::ofstream(folder / "a.gltf") << text;
    return loadFile(folder / "a.gltf").error;
  };
  const std::string expected = "is glTF 1.0, which is not read; convert it to glTF 2.0";
  EXPECT_EQ(errorOf(R"({"asset":{"version":"1.0"},"buffers":{"a":{"uri":"a.bin"}}})"), expected);
  EXPECT_EQ(errorOf(R"({"asset":{"version":1.0},"meshes":{}})"), expected);
  EXPECT_EQ(errorOf(R"({"accessors":{"a":{}}})"), expected);
  EXPECT_THAT(errorOf(R"({"asset":{"version":"3.0"}})"), StartsWith("asset.version: glTF 3.0 is not read"));
  test::writeBytes(folder / "a.gltf",
                   std::vector<uint8_t>{'g', 'l', 'T', 'F', 1, 0, 0, 0, 20, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(loadFile(folder / "a.gltf").error, expected);
}

TEST(GltfVersions, TheLeastVersionCounts) {
  GltfBuilder builder = triangleFile();
  builder.json["asset"]["version"] = "2.1";
  builder.json["asset"]["minVersion"] = "2.0";
  EXPECT_EQ(load(builder).error, "");
  builder.json["asset"]["minVersion"] = "2.1";
  EXPECT_THAT(load(builder).error, StartsWith("asset.minVersion: needs glTF 2.1, only 2.0 is read"));
  builder.json["asset"]["minVersion"] = "2.10.3";
  EXPECT_THAT(load(builder).error, StartsWith("asset.minVersion: '2.10.3' is no version"));
}

TEST(GltfVersions, OtherFilesAreNoGltf) {
  const TemporaryFolder folder;
  for (const std::string& text : {std::string(1000, '\0'),
                                  std::string("\x7f"
                                              "ELF..."),
                                  std::string("<gltf/>"), std::string("   \n")}) {
    std::ofstream(folder / "a.glb", std::ios::binary) << text;
    EXPECT_EQ(loadFile(folder / "a.glb").error, "is neither glTF nor GLB");
  }
}

TEST(GltfJson, MembersThatAreGivenTwiceAreNamed) {
  const TemporaryFolder folder;
  const auto errorOf = [&](const std::string& text) {
    std::ofstream(folder / "a.gltf") << text;
    return loadFile(folder / "a.gltf").error;
  };
  EXPECT_EQ(errorOf(R"({"asset":{"version":"2.0"},"asset":{"version":"2.0"}})"),
            "asset: is given twice; remove one of them");
  EXPECT_EQ(errorOf(R"({"asset":{"version":"2.0"},"nodes":[1,{},{"a":{"b":[[],{"c":1,"c":2}]}}]})"),
            "nodes[2].a.b[1].c: is given twice; remove one of them");
  EXPECT_EQ(errorOf(R"({"asset":{"version":"2.0"},"nodes":[{"name":"a"},{"name":"a"}]})"), "");
}

// ---- URIs

TEST(GltfUri, DataMayBePercentEncodedOrNoBase64) {
  const GltfBuilder triangle = triangleFile();
  std::string percent, base64 = test::base64(triangle.binary), escaped;
  for (uint8_t byte : triangle.binary) {
    const char* digits = "0123456789abcdef";
    percent += {'%', digits[byte >> 4], digits[byte & 15]};
  }
  for (char c : base64) {
    if (c == '/') {
      escaped += "%2F";
    } else if (c == '=') {
      escaped += "%3D";
    } else {
      escaped += c;
    }
  }
  for (const std::string& uri :
       {"data:application/octet-stream," + percent, "data:," + percent,
        "data:application/gltf-buffer;base64," + escaped, "DATA:text/plain;charset=utf-8;BASE64," + base64,
        "data:;base64,\n" + base64.substr(0, 8) + "%0A" + base64.substr(8)}) {
    GltfBuilder builder = triangle;
    builder.json["buffers"] = {{{"byteLength", builder.binary.size()}, {"uri", uri}}};
    const Loaded loaded = load(builder);
    ASSERT_EQ(loaded.error, "") << uri;
    EXPECT_EQ(cornersOf(loaded.scene.primitives.at(0)), kCorners);
  }
}

TEST(GltfUri, NamesArePercentDecoded) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangleFile();
  test::writeBytes(folder / "größe 100%.bin", builder.binary);
  builder.json["buffers"] = {{{"byteLength", builder.binary.size()}, {"uri", "gr%C3%B6%C3%9Fe%20100%25.bin"}}};
  EXPECT_EQ(loadFile(builder.write(folder)).error, "");
  builder.json["buffers"][0]["uri"] = "a%00.bin";
  EXPECT_THAT(loadFile(builder.write(folder)).error, HasSubstr("no such file"));
}

}  // namespace

}  // namespace lensgraph
