// The lens and the view of a ray-traced picture, in plain numbers.
//
// This is all that the ray tracer is told of a lens: it derives rays from these numbers by itself and uses none of the
// formulas of shaders/shared/lens.h, shaders/shared/aperture.h or passes/lens, so that a wrong constant there, or here,
// shows as a difference between two pictures.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "engine/scene/camera.h"
#include "engine/scene/viewpoint.h"

namespace lensgraph::engine {

/// A sensor behind a lens of fixed focal length: the field of view follows the focus.
struct BreathingSensor {
  double focalLength = 0.05;    ///< m, > 0 and below the focus distance.
  double sensorHeight = 0.024;  ///< m, > 0; the picture's height on the sensor.
};

/// A thin lens in the plane z = 0 of view space. The aperture's fields mean what those of passes::Lens mean.
struct RayLens {
  double apertureRadius = 0.0;                                     ///< m, ≥ 0; 0 is a pinhole.
  double focusDistance = std::numeric_limits<double>::infinity();  ///< m along the axis, > 0; infinity is legal.
  int bladeCount = 0;                                              ///< 0 (round), 3…16.
  double bladeRotation = 0.0;        ///< rad, counter-clockwise in the picture; at 0 one corner points up.
  double bladeCurvature = 0.0;       ///< 0 (straight blades) … 1 (round); a blade's radius is its inverse.
  double anamorphicRatio = 1.0;      ///< > 0; width over height of the aperture, whose area does not change.
  double opticalVignetting = 0.0;    ///< 0…1, cat's eye.
  double sphericalAberration = 0.0;  ///< -1 (bright center) … 1 (bright rim).
  /// Replaces the camera's field of view where it is set.
  std::optional<BreathingSensor> breathing;
};

/// What is looked at, through what, and onto how many pixels.
struct RayTracedView {
  Camera camera;             ///< Near plane in metres.
  SceneViewpoint viewpoint;  ///< Its viewFromWorld is the camera's.
  RayLens lens;
  uint32_t width = 0, height = 0;                        ///< px, at least 1; pixels are square.
  std::array<float, 3> background = {0.0f, 0.0f, 0.0f};  ///< Linear radiance where nothing is hit.
};

}  // namespace lensgraph::engine
