// Where a scene is looked at from, for everything that is set once per view.
#pragma once

#include <glm/mat4x4.hpp>

namespace lensgraph::engine {

/// The part of a view that is the same for every point of the lens.
struct SceneViewpoint {
  glm::dmat4 viewFromWorld{1.0};
  double metersPerUnit = 1.0;  ///< View space is in metres.
  bool lit = false;            ///< Shaded, or the materials' own radiance.
};

}  // namespace lensgraph::engine
