// How many barrier batches an order of passes needs at least, counted without the compiler's own barrier planner.
#pragma once

#include <cstdint>

#include "rendergraph/declare/declaration.h"
#include "rendergraph/plan.h"

namespace lensgraph {

/// Minimum over all placements of the barriers of this plan's order and memory: each may stand anywhere between the
/// last earlier use and the first later one, also after the last pass, and those that stand together are one batch.
/// Counts a barrier between any two uses of a resource that are not both reads of the same kind, before a first use
/// (the layout, and whoever had the memory before), and after the last use of what is exported. For graphs whose
/// images have one mip and layer.
uint32_t fewestBatches(const rendergraph::Declaration& declaration, const rendergraph::Plan& plan);

}  // namespace lensgraph
