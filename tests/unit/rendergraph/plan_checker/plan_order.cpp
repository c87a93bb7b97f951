// Keys and reach of submissions; see the header.
#include "plan_checker/plan_order.h"

#include <array>

namespace lensgraph::plan_checker {

using namespace rendergraph;

PlanOrder::PlanOrder(const Declaration& declaration, const Plan& plan, uint32_t frames)
    : frames_(frames), steps_(plan.passes.size()), submissionOf_(plan.passes.size()) {
  uint32_t key = 0;
  std::vector<Wait> waits;
  for (uint32_t index = 0; index < plan.submissions.size(); ++index) {
    const PlannedSubmission& submission = plan.submissions[index];
    queues_.push_back(submission.queue);
    begin_.push_back(++key);
    for (const SubmissionWait& wait : plan.waitsOf(submission)) {
      waits.push_back({.submission = index, .target = wait.submission, .stages = wait.stages});
    }
    bool host = false;
    for (uint32_t step = submission.steps.first; step < submission.steps.first + submission.steps.count; ++step) {
      StepKeys& keys = steps_[step];
      submissionOf_[step] = index;
      keys.eventWait = ++key;
      key += plan.passes[step].waits.count;
      keys.before = ++key;
      host = declaration.passes[plan.passes[step].pass].kind == PassKind::host;
      if (host) break;  // The host comes after the end of the submission.
      keys.use = ++key;
      keys.eventSet = ++key;
    }
    atEnd_.push_back(++key);
    hostPass_.push_back(host);
    if (host) {
      StepKeys& keys = steps_[submission.steps.first + submission.steps.count - 1];
      keys.use = keys.eventSet = ++key;
    }
    finished_.push_back(++key);
  }
  span_ = key + 1;
  for (uint32_t step = 0; step < plan.passes.size(); ++step) {
    renderings_.push_back(plan.passes[step].continuesRendering && step > 0 ? renderings_.back() : step);
  }
  connect(waits);
}

void PlanOrder::connect(const std::vector<Wait>& waits) {
  semaphores_ = waits;
  milestones_.clear();
  const auto count = static_cast<uint32_t>(queues_.size());
  const uint32_t nodes = 1 + frames_ * count;
  words_ = (nodes + 63) / 64;
  reach_.assign(std::size_t{nodes} * words_, 0);
  const auto include = [&](uint32_t node, uint32_t earlier) {
    for (uint32_t word = 0; word < words_; ++word) reach_[node * words_ + word] |= reach_[earlier * words_ + word];
  };
  reach_[0] = 1;
  constexpr uint32_t kNever = UINT32_MAX;
  std::array<uint32_t, kMaxQueues> last{};
  last.fill(kNever);
  last[0] = 0;
  uint32_t hostDone = kNever;
  for (uint32_t frame = 0; frame < frames_; ++frame) {
    auto wait = semaphores_.begin();
    for (uint32_t index = 0; index < count; ++index) {
      const uint32_t self = node(frame, index);
      reach_[self * words_ + self / 64] |= uint64_t{1} << (self % 64);
      if (last[queues_[index]] != kNever) include(self, last[queues_[index]]);
      if (hostDone != kNever) include(self, hostDone);
      for (; wait != semaphores_.end() && wait->submission == index; ++wait) {
        include(self, node(frame, wait->target));
        wait->key = begin_[index];
        if (frame == 0) milestones_.push_back(*wait);
      }
      last[queues_[index]] = self;
      if (!hostPass_[index]) continue;
      hostDone = self;
      if (frame == 0) {
        milestones_.push_back({.submission = index, .target = index, .key = finished_[index], .hostDone = true});
      }
    }
  }
}

bool PlanOrder::edgesHold() const {
  const auto count = static_cast<uint32_t>(queues_.size());
  for (uint32_t index = 0; index < count; ++index) {
    if (!covers(node(0, count - 1), node(0, index))) return false;
  }
  return true;
}

}  // namespace lensgraph::plan_checker
