// What the files of the street share: measures, materials, and one function for each part of the picture.
#pragma once

#include <glm/vec3.hpp>

#include "generate/glb.h"
#include "parts/surface_maps.h"

namespace scenes {

constexpr float kHalfWidth = 4.5f;      // m, to the houses
constexpr float kRoadHalfWidth = 3.0f;  // m, to the curb
constexpr float kStreetLength = 46.0f;  // m
const glm::vec3 kTowardsSun(0.8f, 0.7f, 0.9f);

/// Materials by the index that Glb gave them.
struct StreetMaterials {
  int granite, iron, brass, boards, leaf, bark, bulb, lamp;
};

void addStreetHouses(Glb& glb, const StreetMaterials& materials);
/// Cobbles, pavement, and the shadows on them.
void addStreetGround(Glb& glb, const StreetMaterials& materials);
/// Posts, strings of bulbs, and the lights of the nearest.
void addStreetLamps(Glb& glb, const StreetMaterials& materials);
/// Awnings and signs.
void addShops(Glb& glb, const StreetMaterials& materials);
void addStreetTrees(Glb& glb, const StreetMaterials& materials);
/// What is in focus: the board, a crate with a lantern, a pot with a bush.
void addStreetSubject(Glb& glb, const StreetMaterials& materials);
/// What is close to the lens: a railing at the right, a branch in autumn at the upper left.
void addStreetNear(Glb& glb, const StreetMaterials& materials);

}  // namespace scenes
