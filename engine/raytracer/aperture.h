// Which points of the lens let light through, and how much: round and polygonal apertures, anamorphic ratio, cat's eye,
// spherical aberration.
//
// Written from the meaning of the fields (RayLens), not from shaders/shared/aperture.h: a polygon is an intersection of
// half planes or discs, and its points are found by rejection from the unit disc.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "engine/raytracer/ray_lens.h"

namespace lensgraph::engine {

/// Points are in units of the aperture's radius with x to the right and y up, and so is `place`: the point of the picture
/// that looks through the lens, from the picture's center, in half diagonals.
class Aperture {
 public:
  explicit Aperture(const RayLens& lens);

  /// A uniformly distributed point of the unit disc becomes a candidate for a point of the aperture: stretched. What
  /// isOpen() accepts of the candidates is uniformly distributed over the aperture.
  glm::dvec2 candidate(const glm::dvec2& ofDisc) const;
  bool isOpen(const glm::dvec2& candidate, const glm::dvec2& place) const;
  /// What light through an open point counts for: 1 + a (2ρ² - 1), at least 0, with ρ the fraction of the way from the
  /// center to the edge. Its mean over the aperture is 1, since ρ² is uniformly distributed.
  double weight(const glm::dvec2& point) const;

 private:
  /// One side of the polygon: everything within `radius` of `center`, or, without a radius, below `offset` along `axis`.
  struct Blade {
    glm::dvec2 axis;    ///< Unit length, from the center through the middle of the side.
    double offset = 0;  ///< Of the straight side from the center.
    glm::dvec2 center{0.0};
    double radius = 0;
  };
  glm::dvec2 unstretched(const glm::dvec2& point) const { return {point.x / stretch_, point.y * stretch_}; }

  double stretch_;  ///< √ratio
  double vignetting_, aberration_;
  std::vector<Blade> blades_;
};

}  // namespace lensgraph::engine
