// Compressed geometry: KHR_draco_mesh_compression and EXT_meshopt_compression. The streams are made here, by the encoders
// of the libraries that the loader decodes with.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>
#include <meshoptimizer.h>

#include <random>

#include "gltf_loading.h"

namespace lensgraph {

namespace {

using test::cornersOf;
using test::GltfBuilder;
using test::Json;
using test::kTriangle;
using test::load;
using test::Loaded;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using testing::UnorderedElementsAreArray;

using Vec3s = std::vector<glm::vec3>;

const char* const kDraco = "KHR_draco_mesh_compression";
const char* const kMeshopt = "EXT_meshopt_compression";

// ---- Draco

struct DracoStream {
  std::vector<uint8_t> bytes;
  size_t vertices = 0, triangles = 0;
  uint32_t positions = 0, normals = 0;  ///< Attributes' numbers.
};

/// A flat grid of n × n squares with normals, positions in multiples of 1/1024.
DracoStream dracoGrid(int n, draco::MeshEncoderMethod method) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2 * n * n);
  const int positions = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int normals = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
  const auto corner = [](int x, int y) {
    return glm::vec3(static_cast<float>(x) / 1024, static_cast<float>(y) / 1024, 0);
  };
  const glm::vec3 up(0, 0, 1);
  for (int i = 0; i < n * n; ++i) {
    const int x = i % n, y = i / n;
    const glm::vec3 a = corner(x, y), b = corner(x + 1, y), c = corner(x + 1, y + 1), d = corner(x, y + 1);
    builder.SetAttributeValuesForFace(positions, draco::FaceIndex(2 * static_cast<uint32_t>(i)), &a, &b, &c);
    builder.SetAttributeValuesForFace(positions, draco::FaceIndex(2 * static_cast<uint32_t>(i) + 1), &a, &c, &d);
    for (uint32_t f : {0u, 1u})
      builder.SetAttributeValuesForFace(normals, draco::FaceIndex(2 * static_cast<uint32_t>(i) + f), &up, &up, &up);
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 8);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  DracoStream stream;
  stream.bytes.assign(buffer.data(), buffer.data() + buffer.size());
  stream.vertices = mesh->num_points();
  stream.triangles = mesh->num_faces();
  stream.positions = mesh->attribute(positions)->unique_id();
  stream.normals = mesh->attribute(normals)->unique_id();
  return stream;
}

/// A file of one primitive that has nothing but the stream.
GltfBuilder dracoFile(const DracoStream& stream) {
  GltfBuilder builder;
  const auto accessor = [&](size_t count, int componentType, const char* type) {
    return builder.add("accessors", {{"componentType", componentType}, {"count", count}, {"type", type}});
  };
  const int positions = accessor(stream.vertices, 5126, "VEC3"), normals = accessor(stream.vertices, 5126, "VEC3");
  const int indices = accessor(3 * stream.triangles, 5125, "SCALAR");
  const Json extension = {{"bufferView", builder.addView(stream.bytes)},
                          {"attributes", {{"POSITION", stream.positions}, {"NORMAL", stream.normals}}}};
  builder.addMesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                   {"indices", indices},
                   {"extensions", {{kDraco, extension}}}});
  builder.json["extensionsUsed"] = {kDraco};
  return builder;
}

Json& primitiveOf(GltfBuilder& builder) {
  return builder.json["meshes"][0]["primitives"][0];
}

class Draco : public testing::TestWithParam<draco::MeshEncoderMethod> {
 protected:
  std::string errorWith(const Json::json_pointer& pointer, const Json& value) {
    GltfBuilder builder = dracoFile(dracoGrid(2, GetParam()));
    builder.json[pointer] = value;
    return load(builder).error;
  }
};

TEST_P(Draco, IsReadWhetherRequiredOrNot) {
  GltfBuilder builder = dracoFile(dracoGrid(3, GetParam()));
  for (bool isRequired : {false, true}) {
    if (isRequired) builder.json["extensionsRequired"] = {kDraco};
    const Loaded loaded = load(builder);
    ASSERT_EQ(loaded.error, "");
    EXPECT_THAT(loaded.warnings, IsEmpty());
    const engine::Primitive& primitive = loaded.scene.primitives.at(0);
    EXPECT_EQ(primitive.positions.size(), 16u);
    EXPECT_EQ(primitive.triangleCount(), 18u);
    EXPECT_EQ(primitive.bounds, (engine::Bounds{{0, 0, 0}, {3.0 / 1024, 3.0 / 1024, 0}}));
    double area = 0;
    for (size_t i = 0; i < primitive.indices.size(); i += 3) {
      const Vec3s corners = cornersOf(primitive);
      const glm::vec3 u = corners[i + 1] - corners[i], v = corners[i + 2] - corners[i];
      area += double{u.x} * v.y - double{u.y} * v.x;
    }
    EXPECT_NEAR(area, 18.0 / 1024 / 1024, 1e-9);  // all turn the same way and none overlap
    for (const glm::vec3& normal : primitive.normals) EXPECT_NEAR(normal.z, 1.0f, 1e-3f);
  }
}

