// What the two-pass filter's shaders and their host code agree on: tile size, push constants, buffers.
// Source: Zhou, Chen, Pullen 2007, §4.2; see passes/two_pass_filter/README.md.
#ifndef LENSGRAPH_SHARED_TWO_PASS_FILTER_H
#define LENSGRAPH_SHARED_TWO_PASS_FILTER_H

#include "shaders/shared/interop.h"
#include "shaders/shared/lens.h"

SHARED_NAMESPACE_BEGIN

// px; side of a work group and of the tiles whose largest blur is kept. Smaller tiles fit the blur better but make more
// of them; larger ones exceed the 256 invocations that every device grants nearly everywhere.
SHARED_CONST uint kTwoPassFilterTile = 16;

// Largest |r|, |g|, |b| that is filtered; larger ones are limited to it. A tap that weighs anything has r > 1 and so a
// weight below 1: sums of 2·1024 taps stay 1e5 times below float's maximum.
SHARED_CONST float kTwoPassFilterMaxRadiance = 1e30f;

struct TwoPassFilterConstants {
  ivec2 size;          // px; these two first, where GLSL's 8-byte alignment of vectors and C++'s agree
  ivec2 tiles;         // number of tiles
  LensConstants lens;
  float maxRadius;     // px: blur radii are limited to it, and to the lens's maxCocRadius
  float minRadius;     // px, r_min of I = 1/max(r, r_min)²
  float leakage;       // 1/px, k of L = min(1, k·r_c)
};

// px: the largest blur radius that is filtered.
SHARED_FUNCTION float radiusLimit(TwoPassFilterConstants constants) {
#ifdef __cplusplus
  return std::fmin(constants.maxRadius, constants.lens.maxCocRadius);
#else
  return min(constants.maxRadius, constants.lens.maxCocRadius);
#endif
}

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_TWO_PASS_FILTER_H
