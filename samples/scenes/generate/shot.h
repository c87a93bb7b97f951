// A shot file for a scene, and what it will show: the depths inside its view and the largest blur.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "generate/glb.h"

namespace scenes {

struct Camera {
  glm::vec3 position{0.0f};
  glm::vec3 target{0.0f, 0.0f, -1.0f};
  float fovyDeg = 40.0f;
  std::string gltfName{};  ///< When given, the shot refers to the scene's camera of this name instead.
};

struct Lens {
  double apertureRadius = 0.0;  ///< m; used when focalLengthMm is not given.
  double focusDistance = 1.0;   ///< m
  std::optional<double> focalLengthMm{};
  double fStop = 0.0;

  double radius() const { return focalLengthMm ? *focalLengthMm * 1e-3 / (2.0 * fStop) : apertureRadius; }
};

struct Shot {
  std::string name;  ///< The file is NAME.json.
  std::string description;
  Camera camera;
  Lens lens;
  std::array<double, 3> background{0.0, 0.0, 0.0};
  bool lit = false;
  std::string environment;  ///< File beside the shot, or empty.
};

/// Depths of all triangles inside the view, hidden ones included, and their blur radii at 640×360.
struct Extent {
  double nearDepth = 0.0;  ///< m
  double farDepth = 0.0;   ///< m
  double nearCocPx = 0.0;  ///< Signed: negative in front of focus.
  double farCocPx = 0.0;
  double backgroundCocPx = 0.0;  ///< Of infinity.
};

Extent measure(const Shot& shot, const Glb& scene);

void writeShot(const std::filesystem::path& file, const Shot& shot, const std::string& sceneFile);

}  // namespace scenes
