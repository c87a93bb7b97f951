// The fewest batches for given intervals are found by stabbing them: by their right ends, each barrier joins the
// latest batch that lies in its interval, and founds one at its right end when there is none. No set of batches can
// be smaller, because the founders' intervals do not overlap.
#include "rendergraph/compile/sync/barrier_batching.h"

#include <algorithm>
#include <numeric>

#include "rendergraph/compile/schedule/schedule.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

class BarrierBatcher {
 public:
  BarrierBatcher(const Declaration& declaration, const CompileOptions& options, const Schedule& schedule,
                 std::span<const QueueFacts> queues, std::vector<PendingBarrier>& found, Plan& plan)
      : declaration_(declaration),
        options_(options),
        schedule_(schedule),
        queues_(queues),
        found_(found),
        plan_(plan),
        steps_(schedule.steps()),
        submissions_(static_cast<uint32_t>(plan.submissions.size())) {}

  void run() {
    slotOf_.resize(found_.size());
    if (options_.splitDistance > 0) findEvents();
    if (options_.barriers == BarrierTiming::fewestBatches) gather();
    for (uint32_t i = 0; i < found_.size(); ++i) slotOf_[i] = slotFor(found_[i]);
    for (uint32_t i = 0; i < eventOf_.size(); ++i) {
      if (eventOf_[i] != kNone) slotOf_[i] = steps_ + submissions_ + eventOf_[i];
    }
    emit();
    linkEvents();
  }

 private:
  uint32_t queueOf(const PendingBarrier& found) const { return found.step < steps_ ? schedule_.queue[found.step] : 0; }

  /// Barriers between the same two steps share an event.
  void findEvents() {
    eventOf_.assign(found_.size(), kNone);
    std::vector<uint32_t> split;
    for (uint32_t i = 0; i < found_.size(); ++i) {
      if (isSplit(found_[i], options_, schedule_, queues_)) split.push_back(i);
    }
    std::stable_sort(split.begin(), split.end(), [&](uint32_t a, uint32_t b) {
      return std::pair(found_[a].step, found_[a].setAfter) < std::pair(found_[b].step, found_[b].setAfter);
    });
    for (uint32_t i : split) {
      const PendingBarrier& found = found_[i];
      if (plan_.events.empty() || plan_.events.back().waitBefore != found.step ||
          plan_.events.back().setAfter != found.setAfter) {
        plan_.events.push_back({.setAfter = found.setAfter, .waitBefore = found.step});
      }
      eventOf_[i] = static_cast<uint32_t>(plan_.events.size() - 1);
    }
  }

  void gather() {
    std::vector<uint32_t> byStep;
    for (uint32_t i = 0; i < found_.size(); ++i) {
      if (found_[i].submission == kNone && (eventOf_.empty() || eventOf_[i] == kNone)) {
        byStep.push_back(i);
      }
    }
    std::stable_sort(byStep.begin(), byStep.end(),
                     [&](uint32_t a, uint32_t b) { return found_[a].step < found_[b].step; });
    std::vector<uint32_t> latestBatch(schedule_.queues, kNone);
    for (uint32_t i : byStep) {
      PendingBarrier& found = found_[i];
      uint32_t& batch = latestBatch[queueOf(found)];
      if (batch == kNone || batch < found.earliest) batch = found.step;
      found.step = batch;
    }
  }

  /// Batches are numbered: before steps, at ends of submissions, then events.
  uint32_t slotFor(const PendingBarrier& found) const {
    if (found.submission != kNone) return steps_ + found.submission;
    return found.step < steps_ ? found.step : steps_ + submissions_ - 1;
  }

  BarrierBatch& batchOf(uint32_t slot) {
    if (slot < steps_) return plan_.passes[slot].before;
    if (slot < steps_ + submissions_) return plan_.submissions[slot - steps_].atEnd;
    return plan_.events[slot - steps_ - submissions_].barriers;
  }

