// Nothing that a glTF file says makes the loader wait, or take memory out of proportion to the file.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <chrono>

#include "gltf_loading.h"
#include "raw_png.h"

namespace lensgraph {

namespace {

using test::cornersOf;
using test::GltfBuilder;
using test::Json;
using test::kTriangle;
using test::load;
using test::Loaded;
using test::loadFile;
using test::TemporaryFolder;
using test::triangleFile;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// The most memory that the process has had, in bytes.
uint64_t peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

/// What loading added to the peak. Blind to less than what earlier tests left; enough for gigabytes.
template <typename Act>
uint64_t memoryOf(const Act& act) {
  const uint64_t before = peakMemory();
  act();
  return peakMemory() - before;
}

constexpr uint64_t kMegabyte = 1'000'000;

// ---- Files that are none

class NoFile : public testing::TestWithParam<const char*> {
 protected:
  /// Path or URI of a thing that is no regular file.
  std::string make() {
    const std::string kind = GetParam();
    if (kind == "device") return "/dev/zero";
    const std::filesystem::path path = folder / "thing";
    if (kind == "folder") std::filesystem::create_directory(path);
    if (kind == "pipe") mkfifo(path.c_str(), 0600);
    if (kind == "socket") {
      sockaddr_un address{};
      address.sun_family = AF_UNIX;
      path.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
      const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
      EXPECT_EQ(bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
      close(socket);
    }
    return path;
  }

  std::string reason() const { return std::string(GetParam()) == "folder" ? "is a folder" : "is not a file"; }

  TemporaryFolder folder;
};

TEST_P(NoFile, AsTheFileIsNotOpened) {
  EXPECT_EQ(loadFile(make()).error, reason());
}

TEST_P(NoFile, AsABufferIsNotOpened) {
  GltfBuilder builder = triangleFile();
  builder.json["buffers"] = {{{"byteLength", 36}, {"uri", make()}}};
  EXPECT_THAT(loadFile(builder.write(folder)).error,
              AllOf(StartsWith("buffers[0].uri: '"), HasSubstr("': " + reason())));
}

TEST_P(NoFile, AsAnImageIsNotOpened) {
  GltfBuilder builder = triangleFile();
  builder.json["images"] = {{{"uri", make()}}};
  builder.json["textures"] = {{{"source", 0}}};
  builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  EXPECT_THAT(loadFile(builder.write(folder)).error,
              AllOf(StartsWith("images[0].uri: '"), HasSubstr("': " + reason())));
}

INSTANTIATE_TEST_SUITE_P(Kinds, NoFile, testing::Values("pipe", "socket", "device", "folder"));

// ---- Geometry that the file does not hold

TEST(GltfLimits, AccessorsOfZerosCountTogether) {
  GltfBuilder builder;
  const int zeros = builder.add("accessors", {{"componentType", 5126}, {"count", 300000}, {"type", "VEC3"}});
  const int mesh = builder.add("meshes", {{"primitives", Json::array()}});
  for (int i = 0; i < 20; ++i)
    builder.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", zeros}}}});
  builder.addNode({{"mesh", mesh}});
  EXPECT_LT(memoryOf([&] {
              EXPECT_THAT(load(builder).error, HasSubstr("asks for more geometry than the file holds: what is repeated "
                                                         "or all zeros may take 12 MB"));
            }),
            200 * kMegabyte);
}

TEST(GltfLimits, ASmallAccessorOfZerosIsRead) {
  GltfBuilder builder;
  const int zeros = builder.add("accessors", {{"componentType", 5126}, {"count", 3000}, {"type", "VEC3"}});
  builder.addMesh({{"attributes", {{"POSITION", zeros}}}});
  EXPECT_EQ(load(builder).scene.primitives.at(0).triangleCount(), 1000u);
}

// A file of `vertices` vertices and as many primitives as asked for, each of all of them.
GltfBuilder repeating(size_t vertices, size_t primitives) {
  GltfBuilder builder;
  const int positions = builder.addAccessor(std::vector<float>(3 * vertices, 1.0f), "VEC3");
  Json list = Json::array();
  for (size_t i = 0; i < primitives; ++i) list.push_back({{"attributes", {{"POSITION", positions}}}});
  builder.addNode({{"mesh", builder.add("meshes", {{"primitives", list}})}});
  return builder;
}

TEST(GltfLimits, AnAccessorThatAllPrimitivesRepeatIsRefusedSoon) {
  GltfBuilder builder = repeating(40000, 10000);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_LT(
      memoryOf([&] { EXPECT_THAT(load(builder).error, HasSubstr("asks for more geometry than the file holds")); }),
      (20 + 64) * kMegabyte);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(GltfLimits, AFewRepetitionsAreRead) {
  GltfBuilder builder = repeating(3000, 50);
  EXPECT_EQ(load(builder).scene.primitives.size(), 50u);
}

TEST(GltfLimits, PrimitivesOfFewVerticesOfALongAccessorKeepOnlyThose) {
  GltfBuilder builder;
  std::vector<float> positions(3 * 100000);
  for (size_t i = 0; i < positions.size(); ++i) positions[i] = static_cast<float>(i);
  const Json attributes = {{"POSITION", builder.addAccessor(positions, "VEC3")}};
  Json list = Json::array();
  for (uint32_t i = 0; i < 1000; ++i) {
    const int indices = builder.addAccessor(std::vector<uint32_t>{i + 7, i, i + 90000}, "SCALAR");
    list.push_back({{"attributes", attributes}, {"indices", indices}});
  }
  builder.addNode({{"mesh", builder.add("meshes", {{"primitives", list}})}});
  const Loaded loaded = load(builder);
  ASSERT_EQ(loaded.error, "");
  ASSERT_EQ(loaded.scene.primitives.size(), 1000u);
  const engine::Primitive& last = loaded.scene.primitives[999];
  EXPECT_EQ(last.positions.size(), 3u);
  EXPECT_THAT(cornersOf(last),
              ElementsAre(glm::vec3(3018, 3019, 3020), glm::vec3(2997, 2998, 2999), glm::vec3(272997, 272998, 272999)));
}

TEST(GltfLimits, VerticesThatNoTriangleUsesAreLeftOut) {
  GltfBuilder builder;
  const int positions = builder.addAccessor(std::vector<float>{9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int normals = builder.addAccessor(std::vector<float>{9, 9, 9, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int indices = builder.addAccessor(std::vector<uint8_t>{3, 1, 2, 1, 2, 3}, "SCALAR");
  builder.addMesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"indices", indices}});
  const Loaded loaded = load(builder);
  const engine::Primitive& primitive = loaded.scene.primitives.at(0);
  EXPECT_THAT(primitive.positions, ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
  EXPECT_THAT(primitive.normals, testing::Each(glm::vec3(0, 0, 1)));
  EXPECT_THAT(primitive.indices, ElementsAre(2, 0, 1, 0, 1, 2));
  EXPECT_EQ(primitive.bounds.max.x, 1.0);
}

TEST(GltfLimits, MeshesThatNodesPlaceAreNoRepetition) {
  GltfBuilder builder = repeating(3000, 1);
  for (int i = 0; i < 20000; ++i) builder.addNode({{"mesh", 0}, {"translation", {i, 0, 0}}});
  EXPECT_EQ(load(builder).scene.instances.size(), 20001u);
}

TEST(GltfLimits, ManyNodesOfManyPrimitivesAreRefused) {
  GltfBuilder builder = repeating(3, 1000);
  for (int i = 0; i < 3000; ++i) builder.addNode({{"mesh", 0}});
  EXPECT_THAT(load(builder).error, HasSubstr(".mesh: brings the file's instances to more than the 32 MB"));
}

TEST(GltfLimits, LongNamesAreNotCopiedToEveryInstance) {
  GltfBuilder builder = repeating(3, 2000);
  builder.json["nodes"][0]["name"] = std::string(200000, 'n');
  builder.json["meshes"][0]["name"] = std::string(200000, 'm');
  EXPECT_LT(memoryOf([&] { EXPECT_EQ(load(builder).scene.instances.at(1999).name.size(), 200u); }), 100 * kMegabyte);
}

// ---- What is not needed

TEST(GltfLimits, WhatNothingDrawnUsesMayBeMissing) {
  GltfBuilder builder = triangleFile();
  const TemporaryFolder folder;
  builder.write(folder);  // adds buffer 0
  builder.add("buffers", {{"byteLength", 100}});
  builder.add("buffers", {{"byteLength", 100}, {"uri", "missing.bin"}});
  builder.add("bufferViews", {{"buffer", 2}, {"byteOffset", 5000}, {"byteLength", 100}});
  builder.add("accessors", {{"bufferView", 1}, {"componentType", 7}, {"count", 1e9}, {"type", "TENSOR"}});
  builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"znear", "near"}}}}};
  EXPECT_EQ(loadFile(builder.write(folder)).error, "");
}

TEST(GltfLimits, TheSameIsNamedWhenItIsUsed) {
  GltfBuilder builder = triangleFile();
  const TemporaryFolder folder;
  builder.write(folder);
  builder.add("buffers", {{"byteLength", 100}});
  builder.add("bufferViews", {{"buffer", 1}, {"byteLength", 100}});
  builder.json["accessors"][0]["bufferView"] = 1;
  EXPECT_THAT(loadFile(builder.write(folder)).error, StartsWith("buffers[1].uri: is missing"));
  builder.json["accessors"][0]["type"] = "TENSOR";
  EXPECT_THAT(loadFile(builder.write(folder)).error, HasSubstr("has 0 components instead of 3"));
}

TEST(GltfLimits, IndicesMayHaveNoBufferView) {
  GltfBuilder builder = triangleFile();
  builder.json["meshes"][0]["primitives"][0]["indices"] =
      builder.add("accessors", {{"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}});
  EXPECT_THAT(load(builder).scene.primitives.at(0).positions, ElementsAre(glm::vec3(0), glm::vec3(0), glm::vec3(0)));
}

// ---- Lines

TEST(GltfLimits, WarningsOfOneKindAreOneLine) {
  GltfBuilder builder = repeating(3, 30000);
  Json& primitives = builder.json["meshes"][0]["primitives"];
  for (size_t i = 0; i < primitives.size(); ++i) primitives[i]["mode"] = i < 10 ? 0 : i % 3 + 1;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(load(builder).warnings, ElementsAre("point primitives are not drawn (10 of them)",
                                                  "line primitives are not drawn (29,990 of them)"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(GltfLimits, LinesStayShortWhateverTheFileSays) {
  const std::string longText(100000, 'x');
  const TemporaryFolder folder;
  const auto lineOf = [&](const std::string& text) {
    std::ofstream(folder / "a.gltf") << text;
    const Loaded loaded = loadFile(folder / "a.gltf");  // checks the length
    return loaded.error + (loaded.warnings.empty() ? "" : loaded.warnings[0]);
  };
  EXPECT_THAT(lineOf("{\"extras\": \"" + longText + "\x01\"}"),
              AllOf(HasSubstr("is not valid glTF JSON: parse error at line 1"), HasSubstr("must be escaped to \\u0001"),
                    HasSubstr("; last read: '\"xxx"), EndsWith("xxx<U+0001>'")));
  EXPECT_THAT(lineOf("{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"" + longText + "\"]}"),
              AllOf(StartsWith("extension xxx"), HasSubstr("…"), EndsWith("xxx is ignored")));
  EXPECT_THAT(lineOf("{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"" + longText + "\"]}"),
              AllOf(StartsWith("extensionsRequired: needs xxx"), HasSubstr("x, which is not supported; export")));
  GltfBuilder builder = triangleFile();
  builder.json["buffers"] = {{{"byteLength", 36}, {"uri", longText + ".bin"}}};
  EXPECT_THAT(loadFile(builder.write(folder)).error, AllOf(StartsWith("buffers[0].uri: 'xxx"), HasSubstr("x.bin': ")));
}

// ---- Images

/// A PNG whose header says that it is of this size.
std::vector<uint8_t> pngThatClaims(uint32_t width, uint32_t height) {
  std::vector<uint8_t> png = test::rawPng(1, 1, 8, test::PngColor::grey, {0});
  for (int k = 0; k < 4; ++k) {
    png[16 + static_cast<size_t>(k)] = static_cast<uint8_t>(width >> (24 - 8 * k));
    png[20 + static_cast<size_t>(k)] = static_cast<uint8_t>(height >> (24 - 8 * k));
  }
  return png;
}

std::vector<uint8_t> jpegThatClaims(uint16_t width, uint16_t height) {
  const auto high = [](uint16_t v) { return static_cast<uint8_t>(v >> 8); };
  const auto low = [](uint16_t v) { return static_cast<uint8_t>(v); };
  return {0xFF, 0xD8, 0xFF, 0xE0,         0,           4,           'J',        'F', 0xFF, 0xFF, 0xC2,
          0,    11,   8,    high(height), low(height), high(width), low(width), 1,   1,    0x11, 0};
}

std::string errorWithImages(const std::vector<std::vector<uint8_t>>& images) {
  GltfBuilder builder = triangleFile();
  Json primitive = builder.json["meshes"][0]["primitives"][0];
  builder.json["meshes"][0]["primitives"] = Json::array();
  for (const std::vector<uint8_t>& image : images) {
    const int source = builder.add("images", {{"bufferView", builder.addView(image)}, {"mimeType", "image/png"}});
    const int texture = builder.add("textures", {{"source", source}});
    primitive["material"] =
        builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}});
    builder.json["meshes"][0]["primitives"].push_back(primitive);
  }
  return load(builder).error;
}

TEST(GltfLimits, ImagesLargerThanDevicesTakeAreNotDecoded) {
  EXPECT_LT(memoryOf([&] {
              EXPECT_EQ(errorWithImages({pngThatClaims(20000, 30000)}),
                        "images[0]: is 20000x30000, larger than 16384 pixels a side; make it smaller");
              EXPECT_THAT(errorWithImages({pngThatClaims(0xFFFFFFFF, 1)}), HasSubstr("is 4294967295x1, larger"));
              EXPECT_THAT(errorWithImages({jpegThatClaims(100, 16385)}), HasSubstr("is 100x16385, larger"));
            }),
            100 * kMegabyte);
}

}  // namespace

}  // namespace lensgraph
