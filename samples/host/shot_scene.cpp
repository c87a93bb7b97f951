// Loading of a shot's parts.
#include "samples/host/shot_scene.h"

#include <glm/mat4x4.hpp>
#include <utility>

#include "engine/gltf/load_gltf.h"

namespace lensgraph::host {

engine::Scene loadShotScene(const Shot& shot, std::vector<std::string>& warnings) {
  engine::Scene scene;
  const engine::GltfOptions options{.isLit = shot.shading == Shading::lit};
  for (const auto& part : shot.scene) {
    const glm::dmat4 worldFromFile = engine::worldFromFileTransform(part.transform);
    for (auto& warning : engine::appendGltf(scene, part.path, worldFromFile, options)) {
      warnings.push_back(std::move(warning));
    }
  }
  return scene;
}

engine::Camera shotCamera(const Shot& shot, const engine::Scene& scene) {
  if (shot.camera.gltfCamera) {
    auto camera = engine::cameraFromScene(scene, *shot.camera.gltfCamera);
    camera.nearPlane *= shot.lens.metersPerUnit;
    return camera;
  }
  return engine::cameraFromLookAt(shot.camera, shot.camera.nearPlane);
}

engine::FloatImage withOpaqueAlpha(const engine::FloatImage& picture) {
  if (picture.channels == 4) return picture;
  engine::FloatImage out(picture.width, picture.height, 4, 1.0f);
  for (std::size_t i = 0; i < picture.pixelCount(); ++i) {
    for (uint32_t c = 0; c < 3; ++c) {
      out.samples[i * 4 + c] = picture.samples[i * picture.channels + (picture.channels >= 3 ? c : 0)];
    }
  }
  return out;
}

}  // namespace lensgraph::host
