// Which submissions are over when another one begins: what semaphores, and the host's waiting, order. Pure.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/compile/schedule/vector_clocks.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

/// Vector clocks over the submissions of a plan. With overlapping frames, the frame before has submissions of its own.
/// A moment is the end of one of them, or what was before the graph.
class SubmissionOrder {
 public:
  using Moment = uint32_t;

  /// `endsWithHost`: by submission, whether its last step is a host pass.
  SubmissionOrder(const Plan& plan, uint32_t queues, std::vector<uint8_t> endsWithHost, bool overlappingFrames);

  /// Takes the waits of the plan as they are now. One without stages is none.
  void update();

  /// The end of the frame before, on queue 0.
  Moment beforeGraph() const { return thisFrame_; }
  Moment momentOf(uint32_t submission) const { return 1 + thisFrame_ + submission; }
  /// The same moment in the frame before.
  Moment inFrameBefore(Moment moment) const { return moment - thisFrame_; }
  /// Whether the later moment comes after the other; a moment does after itself.
  bool covers(Moment later, Moment moment) const { return clocks_.of(later, queueOf_[moment]) > moment; }
  /// The latest moment that the host has waited for before it submits; what that covers comes before everything.
  Moment hostDoneBefore(uint32_t submission) const { return hostDone_[submission]; }

  /// Whether what a wait waits for comes after the moment; `ofFrameBefore`: the same wait in the frame before.
  bool waitCovers(uint32_t wait, bool ofFrameBefore, Moment moment) const {
    const Moment end = momentOf(plan_.submissionWaits[wait].submission);
    return covers(ofFrameBefore ? inFrameBefore(end) : end, moment);
  }

  /// Calls use(wait, ofFrameBefore) for the waits of a queue that cover the moment, up to those of `submission`, as
  /// long as it returns true.
  template <class Use>
  void forWaits(uint32_t queue, uint32_t submission, Moment moment, Use&& use) const {
    const bool before = moment <= beforeGraph();
    const std::vector<QueueWait>& waits = waitsOf_[queue];
    for (auto wait = firstAfter(waits, submission); wait != waits.begin();) {
      --wait;
      if (!before && momentOf(wait->submission) <= moment) break;
      if (waitCovers(wait->index, false, moment) && !use(wait->index, false)) return;
    }
    if (!before || thisFrame_ == 0) return;
    for (auto wait = waits.end(); wait != waits.begin();) {
      --wait;
      if (inFrameBefore(momentOf(wait->submission)) <= moment) break;
      if (waitCovers(wait->index, true, moment) && !use(wait->index, true)) return;
    }
  }

 private:
  struct QueueWait {
    uint32_t index, submission;
  };
  static std::vector<QueueWait>::const_iterator firstAfter(const std::vector<QueueWait>& waits, uint32_t submission) {
    return std::upper_bound(waits.begin(), waits.end(), submission,
                            [](uint32_t value, const QueueWait& wait) { return value < wait.submission; });
  }
  const Plan& plan_;
  uint32_t queues_;
  std::vector<uint8_t> endsWithHost_;
  uint32_t thisFrame_;             // Submissions before those of the frame.
  std::vector<uint32_t> queueOf_;  // By moment.
  std::vector<Moment> hostDone_;   // By submission: the latest one for which the host has waited before.
  VectorClocks clocks_;            // By moment and queue: the latest moment of the queue before it, plus one.
  std::vector<std::vector<QueueWait>> waitsOf_;  // By queue.
};

}  // namespace lensgraph::rendergraph
