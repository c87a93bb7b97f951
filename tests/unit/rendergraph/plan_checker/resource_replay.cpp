// The life of one resource under a plan, moment by moment; see plan_checker.h for the model.
#include "plan_checker/resource_replay.h"

#include <algorithm>

namespace lensgraph::plan_checker {

using namespace rendergraph;

namespace {

constexpr uint32_t kNobody = UINT32_MAX;
// A pseudo-stage that is in the first scope of every barrier: of records that the host has waited for.
constexpr StageMask kSettled = 1u << 31;
constexpr AccessMask kEverything = kReads | kWrites;
constexpr uint32_t kHostIndex = kStageCount - 1;

void setVisible(Touches& touches, StageMask stages, AccessMask access) {
  for (uint32_t i = 0; i < kStageCount; ++i) {
    if ((stages >> i & 1) != 0) touches[i] |= access;
  }
}

/// Ordered before whatever follows on every queue, and visible to all of it.
void settle(Record& record, bool visible) {
  record.makeAvailable(Record::kEverywhere);
  for (StageMask& stages : record.ordered) stages |= kDeviceStages | kHostStage | kSettled;
  if (!visible) return;
  for (Touches& touches : record.visible) setVisible(touches, kDeviceStages | kHostStage, kEverything);
}

}  // namespace

void ResourceReplay::run(uint32_t frame, const std::vector<Record>& inherited, std::vector<Finding>* findings,
                         const Change& change) {
  findings_ = findings;
  failed_ = false;
  frame_ = frame;
  exclusive_ = !concurrent_ || change.exclusive;
  now_ = frame * order_.span();
  start(inherited);
  nextMilestone_ = 0;
  for (const Op& op : ops_) {
    passUntil(op.key);
    now_ = frame * order_.span() + op.key;
    apply(op, change);
    if (failed_ && findings == nullptr) return;
  }
  if (declared_.observable()) {
    passUntil(order_.span());
    now_ = (frame + 1) * order_.span() - 1;
    finish();
  }
}

void ResourceReplay::start(const std::vector<Record>& inherited) {
  subresources_.assign(count(), {});
  for (Subresource& subresource : subresources_) {
    subresource.records = inherited;
    if (declared_.created()) continue;
    subresource.hasContent = true;
    subresource.owner = familyOf(0);
    if (declared_.persistent()) {
      subresource.layout = restLayout();
      addRestRecord(subresource);
    } else {
      subresource.layout = declared_.isImage ? declared_.before.layout : VK_IMAGE_LAYOUT_UNDEFINED;
      subresource.hasContent = !declared_.isImage || subresource.layout != VK_IMAGE_LAYOUT_UNDEFINED;
      addHostRecords(subresource);
    }
    subresource.shouldHaveContent = subresource.hasContent;
    subresource.lastUsed = subresource.layout;
  }
}

VkImageLayout ResourceReplay::restLayout() const {
  if (!declared_.isImage) return VK_IMAGE_LAYOUT_UNDEFINED;
  return declared_.exported ? declared_.after.layout : VK_IMAGE_LAYOUT_GENERAL;
}

/// At rest everything later on queue 0 is ordered after the frame before, and sees it.
void ResourceReplay::addRestRecord(Subresource& subresource) const {
  Record rest{.write = true,
              .transition = true,
              .seen = true,
              .inherited = true,
              .available = Record::kEverywhere,
              .pass = kNone,
              .node = order_.nodeBefore(frame_),
              .time = now_};
  if (order_.frames() == 1) settle(rest, false);  // The host has waited.
  rest.ordered[0] |= kDeviceStages | kHostStage;
  setVisible(rest.visible[0], kDeviceStages | kHostStage, kEverything);
  rest.hostVisible = kEverything;
  rest.hostNode = rest.node;
  subresource.records.push_back(rest);
}

void ResourceReplay::addHostRecords(Subresource& subresource) const {
  const AccessMask access = accessMask(declared_.before.access);
  const StageMask stages = stageMask(declared_.before.stages);
  const bool write = (access & kWrites) != 0;
  const Record outside{
      .write = write, .pass = kNone, .node = order_.nodeBefore(frame_), .time = now_, .access = access};
  for (uint32_t i = 0; i < kStageCount; ++i) {
    if ((stages >> i & 1) == 0) continue;
    Record record = outside;
    record.stage = 1u << i;
    // What the host itself did is over, and known to the device, when a submission begins.
    if (record.stage == kHostStage) settle(record, true);
    subresource.records.push_back(record);
  }
  if (stages == 0 || write) return;
  // Whoever wrote it before has made it visible to the host's reads, and to nothing else as far as we know.
  Record content = outside;
  content.write = content.transition = content.seen = true;
  content.available = Record::kEverywhere;
  content.access = 0;
  content.ordered[0] = stages;
  setVisible(content.visible[0], stages, access);
  content.hostVisible = access;
  content.hostNode = content.node;
  subresource.records.push_back(content);
}

void ResourceReplay::passUntil(uint32_t key) {
  const std::vector<Wait>& milestones = order_.milestones();
  for (; nextMilestone_ < milestones.size() && milestones[nextMilestone_].key < key; ++nextMilestone_) {
    pass(milestones[nextMilestone_]);
  }
}

void ResourceReplay::pass(const Wait& milestone) {
  const uint32_t target = order_.node(frame_, milestone.target);
  const uint32_t queue = order_.queueOf(milestone.submission);
  const StageMask stages = stageMask(milestone.stages);
  for (Subresource& subresource : subresources_) {
    for (Record& record : subresource.records) {
      if (!order_.covers(target, record.node)) continue;
      if (!milestone.hostDone) {
        record.makeAvailable(1u << queue);
        record.ordered[queue] |= stages;
        if (record.write) setVisible(record.visible[queue], stages, kEverything);
      } else {
        settle(record, record.write && record.stage == kHostStage);
      }
    }
  }
}

void ResourceReplay::apply(const Op& op, const Change& change) {
  if (op.kind == Kind::use) return check(uses_[op.index], change);
  const Placed& placed = barriers_[op.index];
  const ImageBarrier* barrier = op.index == change.placed ? change.barrier : &placed.barrier;
  if (barrier == nullptr) return;
  if (op.kind == Kind::set) return setEvent(placed, *barrier, op.index);
  forEach(barrier->range, [&](uint32_t i) { applyBarrier(subresources_[i], placed, *barrier, op.index); });
}

bool ResourceReplay::inFirstScope(const Record& record, const Placed& placed, StageMask source) const {
  if (record.time >= now_) return false;  // Barriers of one batch are not ordered among each other.
  return (record.queue == placed.queue && (record.stage & source) != 0) ||
         (record.ordered[placed.queue] & (source | kSettled)) != 0;
}

void ResourceReplay::setEvent(const Placed& placed, const ImageBarrier& barrier, uint32_t index) {
  const StageMask source = stageMask(barrier.from.stages);
  const uint64_t bit = uint64_t{1} << (index % 64);
  forEach(barrier.range, [&](uint32_t i) {
    for (Record& record : subresources_[i].records) {
      if (!inFirstScope(record, placed, source)) continue;
      record.events |= bit;
      const bool covered = (record.access & kWrites & ~accessMask(barrier.from.access)) == 0;
      if ((record.stage & source) != 0 && covered) record.eventsWithAccess |= bit;
    }
  });
}

/// The second half of a barrier, for a record in its first scope.
void ResourceReplay::passOn(Record& record, const Placed& placed, const ImageBarrier& barrier) const {
  const StageMask target = stageMask(barrier.to.stages);
  record.ordered[placed.queue] |= target;
  if (!record.availableOn(placed.queue)) return;
  const AccessMask access = accessMask(barrier.to.access);
  setVisible(record.visible[placed.queue], target, access);
  if ((target & kHostStage) == 0) return;
  if (record.hostVisible == 0) record.hostNode = order_.node(frame_, placed.submission);
  record.hostVisible |= access;
}

void ResourceReplay::replaceRecords(Subresource& subresource, const Placed& placed, const ImageBarrier& barrier) {
  Record written{.write = true,
                 .transition = true,
                 .available = Record::kEverywhere,
                 .pass = barrier.to.pass,
                 .queue = placed.queue,
                 .node = order_.node(frame_, placed.submission),
                 .time = now_};
  passOn(written, placed, barrier);
  subresource.records = {written};
}

void ResourceReplay::acquire(Subresource& subresource, const Placed& placed, const ImageBarrier& barrier) {
  const ImageBarrier* released = subresource.released;
  if (released == nullptr || released->fromQueue != barrier.fromQueue || released->toQueue != barrier.toQueue ||
      released->oldLayout != barrier.oldLayout || released->newLayout != barrier.newLayout ||
      !(released->range == barrier.range)) {
    return fail(Hazard::ownership, placed.step, "it is acquired without a matching release");
  }
  for (const Record& record : subresource.records) {
    if (!inFirstScope(record, placed, stageMask(barrier.from.stages))) {
      return fail(Hazard::ownership, placed.step, "the acquire does not wait for the release");
    }
  }
  subresource.released = nullptr;
  subresource.owner = familyOf(placed.queue);
  subresource.layout = barrier.newLayout;
  replaceRecords(subresource, placed, barrier);
}

/// Whether the queue may change the subresource, or takes it over because its content is dropped.
bool ResourceReplay::changeOwner(Subresource& subresource, const Placed& placed, const ImageBarrier& barrier) {
  const uint32_t family = familyOf(placed.queue);
  const bool dropping = declared_.isImage && barrier.oldLayout == VK_IMAGE_LAYOUT_UNDEFINED;
  if (!dropping && (subresource.released != nullptr || (subresource.owner != family && subresource.owner != kNobody))) {
    fail(Hazard::ownership, placed.step, "the barrier is on a queue that does not own it");
    return false;
  }
  if (dropping) subresource.released = nullptr;
  subresource.owner = family;
  return true;
}

void ResourceReplay::applyBarrier(Subresource& subresource, const Placed& placed, const ImageBarrier& barrier,
                                  uint32_t index) {
  const bool transfer = barrier.fromQueue != barrier.toQueue;
  if (transfer && !exclusive_) return fail(Hazard::ownership, placed.step, "a concurrent resource changes its owner");
  if (transfer && barrier.toQueue == placed.queue) return acquire(subresource, placed, barrier);
  const bool dropping = barrier.oldLayout == VK_IMAGE_LAYOUT_UNDEFINED;
  if (declared_.isImage && !dropping && barrier.oldLayout != subresource.layout) {
    fail(Hazard::layout, placed.step, "the barrier's old layout is not the current one");
  }
  const bool transition = transfer || (declared_.isImage && barrier.oldLayout != barrier.newLayout);
  if (exclusive_ && transition && !changeOwner(subresource, placed, barrier)) return;
  const StageMask source = stageMask(barrier.from.stages);
  const uint64_t bit = uint64_t{1} << (index % 64);
  for (Record& record : subresource.records) {
    const bool event = placed.setKey != 0;
    const bool waited = event ? (record.events & bit) != 0 : inFirstScope(record, placed, source);
    const bool covered = (record.access & kWrites & ~accessMask(barrier.from.access)) == 0;
    const bool makesAvailable = event ? (record.eventsWithAccess & bit) != 0
                                      : record.queue == placed.queue && (record.stage & source) != 0 && covered;
    if (waited && makesAvailable) record.makeAvailable(1u << placed.queue);
    if (waited) passOn(record, placed, barrier);
    record.events &= ~bit;
    record.eventsWithAccess &= ~bit;
    if (!transition || (waited && (!record.write || record.availableOn(placed.queue)))) continue;
    fail(record.inherited ? Hazard::alias : Hazard::layout, placed.step, "a layout transition does not wait for ",
         record);
  }
  if (!transition) return;
  subresource.touched = true;
  if (dropping && declared_.isImage) subresource.hasContent = false;
  replaceRecords(subresource, placed, barrier);
  if (!transfer) {
    subresource.layout = barrier.newLayout;
    return;
  }
  subresource.released = &barrier;
}

void ResourceReplay::check(const StepUse& use, const Change& change) {
  const auto loadOf = [&](const Operation& operation) {
    const bool changed = change.attachment == operation.attachment && change.load;
    return changed ? VK_ATTACHMENT_LOAD_OP_DONT_CARE : setting_.plan.attachments[operation.attachment].load;
  };
  const auto storeOf = [&](const Operation& operation) {
    const bool changed = change.attachment == operation.attachment && !change.load;
    return changed ? VK_ATTACHMENT_STORE_OP_DONT_CARE : setting_.plan.attachments[operation.attachment].store;
  };
  for (const Operation& operation : use.operations) {
    if (!operation.begins) continue;
    if (operation.needsContent && loadOf(operation) != VK_ATTACHMENT_LOAD_OP_LOAD) {
      fail(Hazard::lostContent, use.step, "its content is needed and not loaded");
    }
    if (operation.clears && loadOf(operation) != VK_ATTACHMENT_LOAD_OP_CLEAR) {
      fail(Hazard::lostContent, use.step, "it is not cleared as declared");
    }
  }
  for (uint32_t i = 0; i < subresources_.size(); ++i) {
    if (use.uses[i].stages != 0) check(subresources_[i], use.uses[i], use);
  }
  for (const Operation& operation : use.operations) {
    if (!operation.ends || storeOf(operation) == VK_ATTACHMENT_STORE_OP_STORE) continue;
    // Written and not stored. NONE keeps what was not written.
    forEach(operation.range, [&](uint32_t i) {
      const bool kept = storeOf(operation) == VK_ATTACHMENT_STORE_OP_NONE && !use.uses[i].writes;
      subresources_[i].hasContent = subresources_[i].hasContent && kept;
    });
  }
}

void ResourceReplay::check(Subresource& subresource, const Use& use, const StepUse& at) {
  subresource.used = subresource.touched = true;
  subresource.lastUsed = use.layout;
  if (declared_.isImage && subresource.layout != use.layout) fail(Hazard::layout, at.step, "wrong layout");
  if (exclusive_ && use.stages != kHostStage) checkOwner(subresource, use, at);
  if (use.reads && !subresource.hasContent) fail(Hazard::lostContent, at.step, "its content was dropped");
  const uint32_t node = order_.node(frame_, at.submission);
  for (Record& record : subresource.records) checkAgainst(record, use, at, node);
  leave(subresource, use, at, setting_.plan.passes[at.step].pass);
}

void ResourceReplay::checkOwner(Subresource& subresource, const Use& use, const StepUse& at) {
  const uint32_t family = familyOf(at.queue);
  const bool takenOver = !declared_.isImage && !use.reads;  // Nobody needs what was there.
  if (takenOver || (subresource.owner == kNobody && subresource.released == nullptr)) {
    subresource.released = nullptr;
    subresource.owner = family;
  }
  if (subresource.released == nullptr && subresource.owner == family) return;
  fail(Hazard::ownership, at.step, "the queue's family does not own it");
}

AccessMask ResourceReplay::visibleTo(const Record& record, uint32_t stage, const StepUse& at, uint32_t node) const {
  const AccessMask visible = record.visible[at.queue][stage];
  if (stage != kHostIndex || record.hostVisible == 0) return visible;
  return visible | (order_.covers(node, record.hostNode) ? record.hostVisible : 0);
}

void ResourceReplay::checkAgainst(Record& record, const Use& use, const StepUse& at, uint32_t node) {
  if (!record.write && !use.writes) return;
  // Within a rendering, attachments are accessed in rasterization order.
  if (record.attachment && use.onlyAttachment && record.time / order_.span() == frame_ &&
      at.step < setting_.plan.passes.size() && record.rendering == order_.renderingOf(at.step)) {
    return;
  }
  const Hazard hazard = record.inherited ? Hazard::alias
                        : !record.write  ? Hazard::writeAfterRead
                        : use.reads      ? Hazard::readAfterWrite
                                         : Hazard::writeAfterWrite;
  StageMask unordered = use.stages & ~record.ordered[at.queue];
  if (order_.covers(node, record.node)) unordered &= ~kHostStage;  // The host waits.
  if (unordered != 0) return fail(hazard, at.step, "it does not wait for ", record);
  if (!record.write) return;
  if (!record.availableOn(at.queue)) fail(hazard, at.step, "not available is what was written by ", record);
  for (uint32_t i = 0; i < kStageCount; ++i) {
    AccessMask needed = use.touches[i];
    if (record.seen) needed = use.reads ? needed & kReads : 0;
    if ((needed & ~visibleTo(record, i, at, node)) != 0) {
      return fail(hazard, at.step, "not visible is what was written by ", record);
    }
  }
  record.seen = record.seen || use.reads;
}

/// The records of a use; they replace all earlier ones when it writes.
void ResourceReplay::leave(Subresource& subresource, const Use& use, const StepUse& at, uint32_t pass) {
  if (use.writes) {
    subresource.records.clear();
    subresource.hasContent = subresource.shouldHaveContent = true;
  }
  Record record{.write = use.writes,
                .attachment = use.onlyAttachment && at.step < setting_.plan.passes.size(),
                .pass = pass,
                .queue = at.queue,
                .node = order_.node(frame_, at.submission),
                .time = now_};
  if (record.attachment) record.rendering = order_.renderingOf(at.step);
  for (uint32_t i = 0; i < kStageCount; ++i) {
    if ((use.stages >> i & 1) == 0) continue;
    record.stage = 1u << i;
    record.access = use.touches[i];
    subresource.records.push_back(record);
  }
}

void ResourceReplay::finish() {
  for (Subresource& subresource : subresources_) {
    if (!declared_.persistent() || subresource.used || subresource.touched) finish(subresource);
  }
}

void ResourceReplay::finish(Subresource& subresource) {
  const auto end = static_cast<uint32_t>(setting_.plan.passes.size());
  const auto last = static_cast<uint32_t>(setting_.plan.submissions.size() - 1);
  AccessState after = declared_.after;
  if (declared_.persistent()) {
    after = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
             restLayout()};
  }
  if (subresource.shouldHaveContent && !subresource.hasContent) {
    fail(Hazard::lostContent, end, "its content was dropped before the host sees it");
  }
  if (after.layout == VK_IMAGE_LAYOUT_UNDEFINED) after.layout = subresource.lastUsed;
  if (declared_.isImage && subresource.layout != after.layout) {
    fail(Hazard::layout, end, "it is not left in the layout that the host asked for");
  }
  const bool owned = subresource.owner == familyOf(0) || subresource.owner == kNobody;
  if (exclusive_ && (subresource.released != nullptr || !owned)) {
    fail(Hazard::ownership, end, "the first queue's family does not own it");
  }
  if (after.stages == 0) return;
  Use use{.layout = subresource.layout, .reads = true, .writes = (accessMask(after.access) & kWrites) != 0};
  use.onlyAttachment = false;
  use.add(stageMask(after.stages), accessMask(after.access));
  const StepUse at{.step = end, .queue = 0, .submission = last};
  for (Record& record : subresource.records) checkAgainst(record, use, at, order_.node(frame_, last));
  // Before the next frame the host's device has used it in this way. The host itself is done when it submits that.
  use.stages &= ~kHostStage;
  if (declared_.created() && use.stages != 0) leave(subresource, use, at, kNone);
}

