// Push constants of the accumulation reference (shaders/accumulation).
#ifndef LENSGRAPH_SHARED_ACCUMULATION_H
#define LENSGRAPH_SHARED_ACCUMULATION_H

#include "shaders/shared/aperture.h"
#include "shaders/shared/interop.h"

SHARED_NAMESPACE_BEGIN

SHARED_CONST uint kAccumulationTile = 8u;  // px; work group side

struct AccumulatePush {
  ApertureShape aperture;
  vec2 lensSample;       // v, units of the lens radius
  float weight;          // of this lens sample, mean 1
  uint viewIndex;        // 0 starts a new picture
  uvec2 extent;          // px
};

struct ResolvePush {
  uvec2 extent;  // px
  uint viewCount;
};

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_ACCUMULATION_H
