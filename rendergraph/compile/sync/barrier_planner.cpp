// For every cell, visits its uses in execution order and adds the barriers between conflicting ones.
//
// The uses of a cell fall into epochs: one write, or a run of reads in one layout. Between two epochs stands exactly
// one barrier, placed before the first pass of the later epoch, and it serves all of that epoch: a run of reads by
// different stages waits once. Inside an epoch nothing is needed. Rules (Vulkan 1.3, 7.1 and 7.4):
//   read after write   the write is made available and visible to every read of the run;
//   write after read   execution only: the reads are waited for, no access flags. Whatever was written before the
//                      reads is available already, because the reads' own barrier made it so;
//   write after write  both;
//   layout             the transition itself writes, so the later epoch's accesses are all in its second scope;
//                      content that the later epoch replaces is dropped by naming UNDEFINED as old layout;
//   alias              the first use of each cell waits for the last epochs of all previous predecessors of the memory,
//                      with overlapping frames also for those of the frame before.
//
// The layout in which a frame leaves what is kept across frames is made visible to everything by the barrier at its
// end; with overlapping frames, a change of that layout chains to it through ALL_COMMANDS.
//
// Where a plan has several submissions, barriers lose in the end what other waits see to (barrier_trimming.h).
//
// Every barrier names its resource, and none is left out because a barrier of another resource happens to order the
// same stages: layered validation reasons per resource, and within a batch the extra entry waits for nothing new.
#include "rendergraph/compile/sync/barrier_planner.h"

#include "rendergraph/compile/sync/plan_barriers.h"
#include "rendergraph/compile/sync/range_merging.h"
#include "rendergraph/declare/access_table.h"

