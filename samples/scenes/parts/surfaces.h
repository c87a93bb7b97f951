// The reliefs of the large scenes' surfaces: masonry, wood, bark, ground, metal. The comment of each says how large a
// tile is meant to be.
#pragma once

#include "parts/surface_maps.h"

namespace scenes {

/// Four bricks across and twelve courses up, running bond; 1 m.
Relief brickRelief(glm::vec3 brick, uint32_t seed);
/// Painted plaster with stains; 2 m.
Relief plasterRelief(glm::vec3 paint, uint32_t seed);
/// Gray stone, fine-grained; 0.5 m.
Relief graniteRelief(uint32_t seed);
/// Rows of cobbles seen from above, for where they are too far for geometry; 1 m.
Relief cobbleRelief(uint32_t seed);
/// Boards along v; 0.6 m.
Relief boardRelief(glm::vec3 wood, uint32_t seed);
/// Furrowed bark along v; 0.6 m.
Relief barkRelief(uint32_t seed);
/// Cast iron under old paint; 0.3 m.
Relief ironRelief(glm::vec3 paint, uint32_t seed);
/// Brass with darker spots; 0.1 m.
Relief brassRelief(uint32_t seed);
/// Soil with moss and needles; 2 m.
Relief forestFloorRelief(uint32_t seed);
/// Woven cloth; 0.05 m.
Relief clothRelief(glm::vec3 dye, uint32_t seed);

}  // namespace scenes
