// Whether a cell's next epoch respects the records of what was before; hazard_tracker_records.cpp makes them.
#include "rendergraph/compile/sync/hazard_tracker.h"

#include <algorithm>
#include <bit>

#include "rendergraph/compile/flow/stage_masks.h"
#include "rendergraph/declare/access_table.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

constexpr VkPipelineStageFlags2 kHost = VK_PIPELINE_STAGE_2_HOST_BIT;

/// Whether the stages stand for all of the others, which are elementary.
bool contains(VkPipelineStageFlags2 stages, VkPipelineStageFlags2 elementary) {
  return (elementary & ~elementaryStages(stages)) == 0;
}

bool containsAccess(VkAccessFlags2 access, VkAccessFlags2 part) {
  return (expandedAccess(part) & ~expandedAccess(access)) == 0;
}

}  // namespace

HazardTracker::HazardTracker(const BarrierInputs& inputs, const Plan& plan, const SubmissionOrder& order)
    : in_(inputs),
      plan_(plan),
      order_(order),
      left_(plan_.placements.empty() ? 0 : inputs.declaration.resources.size()) {
  leftKnown_.assign(left_.size(), 0);
  endStages_.resize(inputs.declaration.resources.size());
}

HazardTracker::Record HazardTracker::writtenBy(const TimedBarrier& barrier) const {
  Record record{
      .moment = order_.momentOf(barrier.submission), .queue = barrier.queue, .write = true, .available = kOnEveryQueue};
  record.passed.push_back({barrier.queue, barrier.barrier.to.stages, barrier.barrier.to.access, {}});
  return record;
}

bool HazardTracker::settled(const Record& record, uint32_t submission) const {
  const Moment host = order_.hostDoneBefore(submission);
  return record.settled || (host != kNone && order_.covers(host, record.moment));
}

void HazardTracker::noteHost(const Record& record, uint32_t submission, WaitMinimizer* needs) const {
  if (needs == nullptr || record.settled) return;
  needs->needOrder(record.moment, order_.hostDoneBefore(submission));
}

/// The stages of waits up to a submission that cover the record and serve.
template <class Serves>
void HazardTracker::addThrough(const Record& record, uint32_t queue, uint32_t submission, Serves&& serves) {
  const std::size_t before = through_.size();
  order_.forWaits(queue, submission, record.moment, [&](uint32_t wait, bool inFrameBefore) {
    forEachBit(plan_.submissionWaits[wait].stages, [&](VkPipelineStageFlags2 stage) {
      if (serves(stage)) {
        through_.push_back({wait, static_cast<uint32_t>(std::countr_zero(stage)), inFrameBefore});
      }
    });
    return listAll_ || through_.size() == before;
  });
}

/// Collects what it depends on in through_.
HazardTracker::Reach HazardTracker::inFirstScope(const Record& record, const TimedBarrier& barrier) {
  const VkPipelineStageFlags2 source = elementaryStages(barrier.barrier.from.stages);
  const std::size_t before = through_.size();
  if (settled(record, barrier.scopeEnds)) return Reach::always;
  if (record.stages != 0 && record.queue == barrier.queue && (record.stages & ~source) == 0) return Reach::always;
  for (const Passed& passed : record.passed) {
    if (passed.queue != barrier.queue || (elementaryStages(passed.stages) & source) == 0) continue;
    if (passed.through.empty()) return Reach::always;
    through_.insert(through_.end(), passed.through.begin(), passed.through.end());
  }
  addThrough(record, barrier.queue, barrier.scopeEnds,
             [&](VkPipelineStageFlags2 stage) { return (elementaryStages(stage) & source) != 0; });
  return through_.size() > before ? Reach::throughWaits : Reach::no;
}

bool HazardTracker::makesAvailable(const Record& record, const TimedBarrier& barrier) const {
  return !barrier.absent && record.queue == barrier.queue && record.stages != 0 &&
         contains(barrier.barrier.from.stages, record.stages) &&
         containsAccess(barrier.barrier.from.access, record.written);
}

