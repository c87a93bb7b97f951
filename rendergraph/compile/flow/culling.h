// Which passes nothing observable needs, and why each of them can go.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

struct Declaration;
class Cells;

struct Culling {
  std::vector<uint8_t> alive;      ///< By pass.
  std::vector<CulledPass> culled;  ///< In order of declaration, each with its reason.
};

/// `sequence`: all passes in an order in which they can run.
Culling cull(const Declaration& declaration, const Cells& cells, std::span<const uint32_t> sequence);

}  // namespace lensgraph::rendergraph
