// Small scenes of textured quads, and shots that look at them.
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph::support {

uint32_t addMaterial(engine::Scene& scene, const glm::vec4& color) {
  engine::Material material;
  material.baseColorFactor = color;
  material.unlit = true;
  material.alphaMode = color.a < 1.0f ? engine::AlphaMode::blend : engine::AlphaMode::opaque;
  scene.materials.push_back(material);
  return static_cast<uint32_t>(scene.materials.size() - 1);
}

void addQuad(engine::Scene& scene, const std::array<glm::vec3, 4>& corners, uint32_t material) {
  engine::Primitive quad;
  quad.positions.assign(corners.begin(), corners.end());
  quad.normals.assign(4, glm::vec3(0.0f, 0.0f, 1.0f));
  quad.indices = {0, 1, 2, 0, 2, 3};
  quad.material = material;
  for (const auto& corner : corners) quad.bounds.add(corner);
  scene.primitives.push_back(quad);
  scene.instances.push_back({.primitive = static_cast<uint32_t>(scene.primitives.size() - 1),
                             .worldFromObject = glm::dmat4(1.0),
                             .name = "quad"});
}

void addFacingQuad(engine::Scene& scene, double depth, double x, double y, double halfWidth, double halfHeight,
                   uint32_t material) {
  const auto z = static_cast<float>(-depth);
  const auto left = static_cast<float>(x - halfWidth), right = static_cast<float>(x + halfWidth);
  const auto bottom = static_cast<float>(y - halfHeight), top = static_cast<float>(y + halfHeight);
  addQuad(scene, {glm::vec3(left, bottom, z), {right, bottom, z}, {right, top, z}, {left, top, z}}, material);
}

host::Shot smallShot(int width, int height) {
  host::Shot shot;
  shot.name = "test";
  shot.width = width;
  shot.height = height;
  shot.camera.fovyDeg = 40.0;
  shot.lens.apertureRadius = 0.02;
  shot.lens.focusDistance = 2.0;
  return shot;
}

engine::Scene layeredScene() {
  engine::Scene scene;
  const uint32_t red = addMaterial(scene, {0.9f, 0.1f, 0.05f, 1.0f});
  const uint32_t white = addMaterial(scene, {0.8f, 0.8f, 0.7f, 1.0f});
  const uint32_t dark = addMaterial(scene, {0.05f, 0.07f, 0.1f, 1.0f});
  const uint32_t blue = addMaterial(scene, {0.1f, 0.3f, 0.8f, 1.0f});
  const uint32_t bright = addMaterial(scene, {6.0f, 5.0f, 3.0f, 1.0f});
  addFacingQuad(scene, 0.8, -0.05, 0.0, 0.02, 1.0, red);
  for (int x = -4; x < 4; ++x) {
    for (int y = -3; y < 3; ++y) {
      addFacingQuad(scene, 2.0, 0.2 * x + 0.1, 0.2 * y + 0.1, 0.08, 0.08, (x + y) % 2 == 0 ? white : dark);
    }
  }
  addFacingQuad(scene, 6.0, 0.0, 0.0, 8.0, 6.0, blue);
  addFacingQuad(scene, 5.0, 1.1, 0.9, 0.05, 0.05, bright);
  return scene;
}

engine::Scene constantScene(const glm::vec3& color) {
  engine::Scene scene;
  const uint32_t material = addMaterial(scene, {color, 1.0f});
  addFacingQuad(scene, 20.0, 0.0, 0.0, 40.0, 30.0, material);
  addQuad(scene, {glm::vec3(-3, -1, -1), {3, -1, -1}, {3, 1, -9}, {-3, 1, -9}}, material);
  addFacingQuad(scene, 1.0, 0.1, 0.0, 0.05, 1.0, material);
  return scene;
}

}  // namespace lensgraph::support
