// The geometry of a thin lens. A pixel's light comes, through the lens' center, from the direction (x, y, -1) with x and y
// the tangents of its angles to the axis. Light from the point F = d_f·(x, y, -1) of the plane of focus meets there again,
// whichever point L of the lens it passes; so the ray through L is L + s·(F - L), and with s = t / d_f it is
//   L + t·((x, y, -1) - (L_x, L_y, 0) / d_f),
// in which d_f = ∞ needs no special case.
#include "engine/raytracer/camera_rays.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace lensgraph::engine {
namespace {

/// Tangent of the angle between the axis and the picture's upper edge.
double halfHeightTangent(const RayTracedView& view) {
  if (!view.lens.breathing) return std::tan(view.camera.fovy / 2.0);
  // Focused, the sensor stands where the lens forms the image: 1/f = 1/object distance + 1/image distance.
  const double imageDistance = 1.0 / (1.0 / view.lens.breathing->focalLength - 1.0 / view.lens.focusDistance);
  return view.lens.breathing->sensorHeight / 2.0 / imageDistance;
}

}  // namespace

CameraRays::CameraRays(const RayTracedView& view)
    : center_(view.width / 2.0, view.height / 2.0),
      tangentPerPixel_(halfHeightTangent(view) / center_.y),
      inverseFocus_(1.0 / view.lens.focusDistance),
      inverseHalfDiagonal_(1.0 / glm::length(center_)) {}

ViewRay CameraRays::through(const glm::dvec2& film, const glm::dvec2& lensPoint) const {
  const double x = (film.x - center_.x) * tangentPerPixel_;
  const double y = (center_.y - film.y) * tangentPerPixel_;
  return {.origin = glm::vec3(lensPoint.x, lensPoint.y, 0.0),
          .direction = glm::vec3(x - lensPoint.x * inverseFocus_, y - lensPoint.y * inverseFocus_, -1.0)};
}

glm::dvec2 CameraRays::placeOf(const glm::dvec2& film) const {
  return glm::dvec2(film.x - center_.x, center_.y - film.y) * inverseHalfDiagonal_;
}

}  // namespace lensgraph::engine
