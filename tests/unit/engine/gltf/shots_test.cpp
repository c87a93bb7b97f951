// The sample shots' models: loaded whole, and what is known of them holds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "engine/gltf/load_gltf.h"
#include "engine/image/image_io.h"
#include "engine/metrics/metrics.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph {

namespace {

using engine::Scene;
using Json = nlohmann::json;
namespace fs = std::filesystem;

const fs::path kShots = LENSGRAPH_SHOTS_DIR;

class Shots : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kShots / "README.md")) GTEST_SKIP() << "no shots in " << kShots;
  }
};

// The JSON of a .gltf or .glb, read without the loader under test.
Json jsonOf(const fs::path& path) {
  const std::vector<uint8_t> bytes = test::readBytes(path);
  if (bytes.at(0) != 'g') return Json::parse(bytes);
  uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  return Json::parse(std::span(bytes).subspan(20, length));
}

// Triangles of all nodes' meshes, from the counts in the JSON alone (every node of these files is in the
// scene).
uint64_t expectedTriangles(const Json& json) {
  uint64_t count = 0;
  for (const Json& node : json["nodes"]) {
    if (!node.contains("mesh")) continue;
    for (const Json& primitive : json["meshes"][node["mesh"].get<size_t>()]["primitives"]) {
      const bool isIndexed = primitive.contains("indices");
      const size_t accessor =
          isIndexed ? primitive["indices"].get<size_t>() : primitive["attributes"]["POSITION"].get<size_t>();
      count += json["accessors"][accessor]["count"].get<uint64_t>() / 3;
    }
  }
  return count;
}

std::vector<fs::path> modelFiles() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kShots)) {
    if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf") files.push_back(entry.path());
  }
  return files;
}

TEST_F(Shots, EveryModelLoadsWithAllItsTriangles) {
  ASSERT_GE(modelFiles().size(), 12u);
  for (const fs::path& path : modelFiles()) {
    SCOPED_TRACE(path.filename());
    Scene scene;
    engine::appendGltf(scene, path, glm::dmat4(1.0), {.isLit = false});
    EXPECT_EQ(engine::triangleCount(scene), expectedTriangles(jsonOf(path)));
    EXPECT_THAT(engine::findProblems(scene), testing::IsEmpty());
    EXPECT_FALSE(engine::worldBounds(scene).isEmpty());
  }
}

TEST_F(Shots, FoliageIsOfMaskedLeafQuads) {
  Scene scene;
  engine::appendGltf(scene, kShots / "foliage/foliage.glb");
  uint64_t maskedTriangles = 0;
  for (const engine::Instance& instance : scene.instances) {
    const engine::Primitive& primitive = scene.primitives[instance.primitive];
    const engine::Material& material = scene.materials[primitive.material];
    EXPECT_TRUE(material.unlit);
    if (material.alphaMode == engine::AlphaMode::mask) maskedTriangles += primitive.triangleCount();
  }
  EXPECT_EQ(maskedTriangles, 880u);
}

TEST_F(Shots, GlassHasEightBlendedPanes) {
  Scene scene;
  engine::appendGltf(scene, kShots / "glass/glass.glb");
  int panes = 0;
  for (const engine::Instance& instance : scene.instances) {
    panes += scene.materials[scene.primitives[instance.primitive].material].alphaMode == engine::AlphaMode::blend;
  }
  EXPECT_EQ(panes, 8);
}

TEST_F(Shots, TheHelmetHasItsTexturesAndSize) {
  Scene scene;
  engine::appendGltf(scene, kShots / "models/FlightHelmet/FlightHelmet.gltf");
  EXPECT_EQ(scene.instances.size(), 6u);
  EXPECT_EQ(scene.images.size(), 15u);
  const engine::Bounds bounds = engine::worldBounds(scene);
  EXPECT_NEAR(bounds.max.y - bounds.min.y, 0.7, 0.1);  // metres
}

TEST_F(Shots, TheToyCarWarnsOfWhatIsIgnored) {
  Scene scene;
  const auto warnings =
      engine::appendGltf(scene, kShots / "models/ToyCar/ToyCar.gltf", glm::dmat4(1.0), {.isLit = false});
  EXPECT_THAT(warnings, testing::Contains(testing::HasSubstr("KHR_materials_clearcoat is ignored")));
  EXPECT_THAT(warnings, testing::Contains(testing::HasSubstr("KHR_materials_transmission is ignored")));
}

// truth.json was written by another renderer from the same pictures.
TEST_F(Shots, TruthPicturesAreReadAsTheyWereWritten) {
  const Json truth = jsonOf(kShots / "glass/truth.json");
  const engine::FloatImage picture = engine::readImage(kShots / "glass/dof.exr");
  EXPECT_EQ(picture.width, 640u);
  EXPECT_EQ(picture.height, 360u);
  ASSERT_GE(picture.channels, 3u);
  const engine::FloatImage depth = engine::readDepth(kShots / "glass/depth.exr");
  ASSERT_EQ(depth.channels, 1u);
  float nearest = 1e30f, farthest = 0.0f;
  for (float d : depth.samples) {
    if (d >= 1e9f) continue;
    nearest = std::min(nearest, d);
    farthest = std::max(farthest, d);
  }
  EXPECT_NEAR(nearest, truth["depthRange"][0].get<float>(), 1e-4f);
  EXPECT_NEAR(farthest, truth["depthRange"][1].get<float>(), 1e-4f);
}

TEST_F(Shots, WithoutApertureTheTruthEqualsThePinholePicture) {
  const engine::Metrics metrics = engine::compareImages(engine::readImage(kShots / "sharp/dof.exr"),
                                                        engine::readImage(kShots / "sharp/pinhole.exr"));
  EXPECT_GT(metrics.psnr, 55.0);
  EXPECT_GT(metrics.ssim.value(), 0.999);
  EXPECT_EQ(metrics.nonFinitePixels, 0u);
}

}  // namespace

}  // namespace lensgraph