HazardTracker::Reach HazardTracker::available(const Record& record, uint32_t queue, uint32_t submission) {
  if (!record.write || (record.available >> queue & 1) != 0 || settled(record, submission)) return Reach::always;
  const std::size_t before = through_.size();
  addThrough(record, queue, submission, [](VkPipelineStageFlags2) { return true; });
  return through_.size() > before ? Reach::throughWaits : Reach::no;
}

/// Whether the touch comes after the record, and when it names an access, whether the record is visible to it.
HazardTracker::Reach HazardTracker::reached(const Record& record, const Use& use, const Touch& touch,
                                            std::span<const TimedBarrier> barriers) {
  through_.clear();
  if ((touch.access == 0 || record.byHost) && settled(record, use.submission)) return Reach::always;
  if (touch.access == 0 && touch.stages == kHost && order_.covers(order_.momentOf(use.submission), record.moment)) {
    return Reach::always;
  }
  for (const Passed& passed : record.passed) {
    if (passed.queue != use.queue || !contains(passed.stages, touch.stages)) continue;
    if (!containsAccess(passed.access, touch.access)) continue;
    if (passed.through.empty()) return Reach::always;
    through_.insert(through_.end(), passed.through.begin(), passed.through.end());
  }
  for (const TimedBarrier& barrier : barriers) {
    if (barrier.absent || barrier.writes() || barrier.queue != use.queue || barrier.step > use.step) continue;
    if (!contains(barrier.barrier.to.stages, touch.stages)) continue;
    if (!containsAccess(barrier.barrier.to.access, touch.access)) continue;
    if (touch.access != 0 && !makesAvailable(record, barrier)) {
      const std::size_t before = through_.size();
      const Reach reach = available(record, barrier.queue, barrier.takesEffect);
      through_.resize(before);
      if (reach == Reach::no) continue;
    }
    if (inFirstScope(record, barrier) == Reach::always) return Reach::always;
  }
  addThrough(record, use.queue, use.submission,
             [&](VkPipelineStageFlags2 stage) { return contains(stage, touch.stages); });
  return through_.empty() ? Reach::no : Reach::throughWaits;
}

bool HazardTracker::note(Reach reach, const Record& record, WaitMinimizer* needs) {
  if (reach == Reach::throughWaits && needs != nullptr) needs->needOneOf(record.moment, through_);
  return reach != Reach::no;
}

bool HazardTracker::respects(const Use& use, const Record& record, std::span<const TimedBarrier> barriers,
                             WaitMinimizer* needs) {
  if (!record.write && !use.writes) return true;
  for (uint32_t i = use.firstTouch; i < use.endTouch; ++i) {
    Touch touch{touches_[i].stages, 0};
    if (!note(reached(record, use, touch, barriers), record, needs)) return false;
    if (needs != nullptr) {
      if (settled(record, use.submission)) noteHost(record, use.submission, needs);
      if (touch.stages == kHost && order_.covers(order_.momentOf(use.submission), record.moment)) {
        needs->needOrder(record.moment, order_.momentOf(use.submission));
      }
    }
    if (!record.write) continue;
    VkAccessFlags2 access = touches_[i].access;
    if (record.seen) access = use.reads ? access & ~kWriteAccess : 0;
    bool visible = true;
    forEachBit(access, [&](VkAccessFlags2 bit) {
      touch.access = bit;
      visible = visible && note(reached(record, use, touch, barriers), record, needs);
    });
    if (!visible) return false;
  }
  if (std::any_of(barriers.begin(), barriers.end(), [&](const TimedBarrier& barrier) {
        return !barrier.writes() && barrier.queue == use.queue && makesAvailable(record, barrier);
      })) {
    return true;
  }
  through_.clear();
  return note(available(record, use.queue, use.submission), record, needs);
}