  void emit() {
    const uint32_t slots = steps_ + submissions_ + static_cast<uint32_t>(plan_.events.size());
    std::vector<uint32_t> starts(slots + 1, 0);
    for (uint32_t slot : slotOf_) ++starts[slot + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<uint32_t> sorted(found_.size()), next(starts.begin(), starts.end() - 1);
    for (uint32_t i = 0; i < found_.size(); ++i) sorted[next[slotOf_[i]]++] = i;
    plan_.imageBarriers.reserve(found_.size());
    for (uint32_t slot = 0; slot < slots; ++slot) {
      BarrierBatch& batch = batchOf(slot);
      batch.images.first = static_cast<uint32_t>(plan_.imageBarriers.size());
      batch.buffers.first = static_cast<uint32_t>(plan_.bufferBarriers.size());
      for (uint32_t i = starts[slot]; i < starts[slot + 1]; ++i) append(found_[sorted[i]].barrier);
      batch.images.count = static_cast<uint32_t>(plan_.imageBarriers.size()) - batch.images.first;
      batch.buffers.count = static_cast<uint32_t>(plan_.bufferBarriers.size()) - batch.buffers.first;
      plan_.barrierBatches += !batch.empty();
    }
  }

  void append(const ImageBarrier& barrier) {
    if (declaration_.resources[barrier.resource].isImage) {
      plan_.imageBarriers.push_back(barrier);
      return;
    }
    plan_.bufferBarriers.push_back({.resource = barrier.resource,
                                    .from = barrier.from,
                                    .to = barrier.to,
                                    .fromQueue = barrier.fromQueue,
                                    .toQueue = barrier.toQueue,
                                    .reason = barrier.reason});
  }

  /// Tells every step which events it waits for and which it sets.
  void linkEvents() {
    const auto count = static_cast<uint32_t>(plan_.events.size());
    if (count == 0) return;
    plan_.eventSets.resize(count);
    std::iota(plan_.eventSets.begin(), plan_.eventSets.end(), 0u);
    std::stable_sort(plan_.eventSets.begin(), plan_.eventSets.end(),
                     [&](uint32_t a, uint32_t b) { return plan_.events[a].setAfter < plan_.events[b].setAfter; });
    for (uint32_t i = 0; i < count; ++i) {
      extend(plan_.passes[plan_.events[i].waitBefore].waits, i);
      extend(plan_.passes[plan_.events[plan_.eventSets[i]].setAfter].sets, i);
    }
  }
  static void extend(Run& run, uint32_t element) {
    if (run.count == 0) run.first = element;
    ++run.count;
  }

  const Declaration& declaration_;
  const CompileOptions& options_;
  const Schedule& schedule_;
  std::span<const QueueFacts> queues_;
  std::vector<PendingBarrier>& found_;
  Plan& plan_;
  const uint32_t steps_, submissions_;
  std::vector<uint32_t> slotOf_;   // By barrier.
  std::vector<uint32_t> eventOf_;  // By barrier; empty when nothing is split.
};

}  // namespace

bool isSplit(const PendingBarrier& found, const CompileOptions& options, const Schedule& schedule,
             std::span<const QueueFacts> queues) {
  if (options.splitDistance == 0) return false;
  if (found.setAfter == kNone || found.submission != kNone) return false;
  if (found.step >= schedule.steps() || found.step - found.setAfter - 1 < options.splitDistance) return false;
  constexpr VkPipelineStageFlags2 kHost = VK_PIPELINE_STAGE_2_HOST_BIT;  // Events do not know the host.
  if (((found.barrier.from.stages | found.barrier.to.stages) & kHost) != 0) return false;
  const QueueFacts& queue = queues[schedule.queue[found.step]];
  return queue.graphics || queue.compute;  // Others have no events.
}

void batchBarriers(const Declaration& declaration, const CompileOptions& options, const Schedule& schedule,
                   std::span<const QueueFacts> queues, std::vector<PendingBarrier>& found, Plan& plan) {
  BarrierBatcher(declaration, options, schedule, queues, found, plan).run();
}

}  // namespace lensgraph::rendergraph
