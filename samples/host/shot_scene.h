// The engine's side of a shot: its scene and its camera.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/camera.h"
#include "engine/scene/scene.h"
#include "samples/host/shot.h"

namespace lensgraph::host {

/// Loads every part of the shot into one scene. Throws engine::Error; the loader's warnings are appended.
engine::Scene loadShotScene(const Shot& shot, std::vector<std::string>& warnings);

/// The shot's own camera, or the one it names in the scene. Near plane in metres. Throws engine::Error.
engine::Camera shotCamera(const Shot& shot, const engine::Scene& scene);

}  // namespace lensgraph::host
