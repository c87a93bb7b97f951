// See the header.
#include "plan_checker/plan_replay.h"

#include <algorithm>

namespace lensgraph::plan_checker {

using namespace rendergraph;

namespace {

struct OwnedBytes {
  uint32_t heap;
  VkDeviceSize begin, end;
  uint32_t frame, resource;
};

}  // namespace

PlanReplay::PlanReplay(const Setting& setting)
    : setting_(setting), order_(setting.declaration, setting.plan, setting.options.overlappingFrames ? 2 : 1) {
  const Declaration& declaration = setting.declaration;
  std::vector<uint32_t> stepOfPass(declaration.passes.size(), UINT32_MAX);
  for (uint32_t step = 0; step < setting.plan.passes.size(); ++step) stepOfPass[setting.plan.passes[step].pass] = step;
  std::vector<std::vector<uint32_t>> accesses(declaration.resources.size());
  for (uint32_t i = 0; i < declaration.accesses.size(); ++i) accesses[declaration.accesses[i].resource].push_back(i);
  std::vector<std::vector<Placed>> barriers = placeBarriers();
  replays_.reserve(declaration.resources.size());
  for (uint32_t i = 0; i < declaration.resources.size(); ++i) {
    replays_.emplace_back(setting, order_, i, std::move(barriers[i]), accesses[i], stepOfPass);
    sequence_.push_back(i);
  }
  const auto startOf = [&](uint32_t i) { return replays_[i].used() ? replays_[i].firstStep() : 0u; };
  std::stable_sort(sequence_.begin(), sequence_.end(), [&](uint32_t a, uint32_t b) { return startOf(a) < startOf(b); });
  findPredecessors();
}

std::vector<std::vector<Placed>> PlanReplay::placeBarriers() const {
  const Plan& plan = setting_.plan;
  std::vector<std::vector<Placed>> result(setting_.declaration.resources.size());
  const auto add = [&](const Placed& place, const BarrierBatch& batch) {
    for (const ImageBarrier& barrier : plan.imagesOf(batch)) {
      result[barrier.resource].push_back(place);
      result[barrier.resource].back().barrier = barrier;
    }
    for (const BufferBarrier& barrier : plan.buffersOf(batch)) {
      ImageBarrier same;
      same.resource = barrier.resource;
      same.range = {0, 1, 0, 1, 0};
      same.from = barrier.from;
      same.to = barrier.to;
      same.fromQueue = barrier.fromQueue;
      same.toQueue = barrier.toQueue;
      same.reason = barrier.reason;
      result[barrier.resource].push_back(place);
      result[barrier.resource].back().barrier = same;
    }
  };
  for (uint32_t step = 0; step < plan.passes.size(); ++step) {
    const PlannedPass& pass = plan.passes[step];
    Placed place{.step = step, .queue = pass.queue, .submission = order_.submissionOf(step)};
    place.key = order_.keysOf(step).eventWait;
    for (const PlannedEvent& event : plan.waitsOf(pass)) {
      place.setKey = order_.keysOf(event.setAfter).eventSet;
      add(place, event.barriers);
      ++place.key;
    }
    place.setKey = 0;
    place.key = order_.keysOf(step).before;
    add(place, pass.before);
  }
  const auto end = static_cast<uint32_t>(plan.passes.size());
  for (uint32_t i = 0; i < plan.submissions.size(); ++i) {
    const PlannedSubmission& submission = plan.submissions[i];
    const uint32_t next = submission.steps.count > 0 ? submission.steps.first + submission.steps.count : end;
    add({.step = next, .key = order_.keyAtEnd(i), .queue = submission.queue, .submission = i}, submission.atEnd);
  }
  return result;
}

/// Which resources had bytes of each one's memory before it. What is not used throughout leaves its predecessors
/// where they are: nobody knows where in the memory the unused part lies.
void PlanReplay::findPredecessors() {
  std::vector<const Placement*> placements(replays_.size(), nullptr);
  for (const Placement& placement : setting_.plan.placements) placements[placement.resource] = &placement;
  before_.assign(order_.frames(), std::vector<std::vector<Occupant>>(replays_.size()));
  std::vector<OwnedBytes> memory, left;
  for (uint32_t frame = 0; frame < order_.frames(); ++frame) {
    for (uint32_t i : sequence_) {
      if (placements[i] == nullptr || !replays_[i].used()) continue;
      const Placement& p = *placements[i];
      const VkDeviceSize begin = p.offset, end = p.offset + p.size;
      left.clear();
      for (const OwnedBytes& owned : memory) {
        if (owned.heap != p.heap || owned.end <= begin || end <= owned.begin) {
          left.push_back(owned);
          continue;
        }
        const DeclaredResource& old = setting_.declaration.resources[owned.resource];
        const bool living = old.exported || replays_[owned.resource].lastStep() >= replays_[i].firstStep();
        if (owned.frame == frame && living) {
          overlaps_.push_back({Hazard::alias, "'" + std::string(setting_.declaration.resources[i].name) +
                                                  "' overlaps living '" + std::string(old.name) + "'"});
        }
        before_[frame][i].push_back({owned.frame, owned.resource});
        if (!replays_[i].usedThroughout()) {
          left.push_back(owned);
          continue;
        }
        if (owned.begin < begin) left.push_back({owned.heap, owned.begin, begin, owned.frame, owned.resource});
        if (end < owned.end) left.push_back({owned.heap, end, owned.end, owned.frame, owned.resource});
      }
      left.push_back({p.heap, begin, end, frame, i});
      std::swap(memory, left);
    }
  }
}

PlanReplay::RecordTable PlanReplay::nothingLeft() const {
  return RecordTable(order_.frames(), std::vector<ResourceReplay::Left>(replays_.size()));
}

std::vector<Record> PlanReplay::inherited(uint32_t frame, uint32_t resource, const RecordTable& remaining) const {
  std::vector<Record> result;
  for (const Occupant& occupant : before_[frame][resource]) {
    const ResourceReplay::Left& left = remaining[occupant.frame][occupant.resource];
    for (const Record& record : occupant.frame == frame ? left.now : left.atFrameEnd) {
      if (std::find(result.begin(), result.end(), record) == result.end()) result.push_back(record);
    }
  }
  return result;
}

std::vector<Finding> PlanReplay::run() {
  std::vector<Finding> findings = overlaps_;
  remaining_ = nothingLeft();
  inherited_.assign(order_.frames(), std::vector<std::vector<Record>>(replays_.size()));
  for (uint32_t frame = 0; frame < order_.frames(); ++frame) {
    for (uint32_t i : sequence_) {
      inherited_[frame][i] = inherited(frame, i, remaining_);
      replays_[i].run(frame, inherited_[frame][i], &findings);
      remaining_[frame][i] = replays_[i].remaining();
    }
  }
  return findings;
}

bool PlanReplay::holds(uint32_t resource, const Change& change) {
  replays_[resource].run(0, inherited_[0][resource], nullptr, change);
  if (replays_[resource].failed()) return false;
  if (order_.frames() == 1) return true;
  // What it leaves now concerns those who take over its memory in the next frame, itself among them.
  ResourceReplay::Left left = replays_[resource].remaining();
  std::swap(left, remaining_[0][resource]);
  bool holding = true;
  for (uint32_t i = 0; i < replays_.size() && holding; ++i) {
    const std::vector<Occupant>& before = before_[1][i];
    const bool heir = std::any_of(before.begin(), before.end(), [&](const Occupant& occupant) {
      return occupant.frame == 0 && occupant.resource == resource;
    });
    if (i != resource && !heir) continue;
    replays_[i].run(1, inherited(1, i, remaining_), nullptr, i == resource ? change : Change{});
    holding = !replays_[i].failed();
  }
  std::swap(left, remaining_[0][resource]);
  return holding;
}

bool PlanReplay::holds(const std::vector<Wait>& waits, uint32_t from) {
  const std::vector<Wait> before = order_.semaphores();
  order_.connect(waits);
  RecordTable remaining = nothingLeft();
  bool holding = order_.edgesHold();
  for (uint32_t frame = 0; frame < order_.frames() && holding; ++frame) {
    for (uint32_t i : sequence_) {
      const bool past = order_.frames() == 1 && !setting_.declaration.resources[i].observable() &&
                        replays_[i].lastKey() < order_.keyBegin(from);
      if (frame == 0 && past) {
        remaining[0][i] = remaining_[0][i];
        continue;
      }
      replays_[i].run(frame, inherited(frame, i, remaining), nullptr);
      holding = !replays_[i].failed();
      if (!holding) break;
      remaining[frame][i] = replays_[i].remaining();
    }
  }
  order_.connect(before);
  return holding;
}

}  // namespace lensgraph::plan_checker
