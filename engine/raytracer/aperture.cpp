// Half planes and discs of the blades, and distances to them.
#include "engine/raytracer/aperture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace lensgraph::engine {
namespace {

/// Blades straighter than this are straight: the arc is nearer than 5e-5 aperture radii to its chord.
constexpr double kStraight = 1e-4;

}  // namespace

Aperture::Aperture(const RayLens& lens)
    : stretch_(std::sqrt(lens.anamorphicRatio)),
      vignetting_(lens.opticalVignetting),
      aberration_(lens.sphericalAberration) {
  using std::numbers::pi;
  for (int i = 0; i < lens.bladeCount; ++i) {
    const double halfSide = pi / lens.bladeCount;
    const double angle = lens.bladeRotation + pi / 2.0 + (2 * i + 1) * halfSide;  // between corners i and i + 1
    Blade blade;
    blade.axis = {std::cos(angle), std::sin(angle)};
    blade.offset = std::cos(halfSide);
    if (lens.bladeCurvature > kStraight) {
      // The circle through two corners of the unit circle, its center on the side's axis.
      blade.radius = 1.0 / lens.bladeCurvature;
      const double halfChord = std::sin(halfSide);
      blade.center = blade.axis * (blade.offset - std::sqrt(blade.radius * blade.radius - halfChord * halfChord));
    }
    blades_.push_back(blade);
  }
}

glm::dvec2 Aperture::candidate(const glm::dvec2& ofDisc) const {
  return {ofDisc.x * stretch_, ofDisc.y / stretch_};
}

bool Aperture::isOpen(const glm::dvec2& candidate, const glm::dvec2& place) const {
  const glm::dvec2 p = unstretched(candidate);
  // The front of the barrel: a second disc, which moves towards the picture's center as seen from off the axis.
  if (vignetting_ > 0.0 && glm::length(p + vignetting_ * place) > 1.0) return false;
  return std::ranges::all_of(blades_, [&](const Blade& blade) {
    if (blade.radius > 0.0) return glm::length(p - blade.center) <= blade.radius;
    return glm::dot(p, blade.axis) <= blade.offset;
  });
}

double Aperture::weight(const glm::dvec2& point) const {
  if (aberration_ == 0.0) return 1.0;
  const glm::dvec2 p = unstretched(point);
  const double length = glm::length(p);
  if (length == 0.0) return 1.0 - aberration_;
  const glm::dvec2 direction = p / length;
  double edge = blades_.empty() ? 1.0 : std::numeric_limits<double>::infinity();
  for (const Blade& blade : blades_) {
    if (blade.radius > 0.0) {  // The larger root of |s·direction - center| = radius.
      const double along = glm::dot(direction, blade.center);
      const double across = glm::dot(blade.center, blade.center) - along * along;
      edge = std::min(edge, along + std::sqrt(blade.radius * blade.radius - across));
    } else if (const double cosine = glm::dot(direction, blade.axis); cosine > 0.0) {
      edge = std::min(edge, blade.offset / cosine);
    }
  }
  const double rho = length / edge;
  return std::max(1.0 + aberration_ * (2.0 * rho * rho - 1.0), 0.0);
}

}  // namespace lensgraph::engine
