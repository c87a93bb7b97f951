// All synchronization of a plan. Pure: uses of cells over time and places in memory in, barriers out.
#pragma once

#include <cstdint>

#include "rendergraph/plan.h"

namespace rendergraph {

struct Declaration;
class Cells;
class Timeline;

/// Fills PlannedPass::before of every pass, Plan::after and Plan::barrierBatches.
/// Precondition: passes, heaps and placements of the plan are complete.
void planBarriers(const Declaration& declaration, const Cells& cells, const Timeline& timeline, Plan& plan);

}  // namespace rendergraph
