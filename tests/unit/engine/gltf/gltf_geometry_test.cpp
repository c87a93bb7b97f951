// Vertices, indices and accessors of glTF files: every way a file may store a triangle gives that triangle.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/gltf/load_gltf.h"
#include "gltf_builder.h"

namespace lensgraph {

namespace {

using engine::Primitive;
using engine::Scene;
using test::GltfBuilder;
using test::Json;
using test::kTriangle;
using test::TemporaryFolder;
using test::triangleFile;
using testing::ElementsAre;
using testing::HasSubstr;

using Vec3s = std::vector<glm::vec3>;

const Vec3s kCorners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

Scene load(GltfBuilder& builder, std::vector<std::string>* warnings = nullptr) {
  const TemporaryFolder folder;
  Scene scene;
  const auto found = engine::appendGltf(scene, builder.write(folder));
  if (warnings != nullptr) *warnings = found;
  EXPECT_THAT(engine::findProblems(scene), testing::IsEmpty());
  return scene;
}

/// Corners in drawing order.
Vec3s corners(const Primitive& primitive) {
  Vec3s result;
  for (uint32_t index : primitive.indices) result.push_back(primitive.positions[index]);
  return result;
}

Primitive loadOne(GltfBuilder& builder, std::vector<std::string>* warnings = nullptr) {
  Scene scene = load(builder, warnings);
  EXPECT_EQ(scene.primitives.size(), 1u);
  return scene.primitives.empty() ? Primitive{} : scene.primitives.front();
}

TEST(GltfGeometry, NotIndexed) {
  GltfBuilder builder = triangleFile();
  const Primitive primitive = loadOne(builder);
  EXPECT_EQ(corners(primitive), kCorners);
  EXPECT_EQ(primitive.bounds, (engine::Bounds{{0, 0, 0}, {1, 1, 0}}));
}

template <typename Index>
class GltfIndices : public testing::Test {};
using IndexTypes = testing::Types<uint8_t, uint16_t, uint32_t>;
TYPED_TEST_SUITE(GltfIndices, IndexTypes);

TYPED_TEST(GltfIndices, OfEveryWidth) {
  GltfBuilder builder;
  const int positions = builder.addAccessor(std::vector<float>{9, 9, 9, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC3");
  const int indices = builder.addAccessor(std::vector<TypeParam>{2, 3, 1}, "SCALAR");
  builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  EXPECT_EQ(corners(loadOne(builder)), kCorners);
}

TEST(GltfGeometry, StripsAlternateTheirWinding) {
  GltfBuilder builder;
  const int positions = builder.addAccessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"mode", 5}});
  const Primitive primitive = loadOne(builder);
  EXPECT_EQ(primitive.triangleCount(), 2u);
  for (const glm::vec3& normal : primitive.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));  // both turn the same way
}

TEST(GltfGeometry, FansTurnRoundTheFirstVertex) {
  GltfBuilder builder;
  const int positions = builder.addAccessor(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
  builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"mode", 6}});
  const Primitive primitive = loadOne(builder);
  EXPECT_EQ(corners(primitive), (Vec3s{{1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}));
  for (const glm::vec3& normal : primitive.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST(GltfGeometry, PointsAndLinesAreLeftOutWithAWarning) {
  GltfBuilder builder = triangleFile();
  builder.json["meshes"][0]["primitives"][0]["mode"] = 1;
  std::vector<std::string> warnings;
  EXPECT_TRUE(load(builder, &warnings).instances.empty());
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("meshes[0].primitives[0]: line primitives are not drawn")));
}