TEST_P(Draco, IsPreferredToItsFallback) {
  GltfBuilder builder = dracoFile(dracoGrid(1, GetParam()));
  const int fallback = builder.addView(std::vector<float>(12, 77.0f));
  builder.json["accessors"][0]["bufferView"] = fallback;
  EXPECT_LT(load(builder).scene.primitives.at(0).bounds.max.x, 1.0);
}

TEST_P(Draco, AttributesOutsideTheStreamAreReadBesideIt) {
  GltfBuilder builder = dracoFile(dracoGrid(1, GetParam()));
  primitiveOf(builder)["attributes"]["TEXCOORD_0"] = builder.addAccessor(std::vector<float>(8, 0.25f), "VEC2");
  EXPECT_EQ(load(builder).scene.primitives.at(0).uvs[0].at(3), glm::vec2(0.25f));
}

TEST_P(Draco, MetadataIsSkipped) {
  DracoStream stream = dracoGrid(2, GetParam());
  stream.bytes[10] |= 0x80;
  // One attribute's: number 0, no entries, nothing inside. The mesh's: an entry "a" = "b", and an empty "in" inside.
  const std::vector<uint8_t> metadata = {1, 0, 0, 0, 1, 1, 'a', 1, 'b', 1, 2, 'i', 'n', 0, 0};
  stream.bytes.insert(stream.bytes.begin() + 11, metadata.begin(), metadata.end());
  GltfBuilder builder = dracoFile(stream);
  EXPECT_EQ(load(builder).scene.primitives.at(0).triangleCount(), 8u);
}

TEST_P(Draco, AccessorsThatPromiseSomethingElseAreNamed) {
  using Pointer = Json::json_pointer;
  const std::string field = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression";
  EXPECT_THAT(errorWith(Pointer("/accessors/2/count"), 12), AllOf(StartsWith(field), HasSubstr("8 triangles")));
  EXPECT_THAT(errorWith(Pointer("/accessors/0/count"), 8), AllOf(StartsWith(field), HasSubstr("9 vertices")));
  EXPECT_THAT(errorWith(Pointer("/accessors/0/count"), 1e9), AllOf(StartsWith(field), HasSubstr("more than the 80")));
  EXPECT_THAT(errorWith(Pointer("/accessors/0/type"), "VEC2"), HasSubstr("components"));
  EXPECT_THAT(errorWith(Pointer("/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/attributes/POSITION"), 9),
              AllOf(StartsWith(field + ".attributes.POSITION"), HasSubstr("has no attribute 9")));
  EXPECT_THAT(errorWith(Pointer("/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/bufferView"), 9),
              StartsWith(field + ".bufferView: index 9 is out of range"));
  EXPECT_THAT(errorWith(Pointer("/buffers"), {{{"byteLength", 1e6}, {"uri", "none.bin"}}}),
              AllOf(StartsWith(field), HasSubstr("buffers[0].uri: 'none.bin': no such file")));
}

// Whatever the damage is, it is an error that names the extension, or other geometry of the same size.
TEST_P(Draco, DamagedStreamsAreErrors) {
  const DracoStream good = dracoGrid(4, GetParam());
  std::mt19937 random(7);
  int refused = 0;
  for (int run = 0; run < 600; ++run) {
    DracoStream damaged = good;
    if (run % 3 == 0) {
      damaged.bytes.resize(1 + random() % (damaged.bytes.size() - 1));
    } else {
      for (int k = run % 3; k > 0; --k) damaged.bytes[random() % damaged.bytes.size()] = static_cast<uint8_t>(random());
    }
    GltfBuilder builder = dracoFile(damaged);
    const Loaded loaded = load(builder);
    if (loaded.error.empty()) {
      EXPECT_EQ(loaded.scene.primitives.at(0).triangleCount(), 32u);
    } else {
      EXPECT_THAT(loaded.error, testing::AnyOf(HasSubstr(kDraco), HasSubstr("is not finite"),
                                               HasSubstr("indices: element"), HasSubstr("cannot be read")));
      ++refused;
    }
  }
  EXPECT_GT(refused, 200);
}

