// Loading of a shot's parts.
#include "samples/host/shot_scene.h"

#include <glm/mat4x4.hpp>
#include <utility>

#include "engine/error.h"
#include "engine/gltf/load_gltf.h"
#include "engine/image/image_io.h"
#include "engine/scene/camera_choice.h"

namespace lensgraph::host {

void rethrowNamingShot(const engine::Error& error, const Shot& shot, const std::string& field) {
  engine::ErrorParts parts = error.parts();
  if (parts.file.empty() && error.kind() == engine::ErrorKind::badInput) {
    parts.file = shot.file.string();
    if (parts.field.empty()) parts.field = field;
  }
  throw engine::Error(std::move(parts), error.kind());
}

engine::Scene loadShotScene(const Shot& shot, std::vector<std::string>& warnings) {
  engine::Scene scene;
  const engine::GltfOptions options{.isLit = shot.shading == Shading::lit};
  for (std::size_t i = 0; i < shot.scene.size(); ++i) {
    const auto& part = shot.scene[i];
    const glm::dmat4 worldFromFile = namingShot(shot, "scene[" + std::to_string(i) + "]",
                                                [&] { return engine::worldFromFileTransform(part.transform); });
    for (auto& warning : engine::appendGltf(scene, part.path, worldFromFile, options)) {
      warnings.push_back(std::move(warning));
    }
  }
  return scene;
}

engine::Camera shotCamera(const Shot& shot, const engine::Scene& scene) {
  return namingShot(shot, "camera", [&] {
    const auto& given = shot.camera.nearPlane;
    if (!shot.camera.gltfCamera) {
      return engine::cameraFromLookAt(shot.camera, given.value_or(engine::kDefaultNearPlane));
    }
    auto camera = engine::cameraFromScene(scene, *shot.camera.gltfCamera, given);
    if (!given) camera.nearPlane *= shot.lens.metersPerUnit;
    return camera;
  });
}

std::optional<engine::Environment> loadShotEnvironment(const Shot& shot) {
  if (!shot.environment) return std::nullopt;
  return namingShot(shot, "environment",
                    [&] { return engine::prepareEnvironment(engine::readImage(*shot.environment)); });
}

}  // namespace lensgraph::host
