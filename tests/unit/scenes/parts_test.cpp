// What the large scenes are made of: textures from reliefs, skies, and files that are whole or absent.
#include <gmock/gmock.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <vector>

#include "generate/whole_file.h"
#include "parts/sky.h"
#include "parts/surface_maps.h"
#include "tests/support/temporary_folder.h"

namespace scenes {
namespace {

using lensgraph::test::TemporaryFolder;
using testing::ElementsAre;

Relief reliefOf(const std::function<float(glm::vec2)>& height) {
  Relief relief;
  relief.size = 64;
  relief.depth = 0.5f;
  relief.height = height;
  relief.color = [](glm::vec2, float) { return glm::vec3(0.5f); };
  relief.roughness = [](glm::vec2, float) { return 0.25f; };
  relief.metallic = 1.0f;
  return relief;
}

TEST(SurfaceMaps, NormalsLeanAwayFromWhereTheReliefRises) {
  // glTF: red grows to the right of the texture, green upwards. The relief is half as deep as its tile is wide: a slope of 1/2.
  const Canvas toRight = mapsOf(reliefOf([](glm::vec2 p) { return p.x; })).normal;
  const glm::vec3 leansLeft = glm::vec3(toRight.at(32, 32)) * 2.0f - 1.0f;
  EXPECT_NEAR(leansLeft.x, -0.4472f, 1e-3f);
  EXPECT_NEAR(leansLeft.y, 0.0f, 1e-3f);
  EXPECT_NEAR(leansLeft.z, 0.8944f, 1e-3f);
  const Canvas downwards = mapsOf(reliefOf([](glm::vec2 p) { return p.y; })).normal;
  EXPECT_NEAR(downwards.at(32, 32).y * 2.0f - 1.0f, 0.4472f, 1e-3f);
}

TEST(SurfaceMaps, RoughnessIsGreenAndMetalBlue) {
  const Canvas map = mapsOf(reliefOf([](glm::vec2) { return 0.0f; })).metallicRoughness;
  EXPECT_FLOAT_EQ(map.at(1, 2).g, 0.25f);
  EXPECT_FLOAT_EQ(map.at(1, 2).b, 1.0f);
}

TEST(Sky, IsBrightestTowardsTheSunAndGroundColoredBelow) {
  const Sky sky;
  const float towards = radianceOf(sky, sky.towardsSun).x;
  EXPECT_GT(towards, radianceOf(sky, sky.towardsSun * glm::vec3(1, 1, -1)).x);
  EXPECT_EQ(radianceOf(sky, {0, -1, 0}), sky.ground);
}

TEST(WholeFile, KeepsTheOldFileAndNothingBesideItWhenWritingFails) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "scene.glb";
  lensgraph::test::writeBytes(file, std::vector<uint8_t>{1, 2, 3});
  const auto failing = [](const std::filesystem::path& path) {
    lensgraph::test::writeBytes(path, std::vector<uint8_t>{9});
    throw std::runtime_error("disk full");
  };
  EXPECT_THROW(writeWhole(file, failing), std::runtime_error);
  EXPECT_THAT(lensgraph::test::readBytes(file), ElementsAre(1, 2, 3));
  EXPECT_THAT(folder.names(), ElementsAre("scene.glb"));
}

}  // namespace
}  // namespace scenes
