// Computes viewFromWorld from a look-at or from a matrix. See camera.h for conventions.
#include "engine/scene/camera.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <string>

#include "engine/error.h"

namespace lensgraph::engine {
namespace {

// Below this sine of the angle between axis and up, rounding decides about the roll of the camera.
constexpr double kMinUpSine = 1e-6;

constexpr const char* kCloser = "coordinates must be below 1e30";

[[noreturn]] void fail(const std::string& field, const std::string& reason, const std::string& remedy = {}) {
  throw Error(ErrorParts{.file = {}, .field = field, .reason = reason, .remedy = remedy});
}

bool isFinite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Whether no coordinate is beyond what can be drawn.
bool isNear(const glm::dvec3& v) {
  return std::fabs(v.x) < kFarthestCoordinate && std::fabs(v.y) < kFarthestCoordinate &&
         std::fabs(v.z) < kFarthestCoordinate;
}

/// A direction of unit length without the overflow and underflow of squaring: the vector is scaled by its largest
/// component first. Nothing when it has no direction, because it is zero or not finite.
std::optional<glm::dvec3> direction(const glm::dvec3& v) {
  const double largest = std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
  if (!(largest > 0.0) || !std::isfinite(largest)) return std::nullopt;
  // A denormal divisor would overflow 1/largest, the quotient itself does not.
  return glm::normalize(v / largest);
}

/// The camera's right side, from where it looks and roughly up; nothing when these two are parallel.
std::optional<glm::dvec3> rightOf(const glm::dvec3& forward, const glm::dvec3& up) {
  const glm::dvec3 side = glm::cross(forward, up);
  const double sine = glm::length(side);
  if (!(sine > kMinUpSine)) return std::nullopt;
  return side / sine;
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

std::optional<LookAtProblem> findProblem(const LookAt& lookAt) {
  const auto problem = [](const char* field, const char* reason, const char* remedy = "") {
    return LookAtProblem{.field = field, .reason = reason, .remedy = remedy};
  };
  if (!isFinite(lookAt.position)) return problem("position", "is not finite");
  if (!isFinite(lookAt.target)) return problem("target", "is not finite");
  if (!isFinite(lookAt.up)) return problem("up", "is not finite");
  if (!isNear(lookAt.position)) return problem("position", "is too far away", kCloser);
  if (!(lookAt.fovyDeg > 0.0 && lookAt.fovyDeg < 180.0)) {
    std::array<char, 64> reason{};
    std::snprintf(reason.data(), reason.size(), "is %g, must be above 0 and below 180 degrees", lookAt.fovyDeg);
    return problem("fovyDeg", reason.data());
  }
  const glm::dvec3 axis = lookAt.target - lookAt.position;
  const auto forward = direction(axis);
  if (!forward) {
    if (!isFinite(axis)) return problem("target", "is too far away");
    return problem("target", "is the camera's position: there is no direction to look in", "look at another point");
  }
  const auto up = direction(lookAt.up);
  if (!up) return problem("up", "is zero", "usually it is [0, 1, 0]");
  if (!rightOf(*forward, *up)) {
    return problem("up", "is parallel to the direction of view", "choose an up vector across it");
  }
  return std::nullopt;
}

Camera cameraFromLookAt(const LookAt& lookAt, double nearPlane) {
  if (const auto problem = findProblem(lookAt)) fail("camera." + problem->field, problem->reason, problem->remedy);
  if (!(nearPlane > 0.0) || !std::isfinite(nearPlane)) fail("camera.nearPlane", "is not a positive length");
  // The directions exist: findProblem() looked for them.
  const glm::dvec3 forward = direction(lookAt.target - lookAt.position).value();
  const glm::dvec3 right = rightOf(forward, direction(lookAt.up).value()).value();
  Camera camera;
  camera.viewFromWorld = viewFromAxes(right, glm::cross(right, forward), -forward, lookAt.position);
  camera.fovy = lookAt.fovyDeg * (3.14159265358979323846 / 180.0);
  camera.nearPlane = nearPlane;
  return camera;
}

glm::dmat4 viewFromCameraMatrix(const glm::dmat4& worldFromCamera, const std::string& field) {
  const auto back = direction(glm::dvec3(worldFromCamera[2]));
  if (!back) fail(field, "has a transform without a direction");
  const auto up = direction(glm::dvec3(worldFromCamera[1]));
  if (!up) fail(field, "has a transform without an up direction");
  const auto right = rightOf(-*back, *up);
  if (!right) fail(field, "has a degenerate transform");
  const glm::dvec3 position(worldFromCamera[3]);
  if (!isNear(position)) fail(field, "is too far away");
  return viewFromAxes(*right, glm::cross(*back, *right), *back, position);
}

double pixelsPerTangent(const Camera& camera, uint32_t imageHeight) {
  return imageHeight / (2.0 * std::tan(0.5 * camera.fovy));
}

}  // namespace lensgraph::engine
