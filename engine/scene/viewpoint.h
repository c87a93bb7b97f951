// Where a scene is looked at from, for everything that is set once per view.
#pragma once

#include <glm/mat4x4.hpp>

namespace lensgraph::engine {

/// Which faces of triangles are drawn.
enum class DrawnFaces {
  material,  ///< Front faces, and the back faces of double-sided materials.
  both,      ///< Front and back faces of every material.
};

/// The part of a view that is the same for every point of the lens.
struct SceneViewpoint {
  glm::dmat4 viewFromWorld{1.0};
  double metersPerUnit = 1.0;  ///< View space is in metres.
  bool lit = false;            ///< Shaded, or the materials' own radiance.
  DrawnFaces faces = DrawnFaces::material;
};

}  // namespace lensgraph::engine
