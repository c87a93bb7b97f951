// Damaged and hostile glTF files: every one ends in an engine::Error of one line that names file and field.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "engine/error.h"
#include "engine/gltf/load_gltf.h"
#include "gltf_builder.h"

namespace lensgraph {

namespace {

using engine::Scene;
using test::GltfBuilder;
using test::Json;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::StartsWith;

std::string errorOfFile(const std::filesystem::path& path) {
  try {
    Scene scene;
    engine::appendGltf(scene, path);
  } catch (const engine::Error& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_THAT(line, StartsWith(path.string() + ": "));
    return line.substr(path.string().size() + 2);
  }
  return "no error";
}

/// A file that uses everything once, so that each member can be spoiled.
GltfBuilder fullFile() {
  GltfBuilder builder;
  const int positions = builder.addAccessor(test::kTriangle, "VEC3");                              // accessor 0, view 0
  const int indices = builder.addAccessor(std::vector<uint16_t>{0, 1, 2}, "SCALAR");               // accessor 1, view 1
  const int normals = builder.addAccessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");  // accessor 2, view 2
  const int sparseIndices = builder.addView(std::vector<uint16_t>{1, 2});                          // view 3
  const int sparseValues = builder.addView(std::vector<float>{5, 0, 0, 0, 6, 0});                  // view 4
  builder.json["accessors"][0]["sparse"] = {{"count", 2},
                                            {"indices", {{"bufferView", sparseIndices}, {"componentType", 5123}}},
                                            {"values", {{"bufferView", sparseValues}}}};
  builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}}}}};
  builder.addMesh(
      {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"indices", indices}, {"material", 0}});
  builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  builder.addNode({{"camera", 0}, {"children", Json::array()}});
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  builder.addNode({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  return builder;
}

struct Fault {
  const char* pointer;  ///< JSON pointer of the member to spoil.
  Json value;           ///< kErase: the member is taken out.
  const char* message;
};

std::ostream& operator<<(std::ostream& stream, const Fault& fault) {
  return stream << fault.pointer << " = " << fault.value.dump();
}

const Json kErase = "erase me";

class Malformed : public testing::TestWithParam<Fault> {};

TEST(GltfMalformed, TheFileIsGoodBeforeItIsSpoiled) {
  const TemporaryFolder folder;
  Scene scene;
  engine::appendGltf(scene, fullFile().write(folder));
  EXPECT_EQ(engine::triangleCount(scene), 1u);
  EXPECT_EQ(scene.primitives[0].positions[1].x, 5.0f);
}

TEST_P(Malformed, IsAnErrorThatNamesTheField) {
  const TemporaryFolder folder;
  GltfBuilder builder = fullFile();
  builder.write(folder);  // adds the buffer
  const Json::json_pointer pointer(GetParam().pointer);
  if (GetParam().value == kErase) {
    builder.json.at(pointer.parent_pointer()).erase(pointer.back());
  } else {
    builder.json[pointer] = GetParam().value;
  }
  EXPECT_THAT(errorOfFile(builder.write(folder)), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Indices, Malformed,
    testing::Values(Fault{"/scene", 3, "scene: index 3 is out of range: scenes has 1 element"},
                    Fault{"/scenes/0/nodes/0", 9, "scenes[0].nodes[0]: index 9 is out of range"},
                    Fault{"/nodes/0/mesh", 1, "nodes[0].mesh: index 1 is out of range"},
                    Fault{"/nodes/0/mesh", -1, "nodes[0].mesh: is -1"},
                    Fault{"/nodes/1/camera", 5, "nodes[1].camera: index 5"},
                    Fault{"/nodes/1/children", {77}, "nodes[1].children[0]: index 77"},
                    Fault{"/nodes/0/skin", 0, "nodes[0].skin: index 0 is out of range: skins has 0 elements"},
                    Fault{"/nodes/2/extensions/KHR_lights_punctual/light", 1,
                          "nodes[2].extensions.KHR_lights_punctual.light: index 1"},
                    Fault{"/meshes/0/primitives/0/material", 4, "meshes[0].primitives[0].material: index 4"},
                    Fault{"/meshes/0/primitives/0/indices", 40, "meshes[0].primitives[0].indices: index 40"},
                    Fault{"/meshes/0/primitives/0/attributes/POSITION", 99,
                          "meshes[0].primitives[0].attributes.POSITION: index 99"},
                    Fault{"/accessors/0/bufferView", 50, "accessors[0].bufferView: index 50"},
                    Fault{"/accessors/0/sparse/indices/bufferView", 50,
                          "accessors[0].sparse.indices.bufferView: index 50"},
                    Fault{"/bufferViews/0/buffer", 1, "bufferViews[0].buffer: index 1"},
                    Fault{"/materials/0/pbrMetallicRoughness/baseColorTexture",
                          {{"index", 0}},
                          "baseColorTexture.index: index 0 is out of range"},
                    Fault{"/scene", 4294967296.0, "scene: index 4294967296"}));

INSTANTIATE_TEST_SUITE_P(
    Types, Malformed,
    testing::Values(Fault{"/nodes", 3, "nodes: is not an array"}, Fault{"/nodes/0", "a", "nodes[0]: is not an object"},
                    Fault{"/meshes/0/primitives", kErase, "meshes[0].primitives: is missing"},
                    Fault{"/meshes/0/primitives/0/attributes", {1, 2}, "attributes: is not an object"},
                    Fault{"/accessors/0/count", "three", "accessors[0].count: is \"three\", not an integer"},
                    Fault{"/accessors/0/count", 2.5, "accessors[0].count: is 2.5, not an integer"},
                    Fault{"/accessors/0/count", kErase, "accessors[0].count: is missing"},
                    Fault{"/accessors/0/type", 7, "accessors[0].type: is not a string"},
                    Fault{"/accessors/0/normalized", 1, "accessors[0].normalized: is not true or false"},
                    Fault{"/nodes/0/matrix", {1, 2, 3}, "nodes[0].matrix: has 3 elements instead of 16"},
                    Fault{"/nodes/0/rotation", {0, 0, 0, "w"}, "nodes[0].rotation[3]: is not a number"},
                    Fault{"/nodes/0/rotation", {0, 0, 0, 0}, "nodes[0].rotation: is no rotation"},
                    Fault{"/nodes/0/translation", {1e300, 1e300, 0}, "no error"},
                    Fault{
                        "/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1}, "baseColorFactor: has 2 elements"},
                    Fault{"/materials/0/alphaMode", "GLASS", "materials[0].alphaMode: 'GLASS'"},
                    Fault{"/materials/0/alphaCutoff", 1e300, "materials[0].alphaCutoff: is too large"},
                    Fault{"/asset/version", "1.0", "is glTF 1.0, which is not read; convert it to glTF 2.0"},
                    Fault{"/asset", kErase, "asset: is missing"},
                    Fault{"/extensionsRequired", "KHR_x", "extensionsRequired: is not an array"}));

INSTANTIATE_TEST_SUITE_P(
    Ranges, Malformed,
    testing::Values(
        Fault{"/accessors/0/count", 4, "accessors[0]: reaches past the end of its buffer view"},
        Fault{"/accessors/0/count", 9007199254740992, "accessors[0]: reaches past the end"},
        Fault{"/accessors/0/count", 1e30, "accessors[0].count: is 1e+30"},
        Fault{"/accessors/0/byteOffset", 4, "accessors[0]: reaches past the end"},
        Fault{"/accessors/0/byteOffset", 9007199254740992, "accessors[0]: reaches past the end"},
        Fault{"/meshes/0/primitives/0/mode", 4294967300, "meshes[0].primitives[0].mode: is 4294967300, too large"},
        Fault{"/accessors/0/type", "VEC2", "attributes.POSITION: its accessor has 2 components instead of 3"},
        Fault{"/accessors/0/componentType", 5124, "attributes.POSITION: its accessor's component type 5124"},
        Fault{"/accessors/1/componentType", 5126, "indices: its accessor's component type 5126 is not allowed here"},
        Fault{"/accessors/2/count", 2, "attributes.NORMAL: has 2 elements, POSITION has 3"},
        Fault{"/accessors/0/sparse/count", 4, "accessors[0].sparse.count: is larger"},
        Fault{"/accessors/0/sparse/indices/componentType", 5126, "accessors[0].sparse.indices.componentType: 5126"},
        Fault{"/accessors/0/sparse/indices/byteOffset", 2147483000,
              "accessors[0].sparse.indices: reaches past the end"},
        Fault{"/accessors/0/sparse/indices/byteOffset", 4294967295, "accessors[0].sparse.indices.byteOffset"},
        Fault{"/bufferViews/0/byteLength", 1000000, "bufferViews[0]: bytes 0 + 1000000 are outside its buffer"},
        Fault{"/bufferViews/0/byteOffset", 9007199254740992, "bufferViews[0]: bytes 9007199254740992"},
        Fault{"/buffers/0/byteLength", 1000000, "buffers[0].byteLength: promises 1000000 bytes"},
        Fault{"/buffers/0/uri", "none.bin", "buffers[0].uri: 'none.bin': no such file"},
        Fault{"/buffers/0/uri", kErase, "buffers[0].uri: is missing"},
        Fault{"/meshes/0/primitives/0/mode", 7, "meshes[0].primitives[0].mode: 7 is no mode"},
        Fault{"/meshes/0/primitives/0/attributes/POSITION", kErase,
              "meshes[0].primitives[0].attributes.POSITION: is missing"}));

TEST(GltfMalformed, IndexBeyondTheVertices) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  const int positions = builder.addAccessor(test::kTriangle, "VEC3");
  const int indices = builder.addAccessor(std::vector<uint16_t>{0, 1, 3}, "SCALAR");
  builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  EXPECT_THAT(errorOfFile(builder.write(folder)),
              HasSubstr("meshes[0].primitives[0].indices: element 2 is 3, out of range"));
}

TEST(GltfMalformed, SparseIndexBeyondTheAccessor) {
  const TemporaryFolder folder;
  GltfBuilder builder = fullFile();
  const size_t offset = builder.json["bufferViews"][3]["byteOffset"];
  builder.binary[offset] = 200;
  EXPECT_THAT(errorOfFile(builder.write(folder)), HasSubstr("accessors[0].sparse.indices: index 200 is out of range"));
}

TEST(GltfMalformed, AccessorOfZerosThatClaimsAllMemory) {
  const TemporaryFolder folder;
  GltfBuilder builder = fullFile();
  builder.json["accessors"][0].erase("bufferView");
  builder.json["accessors"][0]["count"] = 4000000000u;
  EXPECT_THAT(errorOfFile(builder.write(folder)),
              HasSubstr("accessors[0].count: asks for more geometry than the file holds"));
}

class NonFinite : public testing::TestWithParam<float> {};

TEST_P(NonFinite, PositionsAreRefused) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  std::vector<float> positions = test::kTriangle;
  positions[7] = GetParam();
  builder.addMesh({{"attributes", {{"POSITION", builder.addAccessor(positions, "VEC3")}}}});
  EXPECT_THAT(errorOfFile(builder.write(folder)),
              HasSubstr("meshes[0].primitives[0].attributes.POSITION: element 2 is not finite"));
}

INSTANTIATE_TEST_SUITE_P(NanAndInfinity, NonFinite, testing::Values(NAN, INFINITY, -INFINITY));

TEST(GltfMalformed, CyclesOfNodes) {
  const TemporaryFolder folder;
  GltfBuilder builder = fullFile();
  builder.json["nodes"][0]["children"] = {1};
  builder.json["nodes"][1]["children"] = {0};
  EXPECT_THAT(errorOfFile(builder.write(folder)), HasSubstr("is reached twice: nodes must form a tree"));
}

TEST(GltfMalformed, TransformsThatOverflow) {
  const TemporaryFolder folder;
  GltfBuilder builder = fullFile();
  builder.json["nodes"][0]["scale"] = {1e200, 1e200, 1e200};
  builder.addNode({{"children", {0}}, {"scale", {1e200, 1e200, 1e200}}});
  builder.json["scenes"][0]["nodes"] = {3};
  EXPECT_THAT(errorOfFile(builder.write(folder)), HasSubstr("nodes[0]: its transform is too large"));
}

// ---- Containers and JSON

TEST(GltfMalformed, MissingFileAndFolder) {
  const TemporaryFolder folder;
  EXPECT_EQ(errorOfFile(folder / "none.gltf"), "no such file");
  EXPECT_EQ(errorOfFile(folder.path()), "is a folder");
}

TEST(GltfMalformed, EmptyFile) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "a.glb", {});
  EXPECT_EQ(errorOfFile(folder / "a.glb"), "is empty (0 bytes)");
}

