// The table of parameters, and the lens field by field.
#include "samples/host/raytraced/raytraced_technique.h"

#include <span>
#include <vector>

namespace lensgraph::host {
namespace {

using passes::Field;

constexpr std::string_view kIgnoredLensFields[] = {"maxCocRadius"};  // Rays know no limit of a blur.

std::span<const Field<RaytracedParameters>> fields() {
  static const std::vector<Field<RaytracedParameters>> table = {
      passes::number<&RaytracedParameters::samples>("samples", "", 1, 1048576,
                                                    "Rays a pixel; time is proportional to it."),
      passes::choice<&RaytracedParameters::pixelFilter, engine::kPixelFilterNames>(
          "pixelFilter", "Box of 1 px, tent of 2 px, Gaussian with sigma = 0.5 px, or the pixel's center alone."),
      passes::number<&RaytracedParameters::seed>("seed", "", 0, 2147483647, "Another seed is another noise."),
      passes::number<&RaytracedParameters::threads>("threads", "", 0, 1024,
                                                    "Threads; 0 is one for each core. Changes no picture."),
  };
  return table;
}

}  // namespace

const passes::Technique& raytracedTechnique() {
  static const passes::Technique technique = {.name = "raytraced",
                                              .title = "Ray tracing (truth, on the CPU)",
                                              .source = "Cook, Porter & Carpenter 1984, Distributed ray tracing",
                                              .input = passes::TechniqueInput::scene,
                                              .parameters = passes::describe<RaytracedParameters>(fields()),
                                              .ignoredLensFields = kIgnoredLensFields,
                                              .sizeOnlyLensFields = {},
                                              .blurLimit = {},
                                              .quick = {.parameters = {{"samples", int64_t{16}}}, .pixelSamples = 16},
                                              .configure = {}};
  return technique;
}

RaytracedParameters raytracedParameters(const passes::ParameterSet& set) {
  return passes::fromSet<RaytracedParameters>(set, fields());
}

engine::RayLens rayLensOf(const passes::Lens& lens) {
  const double focalLength = lens.focalLengthMm / 1000.0;
  engine::RayLens ray;
  // The f-number is the focal length over the aperture's diameter.
  if (lens.apertureRadius >= 0.0) {
    ray.apertureRadius = lens.apertureRadius;
  } else if (lens.fStop > 0.0) {
    ray.apertureRadius = focalLength / lens.fStop / 2.0;
  }
  ray.focusDistance = lens.focusDistance;
  ray.bladeCount = lens.bladeCount;
  ray.bladeRotation = lens.bladeRotation;
  ray.bladeCurvature = lens.bladeCurvature;
  ray.anamorphicRatio = lens.anamorphicRatio;
  ray.opticalVignetting = lens.opticalVignetting;
  ray.sphericalAberration = lens.sphericalAberration;
  if (lens.fovModel == passes::FovModel::breathing) {
    ray.breathing = {.focalLength = focalLength, .sensorHeight = lens.sensorHeightMm / 1000.0};
  }
  return ray;
}

}  // namespace lensgraph::host
