// A physical lens in the field's names and units, and its shader constants (shaders/shared/lens.h).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "shaders/shared/aperture.h"
#include "shaders/shared/lens.h"

namespace lensgraph::passes {

/// How the field of view follows the focus.
enum class FovModel {
  pinhole,    ///< fovy is the camera's and does not change with focus (games, glTF).
  breathing,  ///< The sensor is fixed and the image distance is u_f = F / (1 - F V_f) (Lee 2009 eq. 1).
};

/// Thin lens. Every length in metres unless its name says millimetres, whatever the scene's unit: who draws the scene
/// scales it by metersPerUnit, so that view space and near plane are in metres.
struct Lens {
  double focalLengthMm = 50.0;   ///< mm, > 0.
  double fStop = 2.8;            ///< f-number, ≥ 0; 0 turns depth of field off.
  double apertureRadius = -1.0;  ///< m; ≥ 0 replaces focalLengthMm / (2 fStop). Negative: not given.
  double sensorWidthMm = 36.0;   ///< mm, > 0; breathing only.
  double sensorHeightMm = 24.0;  ///< mm, > 0; breathing only.
  double focusDistance = 10.0;   ///< m along the axis, > 0; infinity is legal.
  double metersPerUnit = 1.0;    ///< Metres per scene unit, > 0.
  FovModel fovModel = FovModel::pinhole;
  int bladeCount = 0;                ///< 0 (round), 3…16.
  double bladeRotation = 0.0;        ///< rad.
  double bladeCurvature = 0.0;       ///< 0…1.
  double anamorphicRatio = 1.0;      ///< 0.25…4; width over height of the bokeh.
  double opticalVignetting = 0.0;    ///< 0…1.
  double sphericalAberration = 0.0;  ///< -1…1.
  double maxCocRadius = 0.0;         ///< Fraction of the image height; 0: no limit.
};

/// What is wrong with a lens: field name, reason, remedy. Empty when nothing is.
struct LensProblem {
  std::string field, reason, remedy;
};
std::vector<LensProblem> validate(const Lens& lens);

/// The fields that shape or limit the blur beyond its size (blades, anamorphicRatio, opticalVignetting,
/// sphericalAberration, maxCocRadius) and differ from their defaults, by name.
std::vector<std::string_view> shapingFields(const Lens& lens);

/// S in px: half the image height over tan(fovy/2), or u_f·height/sensorHeight when the lens breathes.
/// Preconditions: validate() found nothing; 0 < fovyRadians < π.
double pixelsPerTangent(const Lens& lens, double fovyRadians, int imageHeight);

/// Constants for depth buffers of the infinite reversed projection with this near plane (z = near · V).
/// cocScale is 0 when depth of field is off; focusVergence is exactly 0 when focused at infinity.
/// Preconditions: as above; nearPlane > 0, in metres.
shared::LensConstants lensConstants(const Lens& lens, double fovyRadians, int imageHeight, double nearPlane);

shared::ApertureShape apertureShape(const Lens& lens);

/// A length of the scene, such as a near plane, in metres.
double metersFromSceneUnits(const Lens& lens, double units);

/// E in metres; 0 when depth of field is off.
double apertureRadius(const Lens& lens);

}  // namespace lensgraph::passes
