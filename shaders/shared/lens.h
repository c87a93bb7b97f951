// The one place of the lens formulas, for GLSL and C++.
//
// Thin lens in vergence V = 1/depth (Lee 2009 eq. 3, Kraus 2007 eq. 5/16, Zhou 2007 eq. 2 in one form):
//   c(V) = K (V_f - V)     signed blur radius in px, negative in front of the focal plane
// K = S·E: S = px per tangent, E = lens radius in metres. Focus at infinity is V_f = 0, the sky is V = 0; both exact.
#ifndef LENSGRAPH_SHARED_LENS_H
#define LENSGRAPH_SHARED_LENS_H

#include "shaders/shared/interop.h"

SHARED_NAMESPACE_BEGIN

struct LensConstants {
  float cocScale;       // K, px·m: blur radius per dioptre of defocus; 0 is a pinhole
  float focusVergence;  // V_f, 1/m; 0 is focus at infinity
  float maxCocRadius;   // px; blur radii are limited to it. Large (1e30) when there is no limit
  float vergenceScale;  // a of V = a·z + b, from the depth buffer's z. Infinite reversed depth: 1/near
  float vergenceOffset; // b, 1/m
};

// Vergence (1/m) of a raw depth-buffer value.
SHARED_FUNCTION float vergenceFromDepthBuffer(LensConstants lens, float z) {
  return lens.vergenceScale * z + lens.vergenceOffset;
}

// Signed blur radius in px of a vergence, negative in front of the focal plane.
SHARED_FUNCTION float signedCocRadius(LensConstants lens, float vergence) {
  float radius = lens.cocScale * (lens.focusVergence - vergence);
#ifdef __cplusplus
  return std::fmin(std::fmax(radius, -lens.maxCocRadius), lens.maxCocRadius);
#else
  return clamp(radius, -lens.maxCocRadius, lens.maxCocRadius);
#endif
}

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_LENS_H
