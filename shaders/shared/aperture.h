// The shape of the aperture: which points of the lens let light through, and how much.
// The lens point is v in units of the lens radius E, pixel axes (x right, y down).
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

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_APERTURE_H