namespace lensgraph::rendergraph {

namespace {

/// What an epoch leaves for the next one to wait for.
AccessPoint scopeAfter(const Epoch& epoch) {
  return {.pass = epoch.uses.back().lastPass,
          .stages = epoch.stages,
          .access = epoch.writes() ? epoch.access & kWriteAccess : 0};
}

/// What the host writes before a submission is visible to all of it without a barrier (Vulkan 1.3, 7.9), and to the
/// host itself.
void forgetHostWrite(CellState& state) {
  if (!state.wrote || state.last.stages != VK_PIPELINE_STAGE_2_HOST_BIT) return;
  state.last.stages = state.last.access = 0;
  state.wrote = false;
  state.visible = Visibility::toEverything();
}

BarrierReason reasonFor(const CellState& state, const Epoch& epoch) {
  if (state.alias) return BarrierReason::alias;
  if (state.last.stages == 0) return BarrierReason::layout;
  if (state.wrote) return epoch.needsContent() ? BarrierReason::readAfterWrite : BarrierReason::writeAfterWrite;
  return epoch.writes() ? BarrierReason::writeAfterRead : BarrierReason::layout;
}

}  // namespace

void BarrierPlanner::run() {
  findPredecessors();
  all_.reserve(in_.declaration.accesses.size());
  // On one queue, each barrier is needed as it is found.
  if (plan_.submissions.size() > 1) trimming_.emplace(in_, plan_);
  do {
    all_.clear();
    for (uint32_t resource = 0; resource < in_.declaration.resources.size(); ++resource) planResource(resource);
  } while (trimming_ && trimming_->again());
  if (trimming_) {
    trimming_->trimEnds(all_);
    trimming_->trimWaits(plan_);
  }
  batchBarriers(in_.declaration, in_.options, in_.schedule, in_.queues, all_, plan_);
}

void BarrierPlanner::findPredecessors() {
  const std::size_t count = in_.declaration.resources.size();
  std::vector<uint8_t> fullyUsed(count, 0);
  finalScopes_.resize(count * in_.schedule.queues);
  finalSteps_.resize(count, 0);
  changedAtEnd_.resize(count, 0);
  for (const Placement& placement : plan_.placements) {
    bool full = true;
    for (uint32_t cell : in_.cells.of(placement.resource)) {
      full = !in_.cellUses.of(cell).empty() && full;
      noteFinalScopes(placement.resource, cell);
    }
    fullyUsed[placement.resource] = full;
  }
  predecessors_ = MemoryPredecessors(plan_.placements, count, fullyUsed, in_.options.overlappingFrames);
}

void BarrierPlanner::noteFinalScopes(uint32_t resource, uint32_t cell) {
  const std::span<const CellUse> uses = in_.cellUses.of(cell);
  if (uses.empty()) return noteUnused(resource);
  AccessPoint* scopes = &finalScopes_[static_cast<std::size_t>(resource) * in_.schedule.queues];
  finalSteps_[resource] = std::max(finalSteps_[resource], in_.schedule.unitLast[uses.back().step]);
  const DeclaredResource& declared = in_.declaration.resources[resource];
  if (declared.exported && in_.options.overlappingFrames) {
    const bool changed = uses.back().queue != 0 || (declared.isImage && declared.after.layout != uses.back().layout);
    const bool seen = (declared.after.access & ~kWriteAccess) != 0;  // By a read, which later writes only come after.
    if (changed && !seen) changedAtEnd_[resource] = 1;
    const bool owned = !in_.sharing.empty() && hasOwner(in_.sharing[resource]);
    if (noteExported(declared, uses, owned, scopes[0])) return;
  }
  const bool forHost = declared.exported && (declared.after.stages & VK_PIPELINE_STAGE_2_HOST_BIT) != 0;
  for (const CellUse& use : lastEpochOf(uses)) {
    AccessPoint& scope = scopes[use.queue];
    scope.pass = use.lastPass;
    scope.stages |= use.stages;
    // A barrier to the host has made it available.
    if (use.writes && !forHost) scope.access |= use.access & kWriteAccess;
  }
}

/// A part of an exported image that no pass uses changes its layout all the same.
void BarrierPlanner::noteUnused(uint32_t resource) {
  const DeclaredResource& declared = in_.declaration.resources[resource];
  if (!declared.exported || !declared.isImage || !in_.options.overlappingFrames) return;
  const VkPipelineStageFlags2 after = declared.after.stages & ~VK_PIPELINE_STAGE_2_HOST_BIT;
  finalScopes_[static_cast<std::size_t>(resource) * in_.schedule.queues].stages |= after != 0 ? after : kChainStage;
}

/// What the host submitted may still be at an exported resource when the next frame begins; the host itself is done
/// by then. Returns whether waiting for that is waiting for the graph's own uses as well.
bool BarrierPlanner::noteExported(const DeclaredResource& declared, std::span<const CellUse> uses, bool owned,
                                  AccessPoint& scope) const {
  const bool newLayout = declared.isImage && declared.after.layout != uses.back().layout;
  const VkPipelineStageFlags2 after = declared.after.stages & ~VK_PIPELINE_STAGE_2_HOST_BIT;
  // Reads on another queue go on meanwhile, unless queue 0 has to take over.
  const bool all = after == 0 && (newLayout || (uses.back().queue != 0 && (uses.back().writes || owned)));
  scope.pass = kNone;
  scope.stages |= all ? kChainStage : after;
  if (after != 0) scope.access |= declared.after.access & kWriteAccess;
  return all || (after != 0 && (newLayout || uses.back().writes || writesMemory(declared.after.access)));
}

CellState BarrierPlanner::stateAfterPredecessors(uint32_t resource, uint32_t queue) const {
  CellState state;
  bool elsewhere = false;
  for (const MemoryPredecessor& predecessor : predecessors_.before(resource)) {
    // Queues other than the first learn of the frame before by a semaphore.
    elsewhere = elsewhere || (predecessor.frameBefore && queue != 0);
    // A last change of layout or owner counts as a write.
    state.wrote = state.wrote || (predecessor.frameBefore && changedAtEnd_[predecessor.resource] != 0);
    for (uint32_t other = 0; other < in_.schedule.queues; ++other) {
      const AccessPoint& scope = finalScopes_[predecessor.resource * in_.schedule.queues + other];
      if (scope.stages == 0) continue;
      state.last.pass = predecessor.frameBefore ? kNone : scope.pass;
      state.wrote = state.wrote || scope.access != 0;
      if (other != queue || (predecessor.frameBefore && queue != 0)) {
        elsewhere = true;
        continue;
      }
      state.last.stages |= scope.stages;
      state.last.access |= scope.access;
    }
    if (predecessor.frameBefore) continue;
    const uint32_t last = finalSteps_[predecessor.resource];
    state.lastStep = state.lastStep == kNone ? last : std::max(state.lastStep, last);
  }
  constexpr VkPipelineStageFlags2 kAll = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  if ((state.last.stages & kAll) != 0) state.last.stages = kAll;
  if (elsewhere) {
    // Whatever stages waited for the semaphore, this chains to them.
    state.last.stages = kAll;
    state.fixed = true;
  }
  state.alias = state.last.stages != 0;
  return state;
}

CellState BarrierPlanner::stateBefore(uint32_t resource, uint32_t queue) const {
  const DeclaredResource& declared = in_.declaration.resources[resource];
  if (declared.created()) return stateAfterPredecessors(resource, queue);
  CellState state;
  if (declared.persistent()) {
    // The barrier at the end of the frame before made it visible to everything.
    if (declared.isImage) state.layout = restStateOf(declared).layout;
    return state;
  }
  const AccessState& before = declared.before;
  if (declared.isImage) state.layout = before.layout;
  state.wrote = writesMemory(before.access);
  state.last = {.stages = before.stages, .access = before.access & kWriteAccess};
  if (before.stages != 0) state.visible = Visibility::to(before.stages, state.wrote ? 0 : before.access);
  return state;
}

void BarrierPlanner::planResource(uint32_t resource) {
  const DeclaredResource& declared = in_.declaration.resources[resource];
  const auto cells = in_.cells.of(resource);
  found_.clear();
  for (uint32_t cell : cells) {
    const std::span<const CellUse> uses = in_.cellUses.of(cell);
    if (uses.empty() && (!declared.observable() || declared.persistent())) continue;
    const CellState start = stateBefore(resource, uses.empty() ? 0 : uses.front().queue);
    uses_.assign(uses.begin(), uses.end());
    if (const auto after =
            useAfterGraph(declared, uses, start.layout, in_.schedule.steps(), in_.options.overlappingFrames))
      uses_.push_back(*after);
    if (trimming_) trimming_->begin(resource, cell, predecessors_.before(resource));
    if (in_.schedule.severalQueues && crosses(declared)) {
      planCrossingCell(resource, cell, start);
    } else {
      planCell(resource, cell, start);
    }
  }
  if (cells.size() > 1) mergeRanges(found_);
  all_.insert(all_.end(), found_.begin(), found_.end());
}

void BarrierPlanner::planCell(uint32_t resource, uint32_t cell, const CellState& start) {
  const bool isImage = in_.declaration.resources[resource].isImage;
  CellState state = start;
  for (std::size_t first = 0; first < uses_.size();) {
    const Epoch epoch = epochAt(uses_, first);
    const bool transition = isImage && state.layout != epoch.layout();
    const std::size_t before = found_.size();
    first += epoch.uses.size();
    forgetHostWrite(state);
    if (!transition && !state.wrote && !epoch.writes()) {
      joinReads(resource, cell, state, epoch);
      if (trimming_) trimming_->trim(epoch, found_, before);
      continue;
    }
    if (transition || state.last.stages != 0) separate(resource, cell, state, epoch, transition);
    if (trimming_) trimming_->trim(epoch, found_, before);
    const bool untouched = !transition && !state.wrote && state.last.stages == 0;
    state.layout = epoch.layout();
    state.last = scopeAfter(epoch);
    state.lastStep = epoch.uses.back().step;
    state.wrote = epoch.writes();
    state.alias = state.fixed = false;
    if (epoch.writes()) {
      state.visible = Visibility::to(0, 0);
    } else if (!untouched) {
      state.visible = Visibility::to(epoch.stages, epoch.access);
    }
  }
}

/// The host read before the graph, and the graph goes on reading in the same layout: only reads to which the content
/// is not visible yet need a barrier.
void BarrierPlanner::joinReads(uint32_t resource, uint32_t cell, CellState& state, const Epoch& epoch) {
  Epoch missing;
  for (std::size_t i = 0; i < epoch.uses.size(); ++i) {
    const CellUse& use = epoch.uses[i];
    VkPipelineStageFlags2 uncovered = 0;
    forEachBit(use.stages, [&](VkPipelineStageFlags2 stage) {
      if (!state.visible.covers(stage, use.access)) uncovered |= stage;
    });
    if (uncovered == 0) continue;
    if (missing.uses.empty()) {
      missing.uses = epoch.uses.subspan(i);
      if (i > 0) state.lastStep = epoch.uses[i - 1].step;  // The barrier waits for these reads too.
    }
    missing.stages |= uncovered;
    missing.access |= use.access;
  }
  std::span<const CellUse> unordered = epoch.uses;
  if (!missing.uses.empty()) {
    add(resource, cell, missing, state,
        {.from = state.last, .oldLayout = state.layout, .reason = BarrierReason::readAfterWrite}, missing.access);
    state.visible.add(missing.stages, missing.access);
    // The barrier waits for the host, and for the reads before it, which are at the host's stages; if it stays.
    if (!trimming_) {
      state.last.stages = 0;
      unordered = missing.uses;
    }
  }
  state.last.pass = epoch.uses.back().lastPass;
  state.lastStep = epoch.uses.back().step;
  for (const CellUse& use : unordered) state.last.stages |= use.stages;
}

/// A barrier between two epochs.
void BarrierPlanner::separate(uint32_t resource, uint32_t cell, const CellState& state, const Epoch& epoch,
                              bool transition) {
  VkAccessFlags2 access = epoch.access;
  if (!transition && !state.wrote) {  // Write after read.
    access = epoch.needsContent() ? epoch.access & ~kWriteAccess : 0;
    // What earlier barriers have shown is known only while nothing is taken from them.
    if (!trimming_) access = state.visible.uncovered(epoch.stages, access);
  }
  // Before it writes, the host waits for the device in any case.
  const bool replaces = epoch.writes() && !epoch.needsContent();
  if (!transition && access == 0 && epoch.stages == VK_PIPELINE_STAGE_2_HOST_BIT) return;
  const bool dropped = transition && replaces;
  AccessPoint from = state.last;
  const bool keptFromBefore = from.stages == 0 && in_.declaration.resources[resource].persistent();
  if (keptFromBefore && in_.options.overlappingFrames) from.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  add(resource, cell, epoch, state,
      {.from = from,
       .oldLayout = dropped ? VK_IMAGE_LAYOUT_UNDEFINED : state.layout,
       .reason = reasonFor(state, epoch)},
      access);
}

void BarrierPlanner::add(uint32_t resource, uint32_t cell, const Epoch& epoch, const CellState& state,
                         ImageBarrier barrier, VkAccessFlags2 access) {
  PendingBarrier& found = found_.emplace_back();
  found.step = epoch.uses.front().step;
  if (state.fixed) {
    found.earliest = found.step;
  } else if (state.lastStep != kNone) {
    found.setAfter = in_.schedule.unitLast[state.lastStep];
    found.earliest = found.setAfter + 1;
  }
  barrier.resource = resource;
  barrier.range = in_.cells.rangeOf(resource, cell);
  barrier.to = {.pass = epoch.uses.front().pass, .stages = epoch.stages, .access = access};
  barrier.newLayout = epoch.layout();
  found.barrier = barrier;
}

void planBarriers(const BarrierInputs& inputs, Plan& plan) {
  BarrierPlanner(inputs, plan).run();
}

}  // namespace lensgraph::rendergraph
