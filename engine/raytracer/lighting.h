// The light that a metallic-roughness surface sends to the eye: the shading that the project means by "lit", in C++.
//
// The formulas are those that shaders/scene/reflection.glsl states (glTF 2.0 appendix B: GGX, Lambert, punctual lights;
// the split sum for the environment), written a second time; no code is shared. The environment is the same prepared
// data (engine/draw/environment.h): half floats of the mips and nine spherical harmonics. No shadows, no transmission.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/draw/environment.h"
#include "engine/scene/scene.h"
#include "engine/scene/viewpoint.h"

namespace lensgraph::engine {

/// A point of a surface as the formulas want it. View space, m; vectors of unit length.
struct LitPoint {
  glm::vec3 position{0.0f}, normal{0.0f}, toEye{0.0f};
  glm::vec3 diffuseColor{0.0f}, specularColor{0.0f};
  float roughness = 1.0f;  ///< Perceptual, 0.045…1.
  float occlusion = 1.0f;  ///< Of the environment; 1: none.
};

/// The lights of a scene seen from a viewpoint, and its environment.
class Lighting {
 public:
  /// Nothing is kept of the arguments. `environment` may be null.
  Lighting(const Scene& scene, const SceneViewpoint& viewpoint, const Environment* environment);

  /// Linear radiance towards the eye.
  glm::vec3 reflected(const LitPoint& point) const;
  bool hasEnvironment() const { return !levels_.empty(); }

 private:
  struct ViewLight {
    LightType type;
    glm::vec3 color;                ///< times intensity
    glm::vec3 position, direction;  ///< View space, m; the direction in which it shines.
    float range;                    ///< m; 0: infinite
    float cosInner, cosOuter;
  };
  struct Level {
    uint32_t width = 0, height = 0;
    std::vector<glm::vec3> texels;
  };

  glm::vec3 fromLight(const LitPoint& point, const ViewLight& light) const;
  glm::vec3 fromEnvironment(const LitPoint& point) const;
  glm::vec3 radiance(const glm::vec3& worldDirection, float level) const;

  std::vector<ViewLight> lights_;
  glm::mat3 worldFromView_{1.0f};
  std::vector<Level> levels_;  ///< Of the environment, largest first.
  std::array<glm::vec3, 9> irradiance_{};
};

}  // namespace lensgraph::engine
