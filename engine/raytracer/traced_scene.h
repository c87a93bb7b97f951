// Rays through a scene: the only user of Embree. Finds the nearest surface that hides what is behind it, and the
// alpha-blended ones in front of it.
#pragma once

#include <memory>
#include <vector>

#include "engine/raytracer/surfaces.h"

namespace lensgraph::engine {

/// Immutable; rays may be traced from several threads at once. The hierarchy is built by one thread, so that it is the
/// same wherever it is built and surfaces at exactly equal depths always win in the same order.
class TracedScene {
 public:
  /// The surfaces outlive it. Throws Error (failed) when there is no memory for the hierarchy.
  explicit TracedScene(const Surfaces& surfaces);
  ~TracedScene();
  TracedScene(const TracedScene&) = delete;
  TracedScene& operator=(const TracedScene&) = delete;

  /// The nearest opaque or alpha-masked surface beyond view depth `nearDepth` (m); nothing is a hit that is nothing.
  /// What is seen of alpha-blended surfaces in front of it is written to `blended`, farthest first; null: not asked for.
  SurfaceHit trace(const ViewRay& ray, float nearDepth, std::vector<SurfaceHit>* blended) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace lensgraph::engine
