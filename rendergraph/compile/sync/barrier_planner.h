// Visits every cell and finds its barriers: barrier_planner.cpp for cells that one queue uses, barrier_planner_queues.cpp
// for cells that several queues use.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rendergraph/compile/flow/cells.h"
#include "rendergraph/compile/flow/stage_masks.h"
#include "rendergraph/compile/memory/memory_predecessors.h"
#include "rendergraph/compile/schedule/cell_uses.h"
#include "rendergraph/compile/schedule/schedule.h"
#include "rendergraph/compile/schedule/submissions.h"
#include "rendergraph/compile/sync/barrier_batching.h"
#include "rendergraph/compile/sync/barrier_trimming.h"
#include "rendergraph/compile/sync/plan_barriers.h"
#include "rendergraph/compile/sync/visibility.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

/// A cell between two epochs.
struct CellState {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  AccessPoint last;           ///< Stages 0: nothing to wait for.
  uint32_t lastStep = kNone;  ///< Of `last`, when it is in this frame.
  bool wrote = false;         ///< `last` wrote and nobody has waited for it yet.
  bool alias = false;         ///< `last` had the memory before.
  bool fixed = false;         ///< `last` was on another queue: the barrier stands after the wait for it, at the use.
  Visibility visible = Visibility::toEverything();
};

class BarrierPlanner {
 public:
  BarrierPlanner(const BarrierInputs& inputs, Plan& plan) : in_(inputs), plan_(plan) {}
  void run();

 private:
  // Who had the memory before.
  void findPredecessors();
  void noteFinalScopes(uint32_t resource, uint32_t cell);
  void noteUnused(uint32_t resource);
  bool noteExported(const DeclaredResource& declared, std::span<const CellUse> uses, bool owned,
                    AccessPoint& scope) const;
  CellState stateAfterPredecessors(uint32_t resource, uint32_t queue) const;
  CellState stateBefore(uint32_t resource, uint32_t queue) const;

  // One queue.
  void planResource(uint32_t resource);
  void planCell(uint32_t resource, uint32_t cell, const CellState& start);
  void joinReads(uint32_t resource, uint32_t cell, CellState& state, const Epoch& epoch);
  void separate(uint32_t resource, uint32_t cell, const CellState& state, const Epoch& epoch, bool transition);
  void add(uint32_t resource, uint32_t cell, const Epoch& epoch, const CellState& state, ImageBarrier barrier,
           VkAccessFlags2 access);

  // Several queues.
  struct Crossing;
  bool crosses(const DeclaredResource& resource) const;
  void planCrossingCell(uint32_t resource, uint32_t cell, const CellState& start);
  void cross(Crossing& crossing, const Epoch& epoch);
  void transferOwnership(Crossing& crossing, const Epoch& epoch);
  void changeLayoutAtEnd(Crossing& crossing, const Epoch& epoch);
  void changeLayoutBefore(Crossing& crossing, const Epoch& epoch);
  void waitOnOwnQueue(Crossing& crossing, const Epoch& epoch, uint32_t queue);
  void chainFromWait(Crossing& crossing, const Epoch& epoch, uint32_t queue);
  void addCrossing(const Crossing& crossing, const Epoch& epoch, uint32_t queue, ImageBarrier barrier);
  uint32_t submissionAfter(const Crossing& crossing) const;

  const BarrierInputs& in_;
  Plan& plan_;
  /// What a successor in memory waits for, by resource and queue; the steps by resource.
  std::vector<AccessPoint> finalScopes_;
  std::vector<uint32_t> finalSteps_;
  std::vector<uint8_t> changedAtEnd_;  // By resource: exported in another layout or from another queue.
  MemoryPredecessors predecessors_;
  std::vector<CellUse> uses_;          // Of the current cell.
  std::vector<PendingBarrier> found_;  // Of the current resource.
  std::vector<PendingBarrier> all_;
  std::optional<BarrierTrimming> trimming_;
};

}  // namespace lensgraph::rendergraph
