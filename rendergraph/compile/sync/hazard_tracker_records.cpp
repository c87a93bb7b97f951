// The records that uses leave: those of the cell itself, of what was before the graph, and of who had the memory
// before.
#include <algorithm>

#include "rendergraph/compile/flow/cells.h"
#include "rendergraph/compile/flow/stage_masks.h"
#include "rendergraph/compile/schedule/schedule.h"
#include "rendergraph/compile/schedule/submissions.h"
#include "rendergraph/compile/sync/hazard_tracker.h"
#include "rendergraph/declare/access_table.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

constexpr VkPipelineStageFlags2 kHost = VK_PIPELINE_STAGE_2_HOST_BIT;
constexpr VkPipelineStageFlags2 kAll = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
constexpr VkAccessFlags2 kEveryAccess = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;

}  // namespace

void HazardTracker::startCell(uint32_t resource, uint32_t cell, std::span<const MemoryPredecessor> predecessors) {
  const DeclaredResource& declared = in_.declaration.resources[resource];
  records_.clear();
  if (!declared.created()) addOutside(declared);
  for (const MemoryPredecessor& predecessor : predecessors) {
    for (const Record& left : leftBy(predecessor.resource)) {
      Record record = left;
      if (predecessor.frameBefore) {
        record.moment = order_.inFrameBefore(left.moment);
      }
      const bool known = std::find(records_.begin(), records_.end(), record) != records_.end();
      if (!known) records_.push_back(std::move(record));
    }
  }
  resource_ = resource;
  cell_ = cell;
}

void HazardTracker::addOutside(const DeclaredResource& resource) {
  if (resource.persistent()) {  // At rest on queue 0, where everything comes after it and sees it.
    Record rest{.moment = order_.beforeGraph(),
                .write = true,
                .seen = true,
                .settled = !in_.options.overlappingFrames,
                .available = kOnEveryQueue};
    rest.passed.push_back({0, kAll | kHost, kEveryAccess, {}});
    records_.push_back(std::move(rest));
    return;
  }
  const AccessState& before = resource.before;
  const bool write = writesMemory(before.access);
  forEachBit(before.stages, [&](VkPipelineStageFlags2 stage) {
    Record record{.moment = order_.beforeGraph(), .stages = elementaryStages(stage), .write = write};
    record.written = before.access & kWriteAccess;
    record.settled = stage == kHost;  // Before it submits.
    record.byHost = record.settled && write;
    records_.push_back(std::move(record));
  });
  if (before.stages == 0 || write) return;
  // What the host reads has been made visible to its reads, and to nothing else as far as we know.
  Record content{.moment = order_.beforeGraph(), .write = true, .seen = true, .available = kOnEveryQueue};
  content.passed.push_back({0, before.stages, before.access, {}});
  records_.push_back(std::move(content));
}

const std::vector<HazardTracker::Record>& HazardTracker::leftBy(uint32_t resource) {
  if (leftKnown_[resource] == 0) {
    leftKnown_[resource] = 1;
    for (uint32_t cell : in_.cells.of(resource)) addLeft(resource, cell, left_[resource]);
  }
  return left_[resource];
}

