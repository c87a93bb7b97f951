// Drawn and ray-traced pictures of lit scenes at pixel centers, without a lens: no noise hides a difference.
#include <gmock/gmock.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/metrics/metrics.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph {

namespace {

constexpr uint32_t kCells = 40;  ///< A side; a cell's triangles are smaller than the 2x2 pixels that share derivatives.

/// A bent sheet of small triangles, 2 m in front of the camera, with a normal map that leans and tiles with a rotation.
engine::Scene sheet(float bend) {
  engine::Scene scene;
  engine::Material material;
  material.metallicFactor = 0.3f;
  material.roughnessFactor = 0.4f;
  material.normalTexture = {.texture = 0, .uvSet = 0, .offset = {0.1f, 0.2f}, .rotation = 0.4f, .scale = {2.0f, 3.0f}};
  scene.materials.push_back(material);
  scene.images.push_back({.name = "leaning", .width = 1, .height = 1, .rgba = {190, 90, 220, 255}});
  scene.textures.push_back({.image = 0});
  engine::Primitive grid;
  for (uint32_t row = 0; row <= kCells; ++row) {
    for (uint32_t column = 0; column <= kCells; ++column) {
      const float u = static_cast<float>(column) / kCells, v = static_cast<float>(row) / kCells;
      const float x = 2.4f * u - 1.2f, y = 1.2f - 2.4f * v;
      grid.positions.emplace_back(x, y, -2.0f - bend * x * x);
      grid.normals.push_back(glm::normalize(glm::vec3(2.0f * bend * x, 0.0f, 1.0f)));
      grid.uvs[0].emplace_back(u, v);
      grid.bounds.add(grid.positions.back());
      if (row == kCells || column == kCells) continue;
      const uint32_t a = row * (kCells + 1) + column, b = a + kCells + 1;
      for (const uint32_t index : {a, b, a + 1, a + 1, b, b + 1}) grid.indices.push_back(index);
    }
  }
  grid.material = 0;
  scene.primitives.push_back(grid);
  scene.instances.push_back({.primitive = 0, .worldFromObject = glm::dmat4(1.0), .name = "sheet"});
  return scene;
}

engine::Light light(engine::LightType type, float intensity, const glm::dvec3& position, double turn) {
  engine::Light made;
  made.type = type;
  made.color = {1.0f, 0.8f, 0.6f};
  made.intensity = intensity;
  made.outerConeAngle = 0.6f;
  made.worldFromLight = glm::rotate(glm::translate(glm::dmat4(1.0), position), turn, glm::dvec3(0.0, 1.0, 0.0));
  return made;
}

class LitScene : public support::GpuTest {
 protected:
  LitScene() : shot_(support::smallShot(48, 48)) {
    shot_.shading = host::Shading::lit;
    shot_.lens.apertureRadius = 0.0;
  }
  engine::FloatImage drawn(host::Renderer& renderer) const {
    return support::render(renderer, shot_, "pinhole", {{"pixelSamples", int64_t{1}}}).color;
  }
  host::Shot shot_;
};

// Helper invocations, which fill up the 2x2 pixels along a triangle's edge, must not spoil the derivatives.
TEST_F(LitScene, ASheetOfManyTrianglesIsAsEvenAsOneOfTwo) {
  auto scene = sheet(0.0f);
  scene.materials[0].metallicFactor = 0.0f;
  scene.materials[0].roughnessFactor = 1.0f;
  scene.lights.push_back(light(engine::LightType::directional, 3.0f, {}, 0.3));
  shot_.camera.fovyDeg = 5.0;
  shot_.width = shot_.height = 24;
  for (auto& position : scene.primitives[0].positions) position = {0.2f * position.x, 0.2f * position.y, position.z};
  host::Renderer renderer(support::device(), scene, std::nullopt);
  const auto picture = drawn(renderer);
  const float first = picture.pixel(0, 0)[0];
  EXPECT_GT(first, 0.1f);
  for (std::size_t i = 0; i < picture.pixelCount(); ++i) EXPECT_NEAR(picture.samples[4 * i], first, 0.02f * first) << i;
}

TEST_F(LitScene, DrawnAndRayTracedPicturesAgreePixelByPixel) {
  auto scene = sheet(0.3f);
  scene.lights.push_back(light(engine::LightType::directional, 1.0f, {}, 0.5));
  scene.lights.push_back(light(engine::LightType::point, 2.0f, {0.5, 0.6, -1.0}, 0.0));
  scene.lights.push_back(light(engine::LightType::spot, 6.0f, {-0.3, 0.0, 0.0}, 0.1));
  engine::FloatImage sky(16, 8, 3);
  for (uint32_t y = 0; y < 8; ++y) {
    for (uint32_t x = 0; x < 16; ++x) {
      for (uint32_t i = 0; i < 3; ++i) sky.pixel(x, y)[i] = 0.1f + 0.1f * static_cast<float>((x * (i + 1) + 2 * y) % 7);
    }
  }
  host::Renderer renderer(support::device(), scene, engine::prepareEnvironment(sky));
  const auto one = drawn(renderer);
  const auto other =
      support::render(renderer, shot_, "raytraced", {{"samples", int64_t{1}}, {"pixelFilter", std::string("point")}})
          .color;
  support::keepPicture(one, "lit_drawn");
  support::keepPicture(other, "lit_raytraced");
  const double psnr = engine::compareImages(other, one).psnr;
  std::printf("lit at pixel centers %.2f dB\n", psnr);
  EXPECT_GE(psnr, 60.0);
}

}  // namespace

}  // namespace lensgraph