INSTANTIATE_TEST_SUITE_P(Methods, Draco,
                         testing::Values(draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING));

TEST(DracoStreams, OtherStreamsAreRefused) {
  const auto errorOf = [](size_t place, uint8_t value) {
    DracoStream stream = dracoGrid(1, draco::MESH_SEQUENTIAL_ENCODING);
    stream.bytes[place] = value;
    GltfBuilder builder = dracoFile(stream);
    return load(builder).error;
  };
  EXPECT_THAT(errorOf(0, 'd'), HasSubstr("its stream is not Draco's"));
  EXPECT_THAT(errorOf(6, 1), HasSubstr("of version 2.1, only 2.2 is allowed"));
  EXPECT_THAT(errorOf(7, 0), HasSubstr("holds no mesh"));
}

TEST(DracoStreams, RepeatedByPrimitivesAreLimited) {
  GltfBuilder builder = dracoFile(dracoGrid(60, draco::MESH_EDGEBREAKER_ENCODING));
  for (int i = 0; i < 1000; ++i) builder.json["meshes"][0]["primitives"].push_back(primitiveOf(builder));
  EXPECT_THAT(load(builder).error, HasSubstr("asks for more geometry than the file holds"));
}

// ---- Meshopt

/// A view that holds nothing but a compressed stream; the buffer that it names is a fallback without bytes.
int addCompressed(GltfBuilder& builder, const std::vector<uint8_t>& stream, size_t stride, size_t count,
                  const std::string& mode, const std::string& filter = "NONE", const std::string& name = kMeshopt) {
  const int plain = builder.addView(stream);
  Json extension = builder.json["bufferViews"][static_cast<size_t>(plain)];
  extension["byteStride"] = stride;
  extension["count"] = count;
  extension["mode"] = mode;
  if (filter != "NONE") extension["filter"] = filter;
  Json view = {{"buffer", 1}, {"byteLength", stride * count}, {"extensions", {{name, extension}}}};
  if (mode == "ATTRIBUTES") view["byteStride"] = stride;
  return builder.add("bufferViews", view);
}

/// To be called after all streams were added.
Loaded loadCompressed(GltfBuilder& builder) {
  builder.json["buffers"] = {
      {{"byteLength", builder.binary.size()}, {"uri", "data:;base64," + test::base64(builder.binary)}},
      {{"byteLength", 100000}, {"extensions", {{kMeshopt, {{"fallback", true}}}}}}};
  return load(builder);
}

template <typename T>
std::vector<uint8_t> encodedAttributes(const std::vector<T>& values, size_t stride) {
  const size_t count = values.size() * sizeof(T) / stride;
  std::vector<uint8_t> stream(meshopt_encodeVertexBufferBound(count, stride));
  stream.resize(meshopt_encodeVertexBuffer(stream.data(), stream.size(), values.data(), count, stride));
  return stream;
}

std::vector<uint8_t> encodedTriangles(const std::vector<uint32_t>& indices, size_t vertices) {
  std::vector<uint8_t> stream(meshopt_encodeIndexBufferBound(indices.size(), vertices));
  stream.resize(meshopt_encodeIndexBuffer(stream.data(), stream.size(), indices.data(), indices.size()));
  return stream;
}

std::vector<uint8_t> encodedSequence(const std::vector<uint32_t>& indices, size_t vertices) {
  std::vector<uint8_t> stream(meshopt_encodeIndexSequenceBound(indices.size(), vertices));
  stream.resize(meshopt_encodeIndexSequence(stream.data(), stream.size(), indices.data(), indices.size()));
  return stream;
}

int addAccessor(GltfBuilder& builder, int view, int componentType, size_t count, const char* type,
                bool isNormalized = false) {
  return builder.add("accessors", {{"bufferView", view},
                                   {"componentType", componentType},
                                   {"count", count},
                                   {"type", type},
                                   {"normalized", isNormalized}});
}

const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::vector<uint32_t> kSquareIndices = {0, 1, 2, 0, 2, 3};
const Vec3s kSquareCorners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};

