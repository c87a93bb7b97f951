// Textures of a surface from one description of its relief: base color, tangent-space normals, roughness and metal.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "generate/canvas.h"
#include "generate/glb.h"

namespace scenes {

/// One tile, described at points of [0, 1]² with y down; all functions must repeat with period 1 where the texture does.
struct Relief {
  int size = 256;                                    ///< px
  std::function<float(glm::vec2)> height;            ///< In [0, 1].
  float depth = 0.01f;                               ///< What a height of 1 is, as a share of the tile's width.
  std::function<glm::vec3(glm::vec2, float)> color;  ///< By point and height; display values.
  std::function<float(glm::vec2, float)> roughness;  ///< By point and height, in [0, 1].
  float metallic = 0.0f;
};

struct SurfaceMaps {
  Canvas color;
  Canvas normal;             ///< x and y of the normal, then z, from [-1, 1] to [0, 1]; +y is up.
  Canvas metallicRoughness;  ///< G and B as glTF wants them; R is 1.
};

SurfaceMaps mapsOf(const Relief& relief);

/// What a mesh needs for such a material, and with vertex colors that tint it.
constexpr Attributes kTextured{.normals = true, .uvs = true};
constexpr Attributes kTinted{.normals = true, .uvs = true, .colors = true};

/// Adds the three textures, repeating, and a lit material that uses them.
int addSurface(Glb& glb, const std::string& name, const Relief& relief, bool doubleSided = false);

}  // namespace scenes
