// What the files of the forest share: the lie of the land, materials by distance, and the functions that plant it.
#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "generate/glb.h"
#include "parts/surface_maps.h"

namespace scenes {

constexpr Attributes kColored{.normals = true, .colors = true};
const glm::vec2 kStump(-0.12f, -3.5f);  ///< m, x and z of what is in focus.

/// Height of the ground in meters: hollows and knolls, flat where the camera and the stump stand.
float groundAt(float x, float z);
/// 1 where sun falls through the crowns, 0 in shade.
float sunAt(float x, float z);

constexpr int kBands = 3;

/// Materials of one distance.
struct Band {
  int leaf, bark, fern;
};

struct ForestMaterials {
  std::array<Band, kBands> bands;
  int floor, litter;
};

void addForestTrees(Glb& glb, const ForestMaterials& materials);
/// Ferns, grass and leaves on the ground; darker ones in the shade.
void addUndergrowth(Glb& glb, const ForestMaterials& materials);

}  // namespace scenes
