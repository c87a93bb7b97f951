// Joins barriers of neighbouring cells that say the same into one with a larger range. Pure.
#pragma once

#include <vector>

#include "rendergraph/compile/sync/barrier_batching.h"

namespace lensgraph::rendergraph {

/// All barriers concern one resource. Afterwards they are sorted by step.
void mergeRanges(std::vector<PendingBarrier>& barriers);

}  // namespace lensgraph::rendergraph
