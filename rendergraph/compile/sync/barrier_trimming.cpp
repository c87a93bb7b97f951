// Tries each barrier without each of its bits, and keeps the bits without which the hazard tracker finds a hazard.
#include "rendergraph/compile/sync/barrier_trimming.h"

#include <algorithm>
#include <cassert>

#include "rendergraph/compile/flow/stage_masks.h"
#include "rendergraph/compile/schedule/schedule.h"
#include "rendergraph/compile/schedule/submissions.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

std::vector<uint8_t> endsWithHost(const BarrierInputs& inputs, const Plan& plan) {
  std::vector<uint8_t> result;
  for (const PlannedSubmission& submission : plan.submissions) {
    const auto steps = plan.stepsOf(submission);
    result.push_back(!steps.empty() && inputs.declaration.passes[steps.back().pass].kind == PassKind::host);
  }
  return result;
}

}  // namespace

BarrierTrimming::BarrierTrimming(const BarrierInputs& inputs, const Plan& plan)
    : in_(inputs),
      plan_(plan),
      lastSubmission_(static_cast<uint32_t>(plan.submissions.size() - 1)),
      order_(plan, inputs.schedule.queues, endsWithHost(inputs, plan), inputs.options.overlappingFrames),
      hazards_(inputs, plan, order_) {}

TimedBarrier BarrierTrimming::timed(const PendingBarrier& found) const {
  TimedBarrier result{.barrier = found.barrier, .step = found.step};
  if (found.submission != kNone) {
    result.queue = plan_.submissions[found.submission].queue;
    result.submission = result.scopeEnds = result.takesEffect = found.submission;
    result.step = 0;
    return result;
  }
  const bool atEnd = found.step >= in_.schedule.steps();
  result.queue = atEnd ? 0 : in_.schedule.queue[found.step];
  result.submission = atEnd ? lastSubmission_ : in_.submissions.of[found.step];
  result.scopeEnds = result.takesEffect = result.submission;
  const uint32_t earliest = found.setAfter == kNone ? 0 : in_.submissions.of[found.setAfter];
  if (isSplit(found, in_.options, in_.schedule, in_.queues)) {
    result.scopeEnds = earliest;
  } else if (in_.options.barriers == BarrierTiming::fewestBatches && found.earliest < found.step) {
    result.scopeEnds = result.takesEffect = earliest;
  }
  return result;
}

void BarrierTrimming::trim(const Epoch& epoch, std::vector<PendingBarrier>& found, std::size_t first) {
  barriers_.clear();
  for (std::size_t i = first; i < found.size(); ++i) barriers_.push_back(timed(found[i]));
  hazards_.startEpoch(epoch);
  assert(hazards_.isSynchronized(barriers_));
  hazards_.dropEndStages(barriers_);
  for (TimedBarrier& barrier : barriers_) trim(barrier);
  hazards_.finishEpoch(barriers_, needs_);
  std::size_t kept = first;
  for (std::size_t i = first; i < found.size(); ++i) {
    if (barriers_[i - first].absent) continue;
    found[kept] = found[i];
    if (!isSplit(found[i], in_.options, in_.schedule, in_.queues)) found[kept].setAfter = kNone;
    found[kept++].barrier = barriers_[i - first].barrier;
  }
  found.resize(kept);
}

bool BarrierTrimming::again() {
  if (!hazards_.needsAnotherPass()) return false;
  needs_ = {};
  return true;
}

void BarrierTrimming::trimEnds(std::vector<PendingBarrier>& found) const {
  for (PendingBarrier& barrier : found) {
    const uint32_t resource = barrier.barrier.resource;
    if (isEnd(barrier) && !hazards_.needsEndStage(resource)) barrier.barrier.to.stages &= ~endStages(resource);
  }
}

bool BarrierTrimming::isEnd(const PendingBarrier& found) const {
  return found.step >= in_.schedule.steps() && found.submission == kNone;
}

/// At which the graph's last barrier of the resource may end for the sake of the next frame only.
VkPipelineStageFlags2 BarrierTrimming::endStages(uint32_t resource) const {
  const DeclaredResource& declared = in_.declaration.resources[resource];
  return declared.persistent() ? 0 : ~declared.after.stages;
}

template <class Member>
void BarrierTrimming::trimBits(TimedBarrier& barrier, Member member, uint64_t except) {
  forEachBit(member(barrier.barrier) & ~except, [&](uint64_t bit) {
    member(barrier.barrier) &= ~bit;
    if (!hazards_.isSynchronized(barriers_)) member(barrier.barrier) |= bit;
  });
}

void BarrierTrimming::trim(TimedBarrier& barrier) {
  if (!barrier.writes()) {
    barrier.absent = true;
    if (hazards_.isSynchronized(barriers_)) return;
    barrier.absent = false;
  }
  trimBits(barrier, [](ImageBarrier& b) -> uint64_t& { return b.from.stages; });
  trimBits(barrier, [](ImageBarrier& b) -> uint64_t& { return b.from.access; });
  const bool ends = barrier.step >= in_.schedule.steps() && barrier.writes();
  trimBits(
      barrier, [](ImageBarrier& b) -> uint64_t& { return b.to.stages; },
      ends ? endStages(barrier.barrier.resource) : 0);
  trimBits(barrier, [](ImageBarrier& b) -> uint64_t& { return b.to.access; });
}

}  // namespace lensgraph::rendergraph
