// Look-at and file cameras to viewFromWorld. See camera.h for conventions.
#include "engine/scene/camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <string>

#include "engine/error.h"

namespace lensgraph::engine {
namespace {

// Below this sine of the angle between axis and up, the roll of the camera is rounding noise.
constexpr double kMinUpSine = 1e-9;

[[noreturn]] void fail(const char* field, const std::string& reason, const std::string& remedy = {}) {
  throw Error(ErrorParts{.file = {}, .field = field, .reason = reason, .remedy = remedy});
}

void requireFinite(const char* field, const glm::dvec3& v) {
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) fail(field, "is not finite");
}

// A direction of unit length without the overflow and underflow of squaring: scales by the largest component
// first.
glm::dvec3 direction(const char* field, const glm::dvec3& v, const char* zeroReason) {
  const double largest = std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
  if (!(largest > 0.0)) fail(field, zeroReason);
  if (!std::isfinite(largest)) fail(field, "is too far away");
  // A denormal divisor would overflow 1/largest, the quotient itself does not.
  return glm::normalize(v / largest);
}

// Rows are the camera's axes: right, up, backward.
glm::dmat4 viewFromAxes(const glm::dvec3& right, const glm::dvec3& up, const glm::dvec3& back,
                        const glm::dvec3& position) {
  const glm::dmat3 rotation = glm::transpose(glm::dmat3(right, up, back));
  glm::dmat4 view(rotation);
  view[3] = glm::dvec4(-(rotation * position), 1.0);
  return view;
}

}  // namespace

glm::dvec3 Camera::position() const {
  const glm::dmat3 rotation(viewFromWorld);
  return -(glm::transpose(rotation) * glm::dvec3(viewFromWorld[3]));
}

Camera cameraFromLookAt(const LookAt& lookAt, double nearPlane) {
  requireFinite("camera.position", lookAt.position);
  requireFinite("camera.target", lookAt.target);
  requireFinite("camera.up", lookAt.up);
  if (!(lookAt.fovyDeg > 0.0 && lookAt.fovyDeg < 180.0)) {
    fail("camera.fovyDeg", std::to_string(lookAt.fovyDeg) + " is not inside (0, 180)", "give it in degrees");
  }
  if (!(nearPlane > 0.0) || !std::isfinite(nearPlane)) fail("camera.nearPlane", "is not a positive length");

  const glm::dvec3 forward = direction("camera.target", lookAt.target - lookAt.position,
                                       "is the camera's position: there is no direction to look in");
  const glm::dvec3 upHint = direction("camera.up", lookAt.up, "is zero");
  const glm::dvec3 side = glm::cross(forward, upHint);
  const double sine = glm::length(side);
  if (!(sine > kMinUpSine)) {
    fail("camera.up", "is parallel to the direction of view", "choose an up vector across it");
  }
  const glm::dvec3 right = side / sine;
  Camera camera;
  camera.viewFromWorld = viewFromAxes(right, glm::cross(right, forward), -forward, lookAt.position);
  camera.fovy = lookAt.fovyDeg * (3.14159265358979323846 / 180.0);
  camera.nearPlane = nearPlane;
  return camera;
}

Camera cameraFromScene(const Scene& scene, std::string_view name) {
  const SceneCamera* found = findCamera(scene, std::string(name));
  if (found == nullptr) {
    std::string names;
    for (const SceneCamera& camera : scene.cameras) {
      const std::string& shown = camera.name.empty() ? camera.nodeName : camera.name;
      names += (names.empty() ? "'" : ", '") + shown + "'";
    }
    fail("camera.gltfCamera", "there is no camera '" + std::string(name) + "' in the scene",
         names.empty() ? "the scene has no perspective cameras" : "it has " + names);
  }
  const glm::dmat4& world = found->worldFromCamera;
  // Columns may be scaled, sheared or mirrored; the view keeps backward, then up, and is right-handed again.
  const glm::dvec3 back = direction("camera.gltfCamera", glm::dvec3(world[2]), "has a transform without a direction");
  const glm::dvec3 upHint =
      direction("camera.gltfCamera", glm::dvec3(world[1]), "has a transform without an up direction");
  const glm::dvec3 side = glm::cross(upHint, back);
  const double sine = glm::length(side);
  if (!(sine > kMinUpSine)) fail("camera.gltfCamera", "has a degenerate transform");
  const glm::dvec3 right = side / sine;
  Camera camera;
  camera.viewFromWorld = viewFromAxes(right, glm::cross(back, right), back, glm::dvec3(world[3]));
  camera.fovy = found->yfov;
  camera.nearPlane = found->znear;
  return camera;
}

double pixelsPerTangent(const Camera& camera, uint32_t imageHeight) {
  return imageHeight / (2.0 * std::tan(0.5 * camera.fovy));
}

}  // namespace lensgraph::engine
