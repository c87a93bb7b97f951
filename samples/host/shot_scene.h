// The engine's side of a shot: its scene, its camera, its environment.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/draw/environment.h"
#include "engine/error.h"
#include "engine/scene/camera.h"
#include "engine/scene/scene.h"
#include "samples/host/shot.h"

namespace lensgraph::host {

/// Throws the error again; one of bad input that names no file gets the shot's, and `field` where it has none.
[[noreturn]] void rethrowNamingShot(const engine::Error& error, const Shot& shot, const std::string& field);

/// Calls `work` and returns what it returns; its errors go through rethrowNamingShot().
template <class Work>
auto namingShot(const Shot& shot, const std::string& field, const Work& work) {
  try {
    return work();
  } catch (const engine::Error& error) {
    rethrowNamingShot(error, shot, field);
  }
}

/// Loads every part of the shot into one scene. Throws engine::Error; the loader's warnings are appended.
engine::Scene loadShotScene(const Shot& shot, std::vector<std::string>& warnings);

/// The shot's own camera, or the one of the scene that it chooses. Near plane in metres. Throws engine::Error.
engine::Camera shotCamera(const Shot& shot, const engine::Scene& scene);

/// The picture that lights the shot, prepared; none when it has none. Throws engine::Error.
std::optional<engine::Environment> loadShotEnvironment(const Shot& shot);

}  // namespace lensgraph::host
