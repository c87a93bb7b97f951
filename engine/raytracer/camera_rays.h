// Rays of a thin lens in view space, from first principles: from a point of the lens through the point of the plane of
// focus that the pixel looks at.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/raytracer/ray_lens.h"

namespace lensgraph::engine {

/// The point at parameter t is origin + t·direction. direction.z is -1, so t is the view depth in metres.
struct ViewRay {
  glm::vec3 origin{0.0f}, direction{0.0f, 0.0f, -1.0f};
};

class CameraRays {
 public:
  explicit CameraRays(const RayTracedView& view);

  /// film: px from the picture's left top corner, y down. lensPoint: view space, m, x right, y up.
  ViewRay through(const glm::dvec2& film, const glm::dvec2& lensPoint) const;
  /// Where the film's point lies from the picture's center, in half diagonals, y up.
  glm::dvec2 placeOf(const glm::dvec2& film) const;

 private:
  glm::dvec2 center_;           ///< px
  double tangentPerPixel_;      ///< Tangent of the angle to the axis, of one pixel at the picture's center.
  double inverseFocus_;         ///< 1/m; 0 is focus at infinity.
  double inverseHalfDiagonal_;  ///< 1/px
};

}  // namespace lensgraph::engine
