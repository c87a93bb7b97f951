// A physical lens to the constants of shaders/shared/lens.h. Formulas: Lee 2009 eqs. 1 and 3.
//
// Units. Every length of a Lens is in metres (or millimetres where named so), whatever the scene's unit. View
// space is in metres too: who draws the scene scales it by metersPerUnit. A depth buffer holds near/depth, a
// ratio, so a host that draws in scene units has only its near plane to convert: metersFromSceneUnits().
#include "passes/lens/physical_lens.h"

#include <algorithm>
#include <cmath>

namespace lensgraph::passes {
namespace {

/// No limit of the blur radius, px. Far above any picture, and its square is still finite in double.
constexpr float kNoCocLimit = 1e30f;
/// px·m. Above it K·V could overflow float for the nearest depths (V ≤ 1e5/m) with room for sums; no picture
/// can show the difference, since every blur is wider than it by many orders.
constexpr double kMaxCocScale = 1e25;
/// 1/m. Focus nearer than this would overflow K·V_f; nothing can be drawn there.
constexpr double kMaxFocusVergence = 1e9;
constexpr double kPi = 3.14159265358979323846;

double focalLength(const Lens& lens) {
  return lens.focalLengthMm * 1e-3;
}

/// Exactly 0 at infinity.
double focusVergence(const Lens& lens) {
  return std::min(1.0 / lens.focusDistance, kMaxFocusVergence);
}

/// Collects problems; one call a rule, so that the rules read as a table.
struct Rules {
  std::vector<LensProblem> problems;

