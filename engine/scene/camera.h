// The pinhole camera of a shot. Right-handed view space, looking down −Z, viewDepth = −z_view.
//
// Matrices are double: shots stand at coordinates around 1e6, where a float metre has 6 cm steps. Multiply
// viewFromWorld · worldFromObject in double and round the product. The lens is not part of it
// (passes/lens/physical_lens.h), nor is the projection.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace lensgraph::engine {

inline constexpr double kDefaultNearPlane = 0.01;  ///< m. Below it reversed depth still has full float precision.

struct Camera {
  glm::dmat4 viewFromWorld{1.0};         ///< Rigid: rotation and translation, no scale.
  double fovy = 0.6981317007977318;      ///< Vertical field of view, rad. 40 degrees.
  double nearPlane = kDefaultNearPlane;  ///< m along the axis; nothing nearer is drawn.

  /// Position of the lens centre in the world.
  glm::dvec3 position() const;
};

struct LookAt {
  glm::dvec3 position{0.0, 0.0, 0.0};  ///< m
  glm::dvec3 target{0.0, 0.0, -1.0};   ///< m; any point on the axis in front of the camera
  glm::dvec3 up{0.0, 1.0, 0.0};        ///< Need be neither normalised nor perpendicular to the axis.
  double fovyDeg = 40.0;               ///< In (0, 180).
};

/// What keeps a LookAt from being a camera, in words for who wrote it.
struct LookAtProblem {
  std::string field;   ///< The member's name: "position", "target", "up" or "fovyDeg".
  std::string reason;  ///< Continues the field's name: "is zero".
  std::string remedy;  ///< What to do about it; may be empty.
};

/// A camera's coordinates are below this, in the scene's unit: from beyond it nothing that is described by floats could be
/// seen.
inline constexpr double kFarthestCoordinate = 1e30;

/// The first problem of a LookAt: non-finite numbers, a position beyond kFarthestCoordinate, target at the position, up zero or along the
/// axis, field of view outside (0, 180) degrees. Nothing when cameraFromLookAt() accepts it.
std::optional<LookAtProblem> findProblem(const LookAt& lookAt);

/// Throws Error for the LookAt's problem (fields named camera.position, camera.target, …), or for a near plane that is
/// not a positive length.
Camera cameraFromLookAt(const LookAt& lookAt, double nearPlane = kDefaultNearPlane);

/// The view of a camera that stands in the world by this matrix and looks down its −Z. Scale, shear and mirroring are
/// dropped: backward is kept, then up. Throws Error with the field `field` where no direction is left.
glm::dmat4 viewFromCameraMatrix(const glm::dmat4& worldFromCamera, const std::string& field);

/// S = h / (2 tan(fovy/2)): pixels per unit of tangent, equal in x and y (square pixels).
double pixelsPerTangent(const Camera& camera, uint32_t imageHeight);

}  // namespace lensgraph::engine