TEST(GltfMalformed, GlbTruncatedAtEveryLength) {
  const TemporaryFolder folder;
  const std::vector<uint8_t> glb = fullFile().glb();
  for (size_t length = 1; length < glb.size(); ++length) {
    test::writeBytes(folder / "cut.glb", std::span(glb).first(length));
    const std::string error = errorOfFile(folder / "cut.glb");
    EXPECT_NE(error, "no error") << length;
    if (length >= 20) {
      EXPECT_THAT(error, HasSubstr("truncated .glb")) << length;
    }
  }
}

TEST(GltfMalformed, GlbWhoseLengthsLie) {
  const TemporaryFolder folder;
  const std::vector<uint8_t> good = fullFile().glb();
  const size_t jsonLength = good[12] | size_t{good[13]} << 8;
  const size_t binaryChunk = 20 + jsonLength;
  const auto errorWith = [&](size_t offset, std::initializer_list<uint8_t> bytes) {
    std::vector<uint8_t> glb = good;
    std::copy(bytes.begin(), bytes.end(), glb.begin() + static_cast<ptrdiff_t>(offset));
    test::writeBytes(folder / "a.glb", glb);
    return errorOfFile(folder / "a.glb");
  };
  EXPECT_THAT(errorWith(4, {1}), HasSubstr("is glTF 1.0, which is not read"));
  EXPECT_THAT(errorWith(8, {255, 255, 255, 255}), HasSubstr("truncated .glb"));
  EXPECT_THAT(errorWith(12, {255, 255, 255, 255}), HasSubstr("a chunk reaches past the end"));
  EXPECT_THAT(errorWith(16, {'X'}), HasSubstr("the first chunk is not JSON"));
  EXPECT_THAT(errorWith(binaryChunk, {255, 255, 255, 127}), HasSubstr("a chunk reaches past the end"));
  // Eight bytes more than there are: inside the file's length if the chunk's header is forgotten.
  const size_t longer = good.size() - binaryChunk;
  EXPECT_THAT(errorWith(binaryChunk, {static_cast<uint8_t>(longer), static_cast<uint8_t>(longer >> 8)}),
              HasSubstr("a chunk reaches past"));
}

