// Where barriers stand: before the pass that needs them, together with others, at the end of a submission, or split
// into events. Pure.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "rendergraph/compile_options.h"
#include "rendergraph/device_facts.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

struct Declaration;
struct Schedule;

/// A barrier and the steps before which it may stand.
struct PendingBarrier {
  uint32_t step = 0;            ///< The latest: that of the use that it protects; the number of steps: at the end.
  uint32_t earliest = 0;        ///< After the last use that it waits for.
  uint32_t setAfter = kNone;    ///< Step of that use, when it is in the frame and on the same queue.
  uint32_t submission = kNone;  ///< At the end of this submission, and nowhere else.
  ImageBarrier barrier;         ///< Of a buffer too, then without range and layouts.
};

/// Whether the two sides of a barrier become an event's set and wait.
bool isSplit(const PendingBarrier& found, const CompileOptions& options, const Schedule& schedule,
             std::span<const QueueFacts> queues);

/// Fills the barriers, batches and events of the plan. Precondition: its passes and submissions are complete.
void batchBarriers(const Declaration& declaration, const CompileOptions& options, const Schedule& schedule,
                   std::span<const QueueFacts> queues, std::vector<PendingBarrier>& found, Plan& plan);

}  // namespace lensgraph::rendergraph