/// Whether a change of layout or owner waits for the record.
bool HazardTracker::canWrite(const TimedBarrier& barrier, const Record& record, WaitMinimizer* needs) {
  through_.clear();
  if (!note(inFirstScope(record, barrier), record, needs)) return false;
  if (needs != nullptr && settled(record, barrier.scopeEnds)) noteHost(record, barrier.scopeEnds, needs);
  if (barrier.acquires() || makesAvailable(record, barrier)) return true;
  through_.clear();
  return note(available(record, barrier.queue, barrier.takesEffect), record, needs);
}

bool HazardTracker::check(std::span<const TimedBarrier> barriers, WaitMinimizer* needs) {
  std::span<const Record> records = records_;
  Record written;
  for (const TimedBarrier& barrier : barriers) {
    if (!barrier.writes()) continue;
    for (const Record& record : records) {
      if (!canWrite(barrier, record, needs)) return false;
    }
    written = writtenBy(barrier);
    records = {&written, 1};
  }
  for (const Use& use : uses_) {
    for (const Record& record : records) {
      if (!respects(use, record, barriers, needs)) return false;
    }
  }
  return true;
}

void HazardTracker::dropEndStages(std::span<const TimedBarrier> barriers) {
  for (Record& record : records_) {
    if (record.endOf == kNone || record.passed.empty()) continue;
    EndStage& end = endStages_[record.endOf];
    if (end.known && end.needed) continue;
    std::vector<Passed> passed;
    std::swap(passed, record.passed);
    if (isSynchronized(barriers)) {
      end.dropped = true;
    } else {
      std::swap(passed, record.passed);
      end.needed = true;
    }
  }
}

bool HazardTracker::needsAnotherPass() {
  bool result = false;
  for (EndStage& end : endStages_) {
    result = result || (end.needed && end.dropped);
    end.dropped = false;
    end.known = true;
  }
  return result;
}

bool HazardTracker::isSynchronized(std::span<const TimedBarrier> barriers) {
  return check(barriers, nullptr);
}

void HazardTracker::finishEpoch(std::span<const TimedBarrier> barriers, WaitMinimizer& needs) {
  listAll_ = true;
  check(barriers, &needs);
  for (const TimedBarrier& barrier : barriers) {
    if (barrier.writes()) {
      records_.assign(1, writtenBy(barrier));
    } else {
      for (Record& record : records_) pass(record, barrier, needs);
    }
  }
  const bool writes = uses_.front().writes, reads = uses_.front().reads;
  if (writes) records_.clear();
  for (Record& record : records_) record.seen = record.seen || reads;
  for (const Use& use : uses_) {
    const std::size_t first = records_.size();
    addRecords(use, order_.momentOf(use.submission), records_);
    for (const TimedBarrier& barrier : barriers) {  // Those that a later use of the run needed.
      if (barrier.writes() || barrier.step <= use.step) continue;
      for (std::size_t i = first; i < records_.size(); ++i) pass(records_[i], barrier, needs);
    }
  }
  listAll_ = false;
}

/// Carries the record over a barrier, when it is in its first scope.
void HazardTracker::pass(Record& record, const TimedBarrier& barrier, WaitMinimizer& needs) {
  if (barrier.absent) return;
  through_.clear();
  const Reach reach = inFirstScope(record, barrier);
  if (reach == Reach::no) return;
  Passed passed{barrier.queue, barrier.barrier.to.stages, 0, {}};
  if (reach == Reach::throughWaits) passed.through = through_;
  if (makesAvailable(record, barrier)) record.available |= 1u << barrier.queue;
  through_.clear();
  const bool shows = record.write && barrier.barrier.to.access != 0;
  if (note(available(record, barrier.queue, barrier.takesEffect), record, shows ? &needs : nullptr)) {
    passed.access = barrier.barrier.to.access;
  }
  record.passed.push_back(std::move(passed));
}

}  // namespace lensgraph::rendergraph