TEST(GltfMalformed, JsonErrorsSayWhere) {
  const TemporaryFolder folder;
  const auto errorWith = [&](const std::string& text) {
    std::ofstream(folder / "a.gltf") << text;
    return errorOfFile(folder / "a.gltf");
  };
  EXPECT_THAT(errorWith("{\n  \"asset\": }"), HasSubstr("is not valid glTF JSON: parse error at line 2, column 12"));
  EXPECT_THAT(errorWith("[]"), HasSubstr("its JSON is no object"));
  EXPECT_THAT(errorWith("{\"asset\":{\"version\":\"2.0\"},\"x\":1e999}"), HasSubstr("is not valid glTF JSON"));
  EXPECT_THAT(errorWith("{\"asset\":{\"version\":\"2.0\",\"copyright\":\"\xff\"}}"),
              HasSubstr("is not valid glTF JSON"));
  const std::string deep =
      "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(1000000, '[') + std::string(1000000, ']') + "}";
  EXPECT_THAT(errorWith(deep), HasSubstr("nested deeper than 100 levels"));
}

// Random damage: whatever happens, it is a scene without problems or an engine::Error, under every sanitizer.
TEST(GltfMalformed, RandomDamageNeverCrashes) {
  const TemporaryFolder folder;
  const std::vector<uint8_t> good = fullFile().glb();
  std::mt19937 random(1);
  int refused = 0;
  for (int run = 0; run < 1500; ++run) {
    std::vector<uint8_t> glb = good;
    for (int k = run % 4; k >= 0; --k) {
      // Digits for digits keep the JSON valid, so that the damage reaches what is behind the parser.
      const size_t place = 20 + random() % (glb.size() - 20);
      glb[place] =
          std::isdigit(glb[place]) ? static_cast<uint8_t>('0' + random() % 10) : static_cast<uint8_t>(random());
    }
    test::writeBytes(folder / "a.glb", glb);
    try {
      Scene scene;
      engine::appendGltf(scene, folder / "a.glb");
      ASSERT_TRUE(engine::findProblems(scene).empty());
    } catch (const engine::Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace

}  // namespace lensgraph
