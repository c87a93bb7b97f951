// How many surfaces lie behind each other in a shot.
#pragma once

#include <vector>

#include "generate/glb.h"
#include "generate/shot.h"

namespace scenes {

/// Front faces that cover the centers of a coarse picture's pixels, counted through everything, without depth test. Back
/// faces do not count, those of double-sided materials neither; nor does a triangle whose edge a ray meets exactly.
struct DepthComplexity {
  int width = 0;
  int height = 0;
  std::vector<int> surfaces;  ///< By pixel, top row first.

  double mean() const;
  /// Share of the pixels with at least that many.
  double shareOfAtLeast(int count) const;
};

/// The view of the shot's camera, which must not be the scene's own. height is width · 9 / 16.
DepthComplexity depthComplexityOf(const Glb& scene, const Camera& camera, int width = 160);

}  // namespace scenes
