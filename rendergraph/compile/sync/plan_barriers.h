// All synchronization of a plan. Pure: uses of cells over time and places in memory in, barriers out.
#pragma once

#include <span>

#include "rendergraph/compile/schedule/queues.h"
#include "rendergraph/compile_options.h"
#include "rendergraph/device_facts.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

struct Schedule;
struct Submissions;
class Cells;
class CellUses;

/// What the barriers follow from.
struct BarrierInputs {
  const Declaration& declaration;
  const CompileOptions& options;
  const Cells& cells;
  const CellUses& cellUses;
  const Schedule& schedule;
  const Submissions& submissions;
  std::span<const Sharing> sharing;  ///< Empty on one queue.
  std::span<const QueueFacts> queues;
};

/// Fills the barriers, batches and events of the plan.
/// Precondition: passes, submissions, heaps and placements of the plan are complete.
void planBarriers(const BarrierInputs& inputs, Plan& plan);

}  // namespace lensgraph::rendergraph