/// The square with compressed positions; more may be added.
GltfBuilder meshoptSquare(const std::string& name = kMeshopt) {
  GltfBuilder builder;
  const int view = addCompressed(builder, encodedAttributes(kSquare, 12), 12, 4, "ATTRIBUTES", "NONE", name);
  builder.addMesh({{"attributes", {{"POSITION", addAccessor(builder, view, 5126, 4, "VEC3")}}}, {"mode", 6}});
  return builder;
}

struct IndexWidth {
  size_t bytes;
  int componentType;
};

class MeshoptIndices : public testing::TestWithParam<IndexWidth> {};

TEST_P(MeshoptIndices, TrianglesAndSequencesGiveTheSquare) {
  const auto [bytes, componentType] = GetParam();
  for (const std::string mode : {"TRIANGLES", "INDICES"}) {
    GltfBuilder builder = meshoptSquare();
    const auto stream = mode == "TRIANGLES" ? encodedTriangles(kSquareIndices, 4) : encodedSequence(kSquareIndices, 4);
    const int view = addCompressed(builder, stream, bytes, 6, mode);
    primitiveOf(builder)["mode"] = 4;
    primitiveOf(builder)["indices"] = addAccessor(builder, view, componentType, 6, "SCALAR");
    const Loaded loaded = loadCompressed(builder);
    ASSERT_EQ(loaded.error, "");
    EXPECT_THAT(loaded.warnings, IsEmpty());
    // The encoder of triangles may turn each round.
    EXPECT_THAT(cornersOf(loaded.scene.primitives.at(0)), UnorderedElementsAreArray(kSquareCorners));
    EXPECT_EQ(loaded.scene.primitives[0].normals.at(0), glm::vec3(0, 0, 1));
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, MeshoptIndices, testing::Values(IndexWidth{2, 5123}, IndexWidth{4, 5125}));

TEST(Meshopt, IsReadUnderBothNames) {
  for (const char* name : {kMeshopt, "KHR_meshopt_compression"}) {
    GltfBuilder builder = meshoptSquare(name);
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {name};
    const Loaded loaded = loadCompressed(builder);
    ASSERT_EQ(loaded.error, "");
    EXPECT_THAT(loaded.warnings, IsEmpty());
    EXPECT_THAT(cornersOf(loaded.scene.primitives.at(0)), testing::SizeIs(6));
  }
}

TEST(Meshopt, EveryFilterIsApplied) {
  constexpr size_t kCount = 4;
  const std::vector<float> normals = {0, 0, 1, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0.6f, 0, 0.8f, 0};
  for (size_t stride : {size_t{4}, size_t{8}}) {
    GltfBuilder builder = meshoptSquare();
    std::vector<uint8_t> filtered(kCount * stride);
    meshopt_encodeFilterOct(filtered.data(), kCount, stride, stride == 4 ? 8 : 12, normals.data());
    const int view =
        addCompressed(builder, encodedAttributes(filtered, stride), stride, kCount, "ATTRIBUTES", "OCTAHEDRAL");
    primitiveOf(builder)["attributes"]["NORMAL"] =
        addAccessor(builder, view, stride == 4 ? 5120 : 5122, kCount, "VEC3", true);
    const Loaded loaded = loadCompressed(builder);
    ASSERT_EQ(loaded.error, "");
    for (size_t i = 0; i < kCount; ++i) {
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(loaded.scene.primitives.at(0).normals.at(i)[c], normals[4 * i + static_cast<size_t>(c)], 0.02f);
    }
  }
  GltfBuilder exponential;
  std::vector<uint8_t> filtered(kSquare.size() * 4);
  meshopt_encodeFilterExp(filtered.data(), 4, 12, 16, kSquare.data());
  const int view = addCompressed(exponential, encodedAttributes(filtered, 12), 12, 4, "ATTRIBUTES", "EXPONENTIAL");
  exponential.addMesh({{"attributes", {{"POSITION", addAccessor(exponential, view, 5126, 4, "VEC3")}}}, {"mode", 6}});
  EXPECT_EQ(loadCompressed(exponential).scene.primitives.at(0).bounds, (engine::Bounds{{0, 0, 0}, {1, 1, 0}}));
}

TEST(Meshopt, QuaternionsOfInstances) {
  GltfBuilder builder = meshoptSquare();
  const float half = std::sqrt(0.5f);
  const std::vector<float> rotations = {0, 0, half, half, 0, 0, 0, 1};
  std::vector<uint8_t> filtered(16);
  meshopt_encodeFilterQuat(filtered.data(), 2, 8, 16, rotations.data());
  const int view = addCompressed(builder, encodedAttributes(filtered, 8), 8, 2, "ATTRIBUTES", "QUATERNION");
  builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] =
      addAccessor(builder, view, 5122, 2, "VEC4", true);
  const Loaded loaded = loadCompressed(builder);
  ASSERT_EQ(loaded.scene.instances.size(), 2u) << loaded.error;
  EXPECT_NEAR(loaded.scene.instances[0].worldFromObject[0].y, 1.0, 1e-3);
  EXPECT_NEAR(loaded.scene.instances[1].worldFromObject[0].x, 1.0, 1e-3);
}

