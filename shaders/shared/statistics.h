// Counters that a technique's shaders raise with atomics and the host reads after the frame.
#ifndef LENSGRAPH_SHARED_STATISTICS_H
#define LENSGRAPH_SHARED_STATISTICS_H

#include "shaders/shared/interop.h"

SHARED_NAMESPACE_BEGIN

struct FrameStatistics {
  uint replacedTexels;        // NaN or Inf texels of the input that were replaced, by black or the depth of the sky
  uint transparentNodes;      // most alpha-blended fragments that the lists of one view were asked to hold
  uint transparentDropped;    // most that found no room in one view (the picture is then incomplete)
  uint transparentUnsorted;   // pixels, over all views, with lists too long to composite whole: the nearest fragments are missing
  uint clampedCoc;            // pixels (of lists, where there are any) whose blur radius was limited by maxCocRadius
  uint fragmentNodes;         // fragments of all surfaces that per-pixel lists were asked to hold, see SceneDraw
  uint fragmentNodesDropped;  // those that found no room
  uint listFragments;         // fragments that compacted and filtered lists were asked to hold; where some were dropped, at least
  uint listFragmentsDropped;  // those that found no room
  uint unsortedLists;         // pixels whose lists were too long to be sorted whole: fragments may be missing
};

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_STATISTICS_H
