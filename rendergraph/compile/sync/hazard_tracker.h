// What the uses of a cell have to respect, and whether barriers, semaphores and the host's waiting see to it. Pure.
//
// Every use leaves a record for each of its stages, and every change of layout or owner one at no stage. On a queue,
// stages come after a record when
//   a barrier has the record in its first scope and the stages in its second: because it is of the same queue and one
//   of the first stages, or because a first stage came after it already;
//   or they have waited for a semaphore, or the host has, that covers the record.
// A semaphore makes available what was written, and visible to every access of the stages that wait.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/compile/memory/memory_predecessors.h"
#include "rendergraph/compile/schedule/cell_uses.h"
#include "rendergraph/compile/schedule/submission_order.h"
#include "rendergraph/compile/sync/barrier_batching.h"
#include "rendergraph/compile/sync/plan_barriers.h"
#include "rendergraph/compile/sync/wait_minimizer.h"

namespace lensgraph::rendergraph {

/// A barrier and when it takes effect.
struct TimedBarrier {
  ImageBarrier barrier;  ///< Of a buffer too.
  uint32_t queue = 0;
  uint32_t step = 0;         ///< Of the use that it stands before; 0: at the end of a submission.
  uint32_t submission = 0;   ///< Where it stands at the latest.
  uint32_t scopeEnds = 0;    ///< Submission where its first scope ends: earlier if it may be moved or is split.
  uint32_t takesEffect = 0;  ///< Submission where its second scope begins: earlier if it may be moved.
  bool absent = false;

  bool transfers() const { return barrier.fromQueue != barrier.toQueue; }
  bool acquires() const { return transfers() && barrier.toQueue == queue; }
  bool writes() const { return transfers() || barrier.oldLayout != barrier.newLayout; }
};

class HazardTracker {
 public:
  HazardTracker(const BarrierInputs& inputs, const Plan& plan, const SubmissionOrder& order);

  /// Begins a cell: the records are those of its memory before the graph. The following calls are about this cell.
  void startCell(uint32_t resource, uint32_t cell, std::span<const MemoryPredecessor> predecessors);
  /// Takes the next epoch of the cell, which the following calls are about.
  void startEpoch(const Epoch& epoch);
  /// Drops a resource's end-of-frame stage if this epoch does not depend on it.
  void dropEndStages(std::span<const TimedBarrier> barriers);
  /// After the last cell: whether the next frame relies on the end-of-frame stage of a resource.
  bool needsEndStage(uint32_t resource) const { return endStages_[resource].needed; }
  /// True if one successor needs an end-of-frame stage that another successor's epoch dropped; all cells must then be
  /// processed again, now knowing which stages are needed.
  bool needsAnotherPass();
  /// Whether these barriers, in the order in which they take effect, leave no hazard for the epoch.
  bool isSynchronized(std::span<const TimedBarrier> barriers);
  /// Adds the records of the epoch, and notes in `needs` which waits it relied on. Precondition: isSynchronized().
  void finishEpoch(std::span<const TimedBarrier> barriers, WaitMinimizer& needs);

 private:
  using Moment = SubmissionOrder::Moment;
  static constexpr uint32_t kOnEveryQueue = ~uint32_t{0};
  /// The second scope of a barrier that had the record in its first.
  struct Passed {
    uint32_t queue = 0;
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
    std::vector<WaitStage>
        through;  // The record passed this barrier only if one of these waits happened; empty: unconditionally.
    bool operator==(const Passed&) const = default;
  };
  struct Record {
    Moment moment = 0;
    uint32_t queue = 0;
    VkPipelineStageFlags2 stages = 0;  // One, as its elementary ones; 0: by a change of layout or owner.
    VkAccessFlags2 written = 0;
    bool write = false;
    bool seen = false;       // By a read.
    bool settled = false;    // The host had waited before the graph.
    bool byHost = false;     // Nothing has to make it visible once the host is done.
    uint32_t available = 0;  // Queues, one bit each, on which it is.
    std::vector<Passed> passed;
    uint32_t endOf = kNone;  // Resource that has `passed` for the next frame's sake only.
    bool operator==(const Record&) const = default;
  };
  struct Touch {
    VkPipelineStageFlags2 stages;  // One, as its elementary ones.
    VkAccessFlags2 access;
  };
  struct Use {
    uint32_t queue, step, submission;
    bool reads, writes;
    uint32_t firstTouch, endTouch;  // Of touches_.
  };
  enum class Reach : uint8_t { no, throughWaits, always };

  void addUse(const CellUse& use);
  void addTouch(std::size_t first, VkPipelineStageFlags2 stages, VkAccessFlags2 access);
  void addRecords(const Use& use, Moment moment, std::vector<Record>& records) const;
  void addOutside(const DeclaredResource& resource);
  const std::vector<Record>& leftBy(uint32_t resource);
  void addLeft(uint32_t resource, uint32_t cell, std::vector<Record>& records);
  Record writtenBy(const TimedBarrier& barrier) const;

  bool settled(const Record& record, uint32_t submission) const;
  template <class Serves>
  void addThrough(const Record& record, uint32_t queue, uint32_t submission, Serves&& serves);
  Reach inFirstScope(const Record& record, const TimedBarrier& barrier);
  bool makesAvailable(const Record& record, const TimedBarrier& barrier) const;
  Reach available(const Record& record, uint32_t queue, uint32_t submission);
  Reach reached(const Record& record, const Use& use, const Touch& touch, std::span<const TimedBarrier> barriers);
  bool respects(const Use& use, const Record& record, std::span<const TimedBarrier> barriers, WaitMinimizer* needs);
  bool canWrite(const TimedBarrier& barrier, const Record& record, WaitMinimizer* needs);
  bool check(std::span<const TimedBarrier> barriers, WaitMinimizer* needs);
  void pass(Record& record, const TimedBarrier& barrier, WaitMinimizer& needs);
  bool note(Reach reach, const Record& record, WaitMinimizer* needs);
  void noteHost(const Record& record, uint32_t submission, WaitMinimizer* needs) const;

  const BarrierInputs& in_;
  const Plan& plan_;
  const SubmissionOrder& order_;
  uint32_t resource_ = 0, cell_ = 0;
  std::vector<Record> records_;
  std::vector<Use> uses_;  // Of the epoch.
  std::vector<Touch> touches_;
  std::vector<WaitStage> through_;  // Of the question being answered; one is enough unless all are listed.
  bool listAll_ = false;
  std::vector<std::vector<Record>> left_;  // By resource.
  std::vector<uint8_t> leftKnown_;         // By resource.
  /// The stage at which a frame leaves a resource, for the next frame's first use to wait for.
  struct EndStage {
    bool needed = true;    // Some successor relies on it.
    bool dropped = false;  // Some successor's epoch was checked without it.
    bool known = false;    // `needed` is final: it was found by a whole pass over the cells.
  };
  std::vector<EndStage> endStages_;  // Indexed by resource.
};

}  // namespace lensgraph::rendergraph
