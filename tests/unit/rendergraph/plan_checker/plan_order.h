// When the commands of a plan happen, for the plan checker: one key for each moment in the order of the list, and
// which submissions are finished where a semaphore has been waited for.
//
// The signal at the end of a submission covers everything that its queue was given before, and all that this has
// waited for: a signal's first scope is every stage, so a chain through it never breaks, whatever the stages of the
// waits. Whatever comes after a host pass in the list also comes after all that its submission covers, because the
// host waits. Node 0 stands for what came before the frame, on queue 0; when two
// frames follow each other, the second one's submissions have nodes of their own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plan_checker/usage_model.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/plan.h"

namespace lensgraph::plan_checker {

inline constexpr uint32_t kMaxQueues = 4;

/// A semaphore wait, or the host's waiting for the submission of a host pass.
struct Wait {
  uint32_t submission = 0;  ///< That waits; with hostDone, that the host has waited for.
  uint32_t target = 0;      ///< That is waited for.
  VkPipelineStageFlags2 stages = 0;
  uint32_t key = 0;
  bool hostDone = false;
};

class PlanOrder {
 public:
  struct StepKeys {
    uint32_t eventWait = 0;  ///< Of the first event; the others follow one by one.
    uint32_t before = 0, use = 0, eventSet = 0;
  };

  PlanOrder(const rendergraph::Declaration& declaration, const rendergraph::Plan& plan, uint32_t frames);

  /// Takes other semaphore waits than the plan's, in the order of the submissions.
  void connect(const std::vector<Wait>& waits);
  const std::vector<Wait>& semaphores() const { return semaphores_; }
  /// Semaphore waits and ends of host passes, in the order of the list.
  const std::vector<Wait>& milestones() const { return milestones_; }

  uint32_t frames() const { return frames_; }
  uint32_t span() const { return span_; }  ///< Greater than every key.
  const StepKeys& keysOf(uint32_t step) const { return steps_[step]; }
  uint32_t keyBegin(uint32_t submission) const { return begin_[submission]; }
  uint32_t keyAtEnd(uint32_t submission) const { return atEnd_[submission]; }
  uint32_t submissionOf(uint32_t step) const { return submissionOf_[step]; }
  uint32_t queueOf(uint32_t submission) const { return queues_[submission]; }
  /// First step of the rendering that a step draws in; the step itself without rendering.
  uint32_t renderingOf(uint32_t step) const { return renderings_[step]; }
  bool endsRendering(uint32_t step) const {
    return step + 1 == renderings_.size() || renderings_[step + 1] != renderings_[step];
  }

  uint32_t node(uint32_t frame, uint32_t submission) const {
    return 1 + frame * static_cast<uint32_t>(queues_.size()) + submission;
  }
  uint32_t nodeBefore(uint32_t frame) const { return frame == 0 ? 0 : node(frame, 0) - 1; }
  bool covers(uint32_t node, uint32_t earlier) const {
    return (reach_[node * words_ + earlier / 64] >> (earlier % 64) & 1) != 0;
  }
  /// Whether the last submission follows all.
  bool edgesHold() const;

 private:
  uint32_t frames_;
  uint32_t span_ = 0;
  std::vector<StepKeys> steps_;
  std::vector<uint32_t> submissionOf_, renderings_;          // By step.
  std::vector<uint32_t> begin_, atEnd_, finished_, queues_;  // By submission.
  std::vector<bool> hostPass_;                               // By submission.
  std::vector<Wait> semaphores_, milestones_;
  std::vector<uint64_t> reach_;  // A row of bits for each node: what its signal covers.
  uint32_t words_ = 0;
};

}  // namespace lensgraph::plan_checker
