// Which passes anything observable needs. Pure.
#pragma once

#include <cstdint>
#include <vector>

#include "rendergraph/plan.h"

namespace rendergraph {

struct Declaration;
class Cells;
struct DataFlow;

struct Culling {
  std::vector<uint8_t> alive;      ///< By pass.
  std::vector<CulledPass> culled;  ///< In order of declaration, each with its reason.
};

/// A pass lives when it has a side effect, writes something imported or persistent, leaves content in an exported
/// resource, or produces content that a living pass reads.
Culling cull(const Declaration& declaration, const Cells& cells, const DataFlow& flow);

}  // namespace rendergraph
