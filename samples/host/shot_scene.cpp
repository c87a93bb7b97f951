// Loading of a shot's parts.
#include "samples/host/shot_scene.h"

#include <glm/mat4x4.hpp>
#include <utility>

#include "engine/gltf/load_gltf.h"

namespace lensgraph::host {

engine::Scene loadShotScene(const Shot& shot, std::vector<std::string>& warnings) {
  engine::Scene scene;
  const engine::GltfOptions options{.loadShadingTextures = shot.shading == Shading::lit};
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

}  // namespace lensgraph::host