  void require(bool holds, const char* field, const char* reason, const char* remedy) {
    if (!holds) problems.push_back({field, reason, remedy});
  }
  void positive(double value, const char* field, const char* remedy) {
    require(std::isfinite(value) && value > 0.0, field, "must be a positive, finite number", remedy);
  }
  void within(double value, double min, double max, const char* field, const char* remedy) {
    require(value >= min && value <= max, field, "is out of range", remedy);  // NaN fails both comparisons.
  }
};

void checkApertureShape(const Lens& lens, Rules& rules) {
  const bool polygon = lens.bladeCount >= 3 && lens.bladeCount <= 16;
  rules.require(lens.bladeCount == 0 || polygon, "bladeCount", "no aperture has this number of blades",
                "use 0 for a round aperture, or 3 to 16");
  rules.require(std::isfinite(lens.bladeRotation), "bladeRotation", "is not a finite number",
                "give an angle in radians");
  rules.within(lens.bladeCurvature, 0.0, 1.0, "bladeCurvature", "use 0 (straight blades) to 1 (round)");
  rules.within(lens.anamorphicRatio, 0.25, 4.0, "anamorphicRatio", "use 0.25 to 4; 1 is a spherical lens");
  rules.within(lens.opticalVignetting, 0.0, 1.0, "opticalVignetting", "use 0 (none) to 1");
  rules.within(lens.sphericalAberration, -1.0, 1.0, "sphericalAberration", "use -1 (bright centre) to 1 (bright rim)");
}

}  // namespace

std::vector<LensProblem> validate(const Lens& lens) {
  Rules rules;
  rules.positive(lens.focalLengthMm, "focalLengthMm", "give the focal length in millimetres, 50 for example");
  rules.require(std::isfinite(lens.fStop) && lens.fStop >= 0.0, "fStop", "must be zero or a positive, finite number",
                "give the f-number, 2.8 for example; 0 turns depth of field off");
  rules.require(std::isfinite(lens.apertureRadius), "apertureRadius", "is not a finite number",
                "give the lens radius in metres, or leave it out and give focalLengthMm and fStop");
  rules.positive(lens.sensorWidthMm, "sensorWidthMm", "give the sensor's width in millimetres, 36 for example");
  rules.positive(lens.sensorHeightMm, "sensorHeightMm", "give the sensor's height in millimetres, 24 for example");
  rules.require(lens.focusDistance > 0.0, "focusDistance", "must be greater than zero",
                "give metres along the optical axis, or infinity");
  rules.positive(lens.metersPerUnit, "metersPerUnit", "give metres per scene unit, 0.01 for centimetres");
  if (lens.fovModel == FovModel::breathing && lens.focusDistance > 0.0 && lens.focalLengthMm > 0.0) {
    rules.require(lens.focusDistance > focalLength(lens), "focusDistance",
                  "is not beyond the focal length: no image is formed behind the lens",
                  "focus farther away, shorten focalLengthMm, or use fovModel pinhole");
  }
  rules.within(lens.maxCocRadius, 0.0, 1e6, "maxCocRadius", "give a fraction of the image height; 0 means no limit");
  checkApertureShape(lens, rules);
  return std::move(rules.problems);
}

std::vector<std::string_view> shapingFields(const Lens& lens) {
  const Lens plain;
  std::vector<std::string_view> fields;
  const auto add = [&](auto Lens::*member, std::string_view name) {
    if (lens.*member != plain.*member) fields.push_back(name);
  };
  add(&Lens::bladeCount, "bladeCount");
  add(&Lens::bladeRotation, "bladeRotation");
  add(&Lens::bladeCurvature, "bladeCurvature");
  add(&Lens::anamorphicRatio, "anamorphicRatio");
  add(&Lens::opticalVignetting, "opticalVignetting");
  add(&Lens::sphericalAberration, "sphericalAberration");
  add(&Lens::maxCocRadius, "maxCocRadius");
  return fields;
}

double apertureRadius(const Lens& lens) {
  if (lens.apertureRadius >= 0.0) return lens.apertureRadius;
  return lens.fStop == 0.0 ? 0.0 : focalLength(lens) / (2.0 * lens.fStop);
}

double metersFromSceneUnits(const Lens& lens, double units) {
  return units * lens.metersPerUnit;
}

double pixelsPerTangent(const Lens& lens, double fovyRadians, int imageHeight) {
  if (lens.fovModel == FovModel::pinhole) return 0.5 * imageHeight / std::tan(0.5 * fovyRadians);
  const double imageDistance = focalLength(lens) / (1.0 - focalLength(lens) * focusVergence(lens));
  return imageDistance * imageHeight / (lens.sensorHeightMm * 1e-3);
}

shared::LensConstants lensConstants(const Lens& lens, double fovyRadians, int imageHeight, double nearPlane) {
  const double cocScale = pixelsPerTangent(lens, fovyRadians, imageHeight) * apertureRadius(lens);
  shared::LensConstants constants{};
  constants.cocScale = static_cast<float>(std::min(cocScale, kMaxCocScale));
  constants.maxCocRadius = lens.maxCocRadius > 0.0 ? static_cast<float>(lens.maxCocRadius * imageHeight) : kNoCocLimit;
  constants.vergenceScale = static_cast<float>(1.0 / nearPlane);
  constants.vergenceOffset = 0.0f;
  // V_f carries the rounding error of 1/near, so that it cancels in V_f - V: three roundings instead of four
  // stand between the depth buffer and a CoC near focus, and the error stays below 2·K·V_f·2^-23 px (1.52 of
  // it).
  const double scaleError = static_cast<double>(constants.vergenceScale) * nearPlane;
  constants.focusVergence = static_cast<float>(focusVergence(lens) * scaleError);
  return constants;
}

shared::ApertureShape apertureShape(const Lens& lens) {
  shared::ApertureShape shape{};
  shape.bladeCount = static_cast<uint32_t>(lens.bladeCount);
  shape.bladeRotation = static_cast<float>(std::remainder(lens.bladeRotation, 2.0 * kPi));
  shape.bladeCurvature = static_cast<float>(lens.bladeCurvature);
  shape.anamorphicRatio = static_cast<float>(lens.anamorphicRatio);
  shape.opticalVignetting = static_cast<float>(lens.opticalVignetting);
  shape.sphericalAberration = static_cast<float>(lens.sphericalAberration);
  return shape;
}

}  // namespace lensgraph::passes
