// Closed control meshes of quads with shared vertices, for subdivision: the surface of a set of lattice
// cells.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <set>
#include <vector>

#include "generate/glb.h"
#include "generate/mesh.h"

namespace scenes {

using Cell = std::array<int, 3>;
using Cells = std::set<Cell>;

/// Adds all cells from low to high, both included, and their mirror images in x (cell i ↔ −1 − i).
void addMirrored(Cells& cells, Cell low, Cell high);

struct QuadCage {
  std::vector<glm::vec3> positions;
  std::vector<std::array<uint32_t, 4>> quads;  ///< Counter-clockwise from outside.

  /// The boundary of the cells, one unit per cell. Throws std::logic_error where an edge would have more than
  /// two faces: cells may not touch along an edge alone.
  static QuadCage around(const Cells& cells);

  /// Moves every vertex by `share` of the way to the mean of its neighbours, `rounds` times.
  void relax(float share, int rounds);
  /// Moves every vertex outward.
  void inflate(float distance);
  std::vector<glm::vec3> vertexNormals() const;

  /// Triangles (a, b, c), (a, c, d) of each quad in turn: the quads can be put together again.
  Mesh triangulated() const;
  /// What the mesh's extras say about that order.
  static Json extras();
};

}  // namespace scenes