ResourceReplay::Left ResourceReplay::remaining() {
  Left left{.now = records(), .atFrameEnd = {}};
  if (order_.frames() == 1) return left;
  passUntil(order_.span());
  left.atFrameEnd = records();
  return left;
}

std::vector<Record> ResourceReplay::records() const {
  std::vector<Record> result;
  for (const Subresource& subresource : subresources_) {
    if (!subresource.touched) continue;
    for (Record record : subresource.records) {
      record.inherited = true;
      if (std::find(result.begin(), result.end(), record) == result.end()) result.push_back(record);
    }
  }
  return result;
}

std::string ResourceReplay::nameOfPass(uint32_t pass) const {
  const auto& passes = setting_.declaration.passes;
  return pass < passes.size() ? "'" + std::string(passes[pass].name) + "'" : "the host";
}

void ResourceReplay::fail(Hazard hazard, uint32_t step, const char* why, const Record& record) {
  failed_ = true;
  if (findings_ != nullptr) fail(hazard, step, (why + nameOfPass(record.pass)).c_str());
}

void ResourceReplay::fail(Hazard hazard, uint32_t step, const char* why) {
  failed_ = true;
  if (findings_ == nullptr) return;
  const bool inside = step < setting_.plan.passes.size();
  std::string text = inside ? nameOfPass(setting_.plan.passes[step].pass) : "after the graph";
  text += ", '" + std::string(declared_.name) + "'" + (frame_ > 0 ? " of the next frame: " : ": ") + why;
  findings_->push_back({hazard, std::move(text)});
}

}  // namespace lensgraph::plan_checker
