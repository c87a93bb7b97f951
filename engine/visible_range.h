// How near and how far a camera sees into a scene: what the techniques need to size layers, levels and filters.
#pragma once

#include "engine/camera.h"
#include "engine/scene.h"

namespace engine {

struct VisibleRange {
  double nearestDepth = 0.0;   ///< m; view depth of the nearest point of any surface inside the frustum.
  double farthestDepth = 0.0;  ///< m; of the farthest.
  bool isEmpty = true;         ///< Nothing is inside.
};

/// Exact: every triangle is clipped to the frustum (hidden ones count; lens rays may reach them). The frustum is widened
/// on each side by `marginPx`, for views from the lens's edge. `metersPerUnit` scales the scene.
VisibleRange visibleRange(const Scene& scene, const Camera& camera, uint32_t width, uint32_t height, double marginPx,
                          double metersPerUnit);

}  // namespace engine
