// Pictures from anywhere, made fit for a technique: what depth values mean, and samples that no technique can use.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/image/image.h"

namespace lensgraph::host {

/// What the numbers of a depth picture mean.
enum class DepthKind {
  z,           ///< Distance along the optical axis.
  ray,         ///< Distance from the eye along the pixel's ray, as ray tracers and laser scanners give it.
  disparity,   ///< The inverse of z, from 1/farthest to 1/nearest: depth estimators.
  normalized,  ///< z, from nearest to farthest: paint programs.
};

struct DepthMeaning {
  DepthKind kind = DepthKind::z;
  double scale = 1.0;                    ///< m per unit, above 0; z and ray only.
  double nearest = 0.0, farthest = 0.0;  ///< m, 0 < nearest < farthest; disparity and normalized only. farthest may be
                                         ///< infinite for disparity.
  bool isWhiteNear = true;               ///< disparity and normalized: the largest number is nearest, else farthest.
  double white = 1.0;                    ///< The largest number: 255 or 65535 for pictures of integers.
};

/// What convertDepth() found.
struct DepthFindings {
  uint64_t holes = 0;  ///< Pixels without a positive depth: 0, negative, NaN. They are taken as infinitely far.
  std::optional<float> nearest, farthest;  ///< m, of the depths below kNothingHit; none when there are none.
};

/// Numbers of a one-channel picture become z in metres; what is no positive depth becomes infinity, and so do distances of
/// kNothingHit units and more, which stand for the background in files. `fovyDeg`: vertical
/// field of view in degrees, 0 < fovyDeg < 180, of use for rays only.
DepthFindings convertDepth(engine::FloatImage& depth, const DepthMeaning& meaning, double fovyDeg);

inline constexpr float kLargestColor = 1e30f;  ///< Brighter samples are limited to it, so that sums stay finite.

/// What cleanColor() found, in pixels.
struct ColorFindings {
  uint64_t notFinite = 0;  ///< With a sample that is NaN or infinite; now black and opaque.
  uint64_t limited = 0;    ///< With a sample beyond ±kLargestColor; now that.
};

/// RGBA of a picture of one, three or four channels, all samples finite; alpha 1 where there was none.
ColorFindings cleanColor(engine::FloatImage& color);

/// Whether alpha of an RGBA picture is anywhere not 1.
bool hasAlpha(const engine::FloatImage& rgba);

}  // namespace lensgraph::host