TEST(Meshopt, WhatTheExtensionDoesNotAllowIsNamed) {
  const auto errorWith = [](const char* member, const Json& value) {
    GltfBuilder builder = meshoptSquare();
    builder.json["bufferViews"][1]["extensions"][kMeshopt][member] = value;
    return loadCompressed(builder).error;
  };
  const std::string field = "bufferViews[1].extensions.EXT_meshopt_compression";
  EXPECT_THAT(errorWith("byteStride", 11), StartsWith(field + ".byteStride: 11 is not allowed"));
  EXPECT_THAT(errorWith("byteStride", 0), StartsWith(field + ".byteStride: 0 is not allowed"));
  EXPECT_THAT(errorWith("byteStride", 260), StartsWith(field + ".byteStride: 260 is not allowed"));
  EXPECT_THAT(errorWith("mode", "POINTS"), StartsWith(field + ".mode: 'POINTS' is none of"));
  EXPECT_THAT(errorWith("mode", "TRIANGLES"), StartsWith(field + ".byteStride"));
  EXPECT_THAT(errorWith("filter", "COLOR"), StartsWith(field + ".filter: 'COLOR' is none of"));
  EXPECT_THAT(errorWith("filter", "QUATERNION"), StartsWith(field + ".byteStride: 12 is not allowed"));
  EXPECT_THAT(errorWith("count", 1e9), AllOf(StartsWith(field + ".count"), HasSubstr("more than a stream of")));
  EXPECT_EQ(errorWith("count", 3), "bufferViews[1].byteLength: promises 48 bytes, its stream decodes to 36");
  EXPECT_THAT(errorWith("byteLength", 20), AllOf(StartsWith(field), HasSubstr("is damaged")));
  EXPECT_THAT(errorWith("byteLength", 0), AllOf(StartsWith(field), HasSubstr("does not hold what its mode")));
  EXPECT_THAT(errorWith("byteOffset", 1e6), AllOf(StartsWith(field), HasSubstr("outside its buffer")));
  EXPECT_THAT(errorWith("buffer", 7), StartsWith(field + ".buffer: index 7 is out of range"));
}

TEST(Meshopt, NewerStreamsAreRefusedInWords) {
  GltfBuilder builder = meshoptSquare("KHR_meshopt_compression");
  builder.binary[0] |= 1;
  EXPECT_THAT(loadCompressed(builder).error,
              HasSubstr("KHR_meshopt_compression: its stream is of a newer version, which is not read"));
}

TEST(Meshopt, ViewsThatShareAStreamAreLimited) {
  GltfBuilder builder;
  const std::vector<float> zeros(3 * 30000);
  addCompressed(builder, encodedAttributes(zeros, 12), 12, 30000, "ATTRIBUTES");
  const Json view = builder.json["bufferViews"][1];
  Json list = Json::array();
  for (int i = 0; i < 200; ++i)
    list.push_back(
        {{"attributes", {{"POSITION", addAccessor(builder, builder.add("bufferViews", view), 5126, 30, "VEC3")}}}});
  builder.addNode({{"mesh", builder.add("meshes", {{"primitives", list}})}});
  EXPECT_THAT(loadCompressed(builder).error, HasSubstr("streams decode to more than 64 bytes"));
}

TEST(Meshopt, DamagedStreamsAreErrorsOrOtherNumbers) {
  std::mt19937 random(3);
  for (int run = 0; run < 300; ++run) {
    GltfBuilder builder = meshoptSquare();
    const int view = addCompressed(builder, encodedTriangles(kSquareIndices, 4), 2, 6, "TRIANGLES");
    primitiveOf(builder)["indices"] = addAccessor(builder, view, 5123, 6, "SCALAR");
    primitiveOf(builder)["mode"] = 4;
    for (int k = run % 3; k >= 0; --k)
      builder.binary[random() % builder.binary.size()] = static_cast<uint8_t>(random());
    loadCompressed(builder);  // looks for problems in the scene
  }
}

}  // namespace

}  // namespace lensgraph
