// Cuts the schedule where queues wait for each other and at host passes, puts the steps of each submission together, and
// finds with vector clocks which steps may run concurrently.
#include "rendergraph/compile/schedule/submissions.h"

#include <algorithm>
#include <numeric>

#include "rendergraph/compile/schedule/schedule.h"
#include "rendergraph/compile/schedule/submission_waits.h"
#include "rendergraph/compile/schedule/vector_clocks.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

/// Cuts before steps that wait and after steps that are waited for, and at host passes on every queue.
class Cutter {
 public:
  Cutter(const Declaration& declaration, const Schedule& schedule, std::span<const StepWait> waits)
      : declaration_(declaration), schedule_(schedule), waits_(waits), open_(schedule.queues, kNone) {
    signals_.assign(schedule.steps(), 0);
    for (const StepWait& wait : waits) {
      if (wait.from != kNone) signals_[schedule.unitLast[wait.from]] = 1;
    }
  }

  Submissions run(std::vector<uint32_t>& stepsInOrder) {
    const bool several = schedule_.severalQueues;
    if (several) begin(0);
    std::size_t wait = 0;
    for (uint32_t step = 0; step < schedule_.steps(); ++step) {
      const uint32_t queue = schedule_.queue[step];
      const bool waits = wait < waits_.size() && waits_[wait].to == step;
      if (open_[queue] == kNone || waits) begin(queue);
      members_[open_[queue]].push_back(step);
      result_.of.resize(schedule_.steps());
      result_.of[step] = open_[queue];
      for (; wait < waits_.size() && waits_[wait].to == step; ++wait) addWait(open_[queue], waits_[wait]);
      const bool host = declaration_.passes[schedule_.order[step]].kind == PassKind::host;
      if (signals_[step]) open_[queue] = kNone;
      if (host) std::fill(open_.begin(), open_.end(), kNone);
    }
    if (several || open_[0] == kNone) begin(0);
    for (; wait < waits_.size(); ++wait) addWait(open_[0], waits_[wait]);
    collect(stepsInOrder);
    return std::move(result_);
  }

 private:
  void begin(uint32_t queue) {
    open_[queue] = static_cast<uint32_t>(result_.list.size());
    result_.list.push_back({.queue = queue});
    members_.emplace_back();
    waitsOf_.emplace_back();
    // The first submission is waited for by others, and is over at once.
    if (schedule_.severalQueues && result_.list.size() == 1) open_[queue] = kNone;
  }
  void addWait(uint32_t submission, const StepWait& wait) {
    const uint32_t source = wait.from == kNone ? 0 : result_.of[wait.from];
    waitsOf_[submission].push_back({.submission = source, .stages = wait.stages});
  }
  void collect(std::vector<uint32_t>& stepsInOrder) {
    for (std::size_t i = 0; i < result_.list.size(); ++i) {
      PlannedSubmission& submission = result_.list[i];
      submission.steps = {static_cast<uint32_t>(stepsInOrder.size()), static_cast<uint32_t>(members_[i].size())};
      submission.waits = {static_cast<uint32_t>(result_.waits.size()), static_cast<uint32_t>(waitsOf_[i].size())};
      stepsInOrder.insert(stepsInOrder.end(), members_[i].begin(), members_[i].end());
      result_.waits.insert(result_.waits.end(), waitsOf_[i].begin(), waitsOf_[i].end());
    }
  }

  const Declaration& declaration_;
  const Schedule& schedule_;
  std::span<const StepWait> waits_;
  std::vector<uint32_t> open_;
  std::vector<uint8_t> signals_;
  Submissions result_;
  std::vector<std::vector<uint32_t>> members_;        // Steps by submission.
  std::vector<std::vector<SubmissionWait>> waitsOf_;  // By submission.
};

/// Renumbers the steps.
void reorder(const std::vector<uint32_t>& stepsInOrder, Schedule& schedule, std::vector<uint32_t>& submissionOf) {
  Schedule old = schedule;
  const std::vector<uint32_t> oldSubmissions = submissionOf;
  std::vector<uint32_t> newStep(stepsInOrder.size());
  for (uint32_t step = 0; step < stepsInOrder.size(); ++step) newStep[stepsInOrder[step]] = step;
  for (uint32_t step = 0; step < stepsInOrder.size(); ++step) {
    const uint32_t from = stepsInOrder[step];
    schedule.order[step] = old.order[from];
    schedule.queue[step] = old.queue[from];
    schedule.unitFirst[step] = newStep[old.unitFirst[from]];
    schedule.unitLast[step] = newStep[old.unitLast[from]];
    submissionOf[step] = oldSubmissions[from];
  }
}

/// For each step, the last step of any other queue that may run concurrently with it.
void findConcurrent(const Schedule& schedule, Submissions& submissions) {
  const uint32_t queues = schedule.queues;
  const auto count = static_cast<uint32_t>(submissions.list.size());
  // By queue, the number of the last step that is over, plus one: when a submission begins, when it ends, and on the
  // submission's queue so far.
  VectorClocks atBegin(count, queues), atEnd(count, queues), now(queues, queues);
  for (uint32_t i = 0; i < count; ++i) {
    const PlannedSubmission& submission = submissions.list[i];
    for (uint32_t w = 0; w < submission.waits.count; ++w) {
      now.include(submission.queue, atEnd.row(submissions.waits[submission.waits.first + w].submission));
    }
    atBegin.include(i, now.row(submission.queue));
    if (submission.steps.count > 0) {
      now.of(submission.queue, submission.queue) = submission.steps.first + submission.steps.count;
    }
    atEnd.include(i, now.row(submission.queue));
  }
  // The last step of all later submissions that have not waited for this one.
  for (uint32_t step = 0; step < schedule.steps(); ++step) {
    uint32_t& last = submissions.lastConcurrent[step];
    for (uint32_t i = submissions.of[step] + 1; i < count; ++i) {
      const PlannedSubmission& other = submissions.list[i];
      if (other.steps.count == 0 || other.queue == schedule.queue[step]) continue;
      if (atBegin.of(i, schedule.queue[step]) > step) continue;
      last = std::max(last, other.steps.first + other.steps.count - 1);
    }
  }
}

}  // namespace

Submissions planSubmissions(const Declaration& declaration, const Cells& cells, const CellUses& cellUses,
                            std::span<const Sharing> sharing, bool overlappingFrames, Schedule& schedule) {
  std::vector<StepWait> waits;
  if (schedule.severalQueues) {
    waits = findStepWaits(declaration, cells, cellUses, sharing, overlappingFrames, schedule);
  }
  std::vector<uint32_t> stepsInOrder;
  Submissions result = Cutter(declaration, schedule, waits).run(stepsInOrder);
  result.of.resize(schedule.steps());
  if (schedule.severalQueues) reorder(stepsInOrder, schedule, result.of);
  result.lastConcurrent.resize(schedule.steps());
  std::iota(result.lastConcurrent.begin(), result.lastConcurrent.end(), 0u);
  if (schedule.severalQueues) findConcurrent(schedule, result);
  return result;
}

}  // namespace lensgraph::rendergraph
