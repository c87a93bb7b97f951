// The shape of the aperture: which points of the lens let light through, and how much.
// The lens point is v in units of the lens radius E, pixel axes (x right, y down).
//
// A polygon has its corners on the unit circle; with bladeRotation 0 one corner points up. A blade is a circular arc
// through its two corners with radius 1/bladeCurvature. The anamorphic ratio q stretches x by √q and y by 1/√q.
// passes/lens_samples draws points of the shape; this header says what each is worth.
#ifndef LENSGRAPH_SHARED_APERTURE_H
#define LENSGRAPH_SHARED_APERTURE_H

#include "shaders/shared/interop.h"

SHARED_NAMESPACE_BEGIN

struct ApertureShape {
  uint bladeCount;           // 0: round; 3…16 blades
  float bladeRotation;       // rad, counter-clockwise as seen in the picture
  float bladeCurvature;      // 0 straight blades … 1 round
  float anamorphicRatio;     // width of the bokeh / its height; 1 is spherical. The area stays that of ratio 1
  float opticalVignetting;   // 0…1, cat's eye towards the picture's corners
  float sphericalAberration; // -1 bright centre … 0 uniform … 1 bright rim
  uint gaussian;             // 1: unbounded Gaussian lens of σ = E (Kraus 2007), other fields but ratio unused
  float padding;
};

// Which fraction of the way from the centre to the aperture's edge the lens point v lies, squared (0 centre, 1 edge).
// Uniform over the aperture's area, whatever its shape.
SHARED_FUNCTION float apertureRadiusSquared(ApertureShape shape, vec2 v) {
  float stretch = sqrt(shape.anamorphicRatio);
  float x = v.x / stretch;
  float y = v.y * stretch;
  float squared = x * x + y * y;
  if (shape.bladeCount == 0u || squared == 0.0) return squared;

  // Angle from the middle of the blade that v looks at. Corners lie at bladeRotation + π/2 + k·2π/n, seen with y up.
  float halfWedge = 3.1415927f / float(shape.bladeCount);
  float angle = atan(-y, x) - shape.bladeRotation - 1.5707964f - halfWedge;
  angle = angle - 2.0f * halfWedge * floor(angle / (2.0f * halfWedge) + 0.5f);

  // Distance of the arc in that direction: with κ = curvature, corner (a, s) = (cos, sin) of half the wedge, and the
  // arc's centre at X/κ on the blade's axis, X = κa - √(1 - κ²s²). No division by κ: κ = 0 gives a/cos(angle).
  float kappa = shape.bladeCurvature;
  float a = cos(halfWedge);
  float s = sin(halfWedge);
  float q = sqrt(1.0f - kappa * kappa * s * s);
  float centre = kappa * a - q;
  float sine = sin(angle);
  float edge = (kappa * (s * s - a * a) + 2.0f * a * q) /
               (sqrt(1.0f - centre * centre * sine * sine) - centre * cos(angle));
  return squared / (edge * edge);
}

// Spherical aberration: 1 + a(2ρ² - 1). Its mean over any shape is 1, since ρ² is uniform; the rings follow the blades.
SHARED_FUNCTION float apertureRingWeight(ApertureShape shape, vec2 v) {
  if (shape.gaussian != 0u || shape.sphericalAberration == 0.0) return 1.0f;
  float weight = 1.0f + shape.sphericalAberration * (2.0f * apertureRadiusSquared(shape, v) - 1.0f);
  return weight < 0.0 ? 0.0f : weight;  // Rounding at the edge.
}

// Cat's eye, 0 or 1: the front of the lens barrel is a second disc, seen from a place of the picture shifted by
// opticalVignetting·place; it cuts the side away from the picture's centre.
//   place: offset from the picture's centre in half diagonals, pixel axes; length 1 in the corners.
// It depends on the pixel, so no list of samples can hold it: whoever sums samples divides by the sum of weights, pixel
// by pixel. All weights of a pixel may be 0 when samples are few: then the plain mean is the better answer.
SHARED_FUNCTION float apertureVignette(ApertureShape shape, vec2 v, vec2 place) {
  if (shape.gaussian != 0u || shape.opticalVignetting == 0.0) return 1.0f;
  float stretch = sqrt(shape.anamorphicRatio);
  float x = v.x / stretch + shape.opticalVignetting * place.x;
  float y = v.y * stretch + shape.opticalVignetting * place.y;
  return x * x + y * y > 1.000001f ? 0.0f : 1.0f;  // Points of the rim stay in at the picture's centre.
}

// What light through lens point v counts for at a place of the picture: both of the above. Gaussian lenses have neither.
SHARED_FUNCTION float apertureWeight(ApertureShape shape, vec2 v, vec2 place) {
  return apertureRingWeight(shape, v) * apertureVignette(shape, v, place);
}

// Largest |v| of the shape: what a blur radius |c| must be multiplied by to bound how far light spreads.
// Gaussian lenses are unbounded; 4σ hold all but 3e-4 of the light.
SHARED_FUNCTION float apertureReach(ApertureShape shape) {
  float stretch = sqrt(shape.anamorphicRatio);
  if (stretch < 1.0) stretch = 1.0f / stretch;
  return shape.gaussian != 0u ? 4.0f * stretch : stretch;
}

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_APERTURE_H
