// One call of every function of lens.h and aperture.h: inputs and results, for GLSL and C++. Scalars only, so
// that both agree on the layout.
#ifndef LENSGRAPH_TEST_LENS_CASES_H
#define LENSGRAPH_TEST_LENS_CASES_H

#include "shaders/shared/aperture.h"
#include "shaders/shared/interop.h"
#include "shaders/shared/lens.h"

SHARED_NAMESPACE_BEGIN

SHARED_CONST uint kLensCaseGroup = 64u;

struct LensCase {
  LensConstants lens;
  float depthBuffer;
  float vergence;
  ApertureShape shape;
  float lensX, lensY;    // v
  float placeX, placeY;  // half diagonals
};

struct LensCaseResult {
  float vergenceFromDepthBuffer;
  float signedCocRadius;
  float radiusSquared;
  float ringWeight;
  float vignette;
  float weight;
  float reach;
};

SHARED_FUNCTION LensCaseResult evaluateLensCase(LensCase c) {
  LensCaseResult result;
  result.vergenceFromDepthBuffer = vergenceFromDepthBuffer(c.lens, c.depthBuffer);
  result.signedCocRadius = signedCocRadius(c.lens, c.vergence);
  vec2 v;
  v.x = c.lensX;
  v.y = c.lensY;
  vec2 place;
  place.x = c.placeX;
  place.y = c.placeY;
  result.radiusSquared = apertureRadiusSquared(c.shape, v);
  result.ringWeight = apertureRingWeight(c.shape, v);
  result.vignette = apertureVignette(c.shape, v, place);
  result.weight = apertureWeight(c.shape, v, place);
  result.reach = apertureReach(c.shape);
  return result;
}

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_TEST_LENS_CASES_H
