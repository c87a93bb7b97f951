// How near and how far a camera sees into a scene: what the techniques need to size layers, levels and filters.
#pragma once

#include <vector>

#include "engine/scene/camera.h"
#include "engine/scene/scene.h"

namespace lensgraph::engine {

/// View depths from `nearest` to `farthest`, m.
struct DepthSpan {
  double nearest = 0.0, farthest = 0.0;
};

struct VisibleRange {
  double nearestDepth = 0.0;   ///< m; view depth of the nearest point of any surface inside.
  double farthestDepth = 0.0;  ///< m; of the farthest.
  bool isEmpty = true;         ///< Nothing is inside.
  /// Where in that range there is anything, whole triangles at a time: disjoint, nearest first, at most 64; of more, the
  /// smallest gaps (in 1/depth) are closed.
  std::vector<DepthSpan> spans;
};

/// The opening that the scene is seen through; the default is a pinhole.
struct LensOpening {
  double radius = 0.0;         ///< m; farthest that a lens point is from the centre.
  double focusVergence = 0.0;  ///< 1/m; the focal plane stays where it is in the picture from every lens point.
};

/// Exact: every triangle is clipped to what any point of the opening sees (hidden surfaces count, and back faces that
/// are not drawn; lens rays may reach the former). `metersPerUnit` scales the scene.
VisibleRange visibleRange(const Scene& scene, const Camera& camera, uint32_t width, uint32_t height,
                          const LensOpening& opening, double metersPerUnit);

}  // namespace lensgraph::engine