TEST(GltfGeometry, InterleavedWithStride) {
  GltfBuilder builder;
  const int view = builder.addView(std::vector<float>{0, 0, 0, .1f, .2f, 1, 0, 0, .3f, .4f, 0, 1, 0, .5f, .6f}, 20);
  const Json accessor = {{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
  const int positions = builder.add("accessors", accessor);
  const int uvs = builder.add(
      "accessors", {{"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}});
  builder.addMesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_1", uvs}}}});
  const Primitive primitive = loadOne(builder);
  EXPECT_EQ(corners(primitive), kCorners);
  EXPECT_THAT(primitive.uvs[1], ElementsAre(glm::vec2(.1f, .2f), glm::vec2(.3f, .4f), glm::vec2(.5f, .6f)));
  EXPECT_TRUE(primitive.uvs[0].empty());
}

TEST(GltfGeometry, SparseReplacesElements) {
  GltfBuilder builder = triangleFile();
  const int indices = builder.addView(std::vector<uint16_t>{1, 2});
  const int values = builder.addView(std::vector<float>{5, 0, 0, 0, 6, 0});
  builder.json["accessors"][0]["sparse"] = {{"count", 2},
                                            {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                            {"values", {{"bufferView", values}}}};
  EXPECT_EQ(corners(loadOne(builder)), (Vec3s{{0, 0, 0}, {5, 0, 0}, {0, 6, 0}}));
}

TEST(GltfGeometry, SparseWithoutABaseStartsFromZeros) {
  GltfBuilder builder = triangleFile();
  const int indices = builder.addView(std::vector<uint8_t>{2});
  const int values = builder.addView(std::vector<float>{0, 6, 0});
  builder.json["accessors"][0].erase("bufferView");
  builder.json["accessors"][0]["sparse"] = {{"count", 1},
                                            {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                            {"values", {{"bufferView", values}}}};
  EXPECT_EQ(corners(loadOne(builder)), (Vec3s{{0, 0, 0}, {0, 0, 0}, {0, 6, 0}}));
}

TEST(GltfGeometry, QuantizedPositionsAndUvs) {
  GltfBuilder builder;
  builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  // Elements of 6 bytes stand 8 apart.
  const int view = builder.addView(std::vector<int16_t>{0, 0, 0, 99, 32767, 0, -32768, 99, 0, 16384, 0, 99}, 8);
  const int positions = builder.add(
      "accessors",
      {{"bufferView", view}, {"componentType", 5122}, {"normalized", true}, {"count", 3}, {"type", "VEC3"}});
  const int uvView = builder.addView(std::vector<uint8_t>{0, 255, 0, 0, 3, 4, 0, 0, 5, 6, 0, 0}, 4);
  const int uvs =
      builder.add("accessors", {{"bufferView", uvView}, {"componentType", 5121}, {"count", 3}, {"type", "VEC2"}});
  builder.addMesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}});
  const Primitive primitive = loadOne(builder);
  EXPECT_EQ(primitive.positions[1], glm::vec3(1, 0, -1));  // −32768 is clamped to −1
  EXPECT_FLOAT_EQ(primitive.positions[2].y, 16384.0f / 32767.0f);
  EXPECT_THAT(primitive.uvs[0], ElementsAre(glm::vec2(0, 255), glm::vec2(3, 4), glm::vec2(5, 6)));
}

TEST(GltfGeometry, ColoursOfEveryTypeAreLinear0To1) {
  const auto colorsOf = [](GltfBuilder& builder, int accessor) {
    builder.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = accessor;
    return loadOne(builder).colors;
  };
  GltfBuilder floats = triangleFile();
  EXPECT_THAT(colorsOf(floats, floats.addAccessor(std::vector<float>{.1f, .2f, .3f, 2, 0, 0, 0, 0, 1}, "VEC3")),
              ElementsAre(glm::vec4(.1f, .2f, .3f, 1), glm::vec4(2, 0, 0, 1), glm::vec4(0, 0, 1, 1)));
  GltfBuilder bytes = triangleFile();
  EXPECT_THAT(
      colorsOf(bytes, bytes.addAccessor(std::vector<uint8_t>{255, 0, 51, 102, 0, 0, 0, 0, 0, 0, 0, 255}, "VEC4", true)),
      ElementsAre(glm::vec4(1, 0, 51 / 255.f, 102 / 255.f), glm::vec4(0), glm::vec4(0, 0, 0, 1)));
  GltfBuilder words = triangleFile();
  EXPECT_THAT(colorsOf(words, words.addAccessor(std::vector<uint16_t>{65535, 0, 13107, 0, 0, 0, 0, 0, 0, 0, 0, 65535},
                                                "VEC4", true)),
              ElementsAre(glm::vec4(1, 0, 13107 / 65535.f, 0), glm::vec4(0), glm::vec4(0, 0, 0, 1)));
}

TEST(GltfGeometry, GivenNormalsAreNormalisedAndTangentsKept) {
  GltfBuilder builder = triangleFile();
  auto& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["NORMAL"] = builder.addAccessor(std::vector<float>{0, 3, 0, 0, 0, -2, 0, 0, 0}, "VEC3");
  attributes["TANGENT"] = builder.addAccessor(std::vector<float>{1, 0, 0, -1, 1, 0, 0, 1, 0, 1, 0, 1}, "VEC4");
  const Primitive primitive = loadOne(builder);
  EXPECT_THAT(primitive.normals, ElementsAre(glm::vec3(0, 1, 0), glm::vec3(0, 0, -1), glm::vec3(0, 0, 1)));
  EXPECT_EQ(primitive.tangents[0], glm::vec4(1, 0, 0, -1));
}

TEST(GltfGeometry, MissingNormalsAreFlatAndVerticesSplit) {
  GltfBuilder builder;  // a fold along the edge (0,0,0)-(0,1,0)
  const int positions = builder.addAccessor(std::vector<float>{0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1}, "VEC3");
  const int indices = builder.addAccessor(std::vector<uint16_t>{0, 2, 1, 0, 1, 3}, "SCALAR");
  builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  const Primitive primitive = loadOne(builder);
  ASSERT_EQ(primitive.positions.size(), 6u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(primitive.normals[static_cast<size_t>(i)], glm::vec3(0, 0, 1));
  for (int i = 3; i < 6; ++i) EXPECT_EQ(primitive.normals[static_cast<size_t>(i)], glm::vec3(1, 0, 0));
}

TEST(GltfGeometry, DegenerateTrianglesHaveAFiniteNormal) {
  GltfBuilder builder;
  builder.addMesh({{"attributes", {{"POSITION", builder.addAccessor(std::vector<float>(9, 4.0f), "VEC3")}}}});
  EXPECT_EQ(loadOne(builder).normals[0], glm::vec3(0, 0, 1));
}

TEST(GltfGeometry, IncompleteTriangleIsLeftOutWithAWarning) {
  GltfBuilder builder;
  builder.addMesh({{"attributes", {{"POSITION", builder.addAccessor(std::vector<float>(12, 4.0f), "VEC3")}}}});
  std::vector<std::string> warnings;
  EXPECT_EQ(loadOne(builder, &warnings).triangleCount(), 1u);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("do not make whole triangles")));
}

TEST(GltfGeometry, ExternalBufferWithAwkwardNameAndSpareBytes) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangleFile();
  std::vector<uint8_t> bytes = builder.binary;
  bytes.resize(bytes.size() + 5);  // files may be longer than byteLength
  test::writeBytes(folder / "a b+c.bin", bytes);
  builder.json["buffers"] = {{{"byteLength", builder.binary.size()}, {"uri", "a%20b+c.bin"}}};
  Scene scene;
  engine::appendGltf(scene, builder.write(folder));
  EXPECT_EQ(corners(scene.primitives[0]), kCorners);
}

TEST(GltfGeometry, BinaryContainer) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "a.glb", triangleFile().glb());
  Scene scene;
  engine::appendGltf(scene, folder / "a.glb");
  EXPECT_EQ(corners(scene.primitives[0]), kCorners);
}

