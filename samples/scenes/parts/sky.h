// A sky as radiance by direction: the environment that lights a large scene, and the dome that is seen behind it.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>

#include "generate/glb.h"

namespace scenes {

/// Radiance is linear; 1 is white in a picture at exposure 0.
struct Sky {
  glm::vec3 zenith{0.25f, 0.45f, 0.9f};
  glm::vec3 horizon{0.9f, 0.85f, 0.8f};
  glm::vec3 ground{0.15f, 0.13f, 0.1f};     ///< Below the horizon.
  glm::vec3 towardsSun{0.0f, 0.3f, -1.0f};  ///< Need not be of unit length.
  glm::vec3 glow{0.6f, 0.4f, 0.2f};         ///< Added in a wide lobe about the sun; the sun itself is a light.
};

glm::vec3 radianceOf(const Sky& sky, glm::vec3 direction);

/// Longitude-latitude EXR: top row +Y, the center column −Z, +X to the right of it.
void writeSky(const std::filesystem::path& file, const Sky& sky);

/// An unlit upper hemisphere (and a strip below it) seen from inside. Radiance above 1 is cut, as vertex colors are.
void addSkyDome(Glb& glb, const Sky& sky, float radius);

}  // namespace scenes
