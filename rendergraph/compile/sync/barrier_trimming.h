// Removes from barriers and semaphore waits every stage and access bit that another wait already guarantees. Pure.
//
// A barrier on one queue is needed in every bit, as long as nothing else orders that queue. A semaphore to another
// queue and back does, for everything that was on the queue before; so does the host when it waits in the middle of a
// plan. Each bit of a barrier is tried without, once: what is needed now is needed all the more when others are gone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/compile/memory/memory_predecessors.h"
#include "rendergraph/compile/schedule/cell_uses.h"
#include "rendergraph/compile/schedule/submission_order.h"
#include "rendergraph/compile/sync/barrier_batching.h"
#include "rendergraph/compile/sync/hazard_tracker.h"
#include "rendergraph/compile/sync/plan_barriers.h"
#include "rendergraph/compile/sync/wait_minimizer.h"

namespace lensgraph::rendergraph {

class BarrierTrimming {
 public:
  BarrierTrimming(const BarrierInputs& inputs, const Plan& plan);

  /// The following epochs are those of this cell, one after the other.
  void begin(uint32_t resource, uint32_t cell, std::span<const MemoryPredecessor> predecessors) {
    hazards_.startCell(resource, cell, predecessors);
  }
  /// `found` from the index on are the barriers that the epoch needs when nothing else orders it.
  void trim(const Epoch& epoch, std::vector<PendingBarrier>& found, std::size_t first);
  /// After the last cell: whether they must all be gone through once more.
  bool again();
  /// After the last cell: of all barriers, those at the end lose the stages that only the next frame might have needed.
  void trimEnds(std::vector<PendingBarrier>& found) const;
  /// After the last cell: keeps only the semaphore waits that the remaining barriers rely on.
  void trimWaits(Plan& plan) { needs_.minimize(order_, plan); }

 private:
  TimedBarrier timed(const PendingBarrier& found) const;
  template <class Member>
  void trimBits(TimedBarrier& barrier, Member member, uint64_t except = 0);
  bool isEnd(const PendingBarrier& found) const;
  VkPipelineStageFlags2 endStages(uint32_t resource) const;
  void trim(TimedBarrier& barrier);

  const BarrierInputs& in_;
  const Plan& plan_;
  uint32_t lastSubmission_;
  SubmissionOrder order_;
  HazardTracker hazards_;
  WaitMinimizer needs_;
  std::vector<TimedBarrier> barriers_;  // Of the epoch.
};

}  // namespace lensgraph::rendergraph