/// The last epoch, and what is done for the host after the graph: whatever was before comes before these.
void HazardTracker::addLeft(uint32_t resource, uint32_t cell, std::vector<Record>& records) {
  const DeclaredResource& declared = in_.declaration.resources[resource];
  const std::span<const CellUse> uses = in_.cellUses.of(cell);
  const uint32_t steps = in_.schedule.steps();
  const auto after = useAfterGraph(declared, uses, VK_IMAGE_LAYOUT_UNDEFINED, steps, in_.options.overlappingFrames);
  if (uses.empty() && !after) return;
  const Moment end = order_.momentOf(static_cast<uint32_t>(plan_.submissions.size() - 1));
  const VkPipelineStageFlags2 asked = declared.exported ? declared.after.stages & ~kHost : 0;
  const bool newLayout =
      after && declared.isImage && after->layout != (uses.empty() ? VK_IMAGE_LAYOUT_UNDEFINED : uses.back().layout);
  const bool newOwner = after && !uses.empty() && !in_.sharing.empty() && hasOwner(in_.sharing[resource]) &&
                        in_.queues[uses.back().queue].family != in_.queues[0].family;
  std::vector<Record> added;
  if (newLayout || newOwner) {
    Record changed{.moment = end, .write = true, .seen = declared.after.stages != 0, .available = kOnEveryQueue};
    changed.passed.push_back({0, after->stages, after->access, {}});
    if (asked == 0) {
      changed.endOf = resource;
      endStages_[resource].needed = false;  // As long as nobody needs it.
    }
    added.push_back(std::move(changed));
  } else if (!uses.empty() && (asked == 0 || (!uses.back().writes && !after->writes))) {
    resource_ = resource;
    cell_ = cell;
    for (const CellUse& use : lastEpochOf(uses)) {
      uses_.clear();
      touches_.clear();
      addUse(use);
      addRecords(uses_.back(), order_.momentOf(uses_.back().submission), added);
    }
    if (declared.exported && declared.after.stages != 0) {  // To the host alone.
      for (Record& record : added) {
        record.seen = true;
        record.available |= 1;
      }
    }
  }
  forEachBit(asked, [&](VkPipelineStageFlags2 stage) {
    Record record{.moment = end, .stages = elementaryStages(stage), .write = writesMemory(declared.after.access)};
    record.written = declared.after.access & kWriteAccess;
    added.push_back(std::move(record));
  });
  for (Record& record : added) {
    const bool known = std::find(records.begin(), records.end(), record) != records.end();
    if (!known) records.push_back(std::move(record));
  }
}

void HazardTracker::startEpoch(const Epoch& epoch) {
  uses_.clear();
  touches_.clear();
  for (const CellUse& use : epoch.uses) addUse(use);
}

void HazardTracker::addUse(const CellUse& use) {
  const uint32_t steps = in_.schedule.steps();
  const DeclaredResource& declared = in_.declaration.resources[resource_];
  const auto first = touches_.size();
  const bool after = use.step >= steps;
  if (after) {
    const VkPipelineStageFlags2 asked = declared.persistent() ? use.stages : declared.after.stages;
    addTouch(first, use.stages & asked, use.access);
  } else {
    for (uint32_t step = use.step; step <= in_.schedule.unitLast[use.step]; ++step) {
      const uint32_t pass = in_.schedule.order[step];
      for (const DeclaredAccess& access : in_.declaration.accessesOfPass(pass)) {
        in_.cells.forEach(in_.declaration.numberOf(access), [&](uint32_t cell) {
          if (cell != cell_) return;
          const bool inside = use.pass != pass && access.role != AttachmentRole::none;
          addTouch(first, access.stages, inside ? access.access & kWriteAccess : access.access);
        });
      }
    }
  }
  uses_.push_back(
      {.queue = use.queue,
       .step = use.step,
       .submission = after ? static_cast<uint32_t>(plan_.submissions.size() - 1) : in_.submissions.of[use.step],
       .reads = use.needsContent || !use.writes,
       .writes = use.writes,
       .firstTouch = static_cast<uint32_t>(first),
       .endTouch = static_cast<uint32_t>(touches_.size())});
}

void HazardTracker::addTouch(std::size_t first, VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
  forEachBit(stages, [&](VkPipelineStageFlags2 stage) {
    const VkPipelineStageFlags2 elementary = elementaryStages(stage);
    for (std::size_t i = first; i < touches_.size(); ++i) {
      if (touches_[i].stages != elementary) continue;
      touches_[i].access |= access;
      return;
    }
    touches_.push_back({elementary, access});
  });
}

void HazardTracker::addRecords(const Use& use, Moment moment, std::vector<Record>& records) const {
  for (uint32_t i = use.firstTouch; i < use.endTouch; ++i) {
    Record record{.moment = moment, .queue = use.queue, .stages = touches_[i].stages, .write = use.writes};
    if (use.writes) record.written = touches_[i].access & kWriteAccess;
    record.byHost = use.writes && touches_[i].stages == kHost;
    records.push_back(std::move(record));
  }
}

}  // namespace lensgraph::rendergraph
