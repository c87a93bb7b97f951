// Joins barriers of neighbouring cells that say the same into one with a larger range. Pure.
#pragma once

#include <cstdint>
#include <vector>

#include "rendergraph/plan.h"

namespace rendergraph {

struct PlacedBarrier {
  uint32_t step = 0;  ///< Position in execution order of the pass that it stands before.
  ImageBarrier barrier;
};

/// All barriers concern one resource. Afterwards they are sorted by step.
void mergeRanges(std::vector<PlacedBarrier>& barriers);

}  // namespace rendergraph