// A rest pose that differs from the bind pose: joint 1 was bound at the origin and stands at (10, 0, 0).
TEST(GltfGeometry, SkinsAreBakedInTheirRestPose) {
  GltfBuilder builder;
  std::vector<float> identities(32, 0.0f);
  for (size_t i = 0; i < 32; ++i) identities[i] = (i % 16) % 5 == 0 ? 1.0f : 0.0f;
  const int inverses = builder.addAccessor(identities, "MAT4");
  const Json primitive = {
      {"attributes",
       {{"POSITION", builder.addAccessor(kTriangle, "VEC3")},
        {"JOINTS_0", builder.addAccessor(std::vector<uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4")},
        {"WEIGHTS_0", builder.addAccessor(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, .5f, .5f, 0, 0}, "VEC4")}}}};
  const int node = builder.addMesh(primitive);
  builder.json["nodes"][static_cast<size_t>(node)]["skin"] = 0;
  builder.json["nodes"][static_cast<size_t>(node)]["translation"] = {0, 0, 100};  // does not count for a skinned mesh
  const int joint0 = builder.addNode(Json::object());
  const int joint1 = builder.addNode({{"translation", {10, 0, 0}}});
  builder.json["skins"] = {{{"joints", {joint0, joint1}}, {"inverseBindMatrices", inverses}}};
  std::vector<std::string> warnings;
  const Scene scene = load(builder, &warnings);
  EXPECT_EQ(corners(scene.primitives[0]), (Vec3s{{0, 0, 0}, {11, 0, 0}, {5, 1, 0}}));
  EXPECT_EQ(engine::worldBounds(scene), (engine::Bounds{{0, 0, 0}, {11, 1, 0}}));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("skins are drawn in their rest pose")));
}

// Joints that mirror turn a mesh inside out unless its triangles are turned, as those of a mirrored node are.
TEST(GltfGeometry, MirroringJointsKeepFrontFacesOutside) {
  for (const double sign : {1.0, -1.0}) {
    GltfBuilder builder;
    const Json primitive = {
        {"attributes",
         {{"POSITION", builder.addAccessor(kTriangle, "VEC3")},
          {"JOINTS_0", builder.addAccessor(std::vector<uint8_t>(12, 0), "VEC4")},
          {"WEIGHTS_0", builder.addAccessor(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4")}}}};
    const int node = builder.addMesh(primitive);
    builder.json["nodes"][static_cast<size_t>(node)]["skin"] = 0;
    const int joint = builder.addNode({{"scale", {sign, 1, 1}}});
    builder.json["skins"] = {{{"joints", {joint}}}};
    const Scene scene = load(builder);
    const auto corner = corners(scene.primitives[0]);
    const glm::vec3 facing = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    EXPECT_GT(facing.z, 0.0f) << "scale " << sign;
    EXPECT_GT(scene.primitives[0].normals[0].z, 0.0f) << "scale " << sign;
  }
}

}  // namespace

}  // namespace lensgraph
