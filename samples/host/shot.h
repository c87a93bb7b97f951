// A shot file: scene, camera, lens, resolution, technique. Parsed, checked, and free of JSON.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gltf/load_gltf.h"
#include "engine/scene/camera.h"
#include "engine/scene/camera_choice.h"
#include "engine/scene/viewpoint.h"
#include "passes/lens/physical_lens.h"
#include "passes/parameters.h"

namespace lensgraph::host {

/// px. The device's own limit is checked when it renders.
inline constexpr int kMaxResolution = 16384;

struct ScenePart {
  std::filesystem::path path;       ///< Absolute, or relative to the working directory: resolved by the parser.
  engine::FileTransform transform;  ///< Its rotation is of unit length.
};

struct ShotCamera : engine::LookAt {
  /// m, > 0; none: kDefaultNearPlane, or that of the scene's camera.
  std::optional<double> nearPlane;
  std::optional<engine::CameraChoice> gltfCamera;  ///< A camera of the scene, instead of position, target, up and fovy.
};

enum class Shading { unlit, lit };

struct Shot {
  std::filesystem::path file;  ///< Where it was read from, for messages; empty for one made in memory.
  std::string name;
  std::vector<ScenePart> scene;
  ShotCamera camera;
  passes::Lens lens;
  int width = 640, height = 360;                         ///< px, 1…kMaxResolution.
  std::array<float, 3> background = {0.0f, 0.0f, 0.0f};  ///< Linear radiance.
  std::optional<std::filesystem::path> environment;
  Shading shading = Shading::unlit;
  engine::DrawnFaces faces = engine::DrawnFaces::material;
  std::string technique = "accumulation";
  passes::ParameterSet parameters;
};

/// The faces that a shot or the command line names, "material" or "both"; nothing for other texts.
std::optional<engine::DrawnFaces> drawnFacesFrom(std::string_view text);
/// The name that drawnFacesFrom() reads.
std::string_view nameOf(engine::DrawnFaces faces);

/// Reads and checks a shot file. Throws engine::Error with file, field (or line and column), reason, remedy.
Shot readShot(const std::filesystem::path& file);

}  // namespace lensgraph::host
