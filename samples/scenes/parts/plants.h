// Trees, twigs, ferns, grass and mushrooms, standing on y = 0 about the origin. Wood and leaves come apart, as they have
// different materials; the darkness inside a crown is in the vertex colors, since nothing casts shadows.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "generate/canvas.h"
#include "generate/mesh.h"
#include "generate/random.h"

namespace scenes {

struct Plant {
  Mesh wood;
  Mesh leaves;
};

struct TreeShape {
  float height = 8.0f;       ///< m
  float trunkRadius = 0.2f;  ///< m at the foot
  float bareShare = 0.35f;   ///< Of the height below the lowest branch.
  int branches = 14;
  int twigs = 9;           ///< For each branch.
  int leaves = 16;         ///< For each twig.
  float leafSize = 0.12f;  ///< m
  float spread = 0.45f;    ///< Length of the lowest branches as a share of the height.
  glm::vec3 leafTint{0.55f, 0.75f, 0.30f};
};
Plant makeTree(const TreeShape& shape, Random& random);

/// A branch of `length` from the origin along +X, bending down, with twigs and leaves to its end.
Plant makeBranch(float length, float leafSize, int twigs, int leaves, glm::vec3 tint, Random& random);

/// A rosette of fronds of the given length; leaflets are geometry, four triangles each.
Mesh makeFern(float length, int fronds, int leafletPairs, Random& random);

/// Blades that bend, five triangles each.
Mesh makeGrass(float height, int blades, Random& random);

/// Stem and cap; colors in the vertices.
Mesh makeMushroom(float height, Random& random);

/// Leaf with its outline in alpha, on both sides of a rib; colors are pale, to be tinted.
Canvas paintLeafTexture();

}  // namespace scenes
