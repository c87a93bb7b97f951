// Openwork layers for the scene with many surfaces behind each other: patterns of repeated cells in a plane z = 0 that
// faces +Z, with a round hole. Every part is closed or faces +Z, so that front faces can be counted.
#pragma once

#include <glm/vec2.hpp>

#include "generate/mesh.h"
#include "generate/random.h"

namespace scenes {

/// Where cells are: everything in ±halfSize except the disc.
struct LatticeArea {
  glm::vec2 halfSize;       ///< m
  glm::vec2 holeCenter;     ///< m
  float holeRadius = 0.0f;  ///< m; 0: none.
  float pitch = 0.1f;       ///< m, between cells.
};

/// Strings of beads that hang side by side; beads are coverage · pitch wide.
Mesh makeBeadCurtain(const LatticeArea& area, float coverage, Random& random);
/// Two layers of slats, turned by +45° and -45°, each slat coverage · pitch wide.
Mesh makeDiagonalLattice(const LatticeArea& area, float coverage);
/// Rings that touch their neighbors.
Mesh makeRingScreen(const LatticeArea& area, float coverage);
/// Turned bars upright and across, with a ball at each crossing.
Mesh makeTurnedGrille(const LatticeArea& area, float coverage);
/// Slats of a blind, tilted; coverage: of their height as it is seen.
Mesh makeBlind(const LatticeArea& area, float coverage);
/// The hole's edge: a ring.
Mesh makeHoleFrame(const LatticeArea& area, float thickness);

}  // namespace scenes
