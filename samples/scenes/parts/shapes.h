// Shapes that several parts of the large scenes are made of, beside the primitives of generate/mesh.h.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "generate/mesh.h"
#include "generate/random.h"

namespace scenes {

/// Box between two corners.
Mesh boxBetween(glm::vec3 low, glm::vec3 high);

/// Profile (z, y), read from top to bottom with the outside on the +Z side, drawn out along X from -halfLength to
/// halfLength. One flat normal for each segment; the ends are open.
Mesh extruded(std::span<const glm::vec2> profile, float halfLength);

/// Rotation about +Y, counter-clockwise seen from above.
glm::quat turned(float yaw);

/// UV by position, metersPerTile for one repeat, projected along the axis that each vertex normal is nearest to.
void mapPlanar(Mesh& mesh, float metersPerTile);

/// Multiplies the UV.
void scaleUv(Mesh& mesh, glm::vec2 factor);

/// Normals as the mean of the faces around, weighted by area; faces meet only where they share an index.
void smoothNormals(Mesh& mesh);

/// A cobble or pebble without its underside: domed top of the given half size, its rim `sunk` below y = 0.
Mesh makeStone(Random& random, glm::vec3 halfSize, float sunk, int divisions);

/// A leaf folded along its rib, four triangles: from the stalk along +Y, its upper side facing +Z. fold: how far the
/// edges rise and droop: how far the tip hangs back, as shares of the length.
Mesh makeFoldedLeaf(float length, float width, float fold, float droop);

/// Multiplies the colors by a factor, alpha excepted.
void shade(Mesh& mesh, float factor);

}  // namespace scenes
