// Walks every cell through time and separates what must not touch.
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
//   alias              the first use of each cell waits for the last epochs of all previous occupants of the memory.
//
// Every barrier names its resource, and none is left out because a barrier of another resource happens to order the
// same stages: layered validation reasons per resource, and within a batch the extra entry waits for nothing new.
#include "rendergraph/barriers.h"

#include <algorithm>
#include <array>

#include "rendergraph/access.h"
#include "rendergraph/barrier_merging.h"
#include "rendergraph/cells.h"
#include "rendergraph/declaration.h"
#include "rendergraph/occupants.h"
#include "rendergraph/timeline.h"

namespace rendergraph {

namespace {

// What the collective flags stand for, so that scopes can be compared.
VkPipelineStageFlags2 expandedStages(VkPipelineStageFlags2 stages) {
  constexpr VkPipelineStageFlags2 kPreRaster =
      VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_TESSELLATION_CONTROL_SHADER_BIT |
      VK_PIPELINE_STAGE_2_TESSELLATION_EVALUATION_SHADER_BIT | VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT;
  constexpr VkPipelineStageFlags2 kVertexInput =
      VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT;
  constexpr VkPipelineStageFlags2 kGraphics =
      VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | kVertexInput | kPreRaster | VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT |
      VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
      VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT |
      VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
  if ((stages & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) != 0) return ~VkPipelineStageFlags2{0};
  if ((stages & VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT) != 0) stages |= kGraphics;
  if ((stages & VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT) != 0) stages |= kVertexInput;
  if ((stages & VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT) != 0) stages |= kPreRaster;
  if ((stages & VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT) != 0) {
    stages |= VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_BLIT_BIT | VK_PIPELINE_STAGE_2_RESOLVE_BIT |
              VK_PIPELINE_STAGE_2_CLEAR_BIT;
  }
  return stages;
}

VkAccessFlags2 expandedAccess(VkAccessFlags2 access) {
  if ((access & VK_ACCESS_2_MEMORY_READ_BIT) != 0) access |= ~kWriteAccess;
  if ((access & VK_ACCESS_2_MEMORY_WRITE_BIT) != 0) access |= kWriteAccess;
  if ((access & VK_ACCESS_2_SHADER_READ_BIT) != 0) {
    access |= VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
  }
  return access;
}

/// To whom the content of a cell is visible.
class Visibility {
 public:
  static Visibility toEverything() {
    Visibility visibility;
    visibility.everything_ = true;
    return visibility;
  }
  static Visibility to(VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    Visibility visibility;
    visibility.add(stages, access);
    return visibility;
  }
  void add(VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    if (count_ < scopes_.size()) scopes_[count_++] = {expandedStages(stages), expandedAccess(access)};
  }
  bool covers(VkPipelineStageFlags2 stages, VkAccessFlags2 access) const {
    if (everything_) return true;
    for (std::size_t i = 0; i < count_; ++i) {
      if ((expandedStages(stages) & ~scopes_[i].stages) == 0 && (expandedAccess(access) & ~scopes_[i].access) == 0) {
        return true;
      }
    }
    return false;
  }
  /// The accesses that some of the stages cannot rely on.
  VkAccessFlags2 uncovered(VkPipelineStageFlags2 stages, VkAccessFlags2 access) const {
    VkAccessFlags2 result = 0;
    for (VkAccessFlags2 rest = access; rest != 0; rest &= rest - 1) {
      const VkAccessFlags2 bit = rest & ~(rest - 1);
      if (!covers(stages, bit)) result |= bit;
    }
    return result;
  }

 private:
  struct Scope {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
  };
  // One scope for the host's own use before the graph and one for the barrier of a run of reads.
  std::array<Scope, 2> scopes_;
  std::size_t count_ = 0;
  bool everything_ = false;
};

/// One write, or a run of reads in one layout.
struct Epoch {
  std::span<const CellUse> uses;
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
  VkImageLayout layout() const { return uses.front().layout; }
  bool writes() const { return uses.front().writes; }
  bool needsContent() const { return uses.front().needsContent; }
};

/// The epoch that starts at uses[first].
Epoch epochAt(std::span<const CellUse> uses, std::size_t first) {
  std::size_t end = first + 1;
  if (!uses[first].writes) {
    while (end < uses.size() && !uses[end].writes && uses[end].layout == uses[first].layout) ++end;
  }
  Epoch epoch{.uses = uses.subspan(first, end - first)};
  for (const CellUse& use : epoch.uses) {
    epoch.stages |= use.stages;
    epoch.access |= use.access;
  }
  return epoch;
}

/// What an epoch leaves for the next one to wait for.
AccessPoint scopeAfter(const Epoch& epoch) {
  return {.pass = epoch.uses.back().pass,
          .stages = epoch.stages,
          .access = epoch.writes() ? epoch.access & kWriteAccess : 0};
}

struct CellState {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  AccessPoint last;    ///< Stages 0: nothing to wait for.
  bool wrote = false;  ///< `last` wrote and nobody has waited for it yet.
  bool alias = false;
  Visibility visible = Visibility::toEverything();
};

class BarrierPlanner {
 public:
  BarrierPlanner(const Declaration& declaration, const Cells& cells, const Timeline& timeline, Plan& plan)
      : declaration_(declaration), cells_(cells), timeline_(timeline), plan_(plan) {}

  void run() {
    findOccupants();
    for (uint32_t resource = 0; resource < declaration_.resources.size(); ++resource) planResource(resource);
    emit();
  }

 private:
  void findOccupants() {
    const std::size_t count = declaration_.resources.size();
    std::vector<uint8_t> fullyUsed(count, 0);
    finalScopes_.resize(count);
    for (const Placement& placement : plan_.placements) {
      const uint32_t first = cells_.firstOf(placement.resource);
      bool full = true;
      for (uint32_t cell = first; cell < first + cells_.countOf(placement.resource); ++cell) {
        full = !timeline_.of(cell).empty() && full;
        addFinalScope(cell, finalScopes_[placement.resource]);
      }
      fullyUsed[placement.resource] = full;
    }
    occupants_ = previousOccupants(plan_.placements, count, fullyUsed);
  }

  void addFinalScope(uint32_t cell, AccessPoint& scope) const {
    const std::span<const CellUse> uses = timeline_.of(cell);
    if (uses.empty()) return;
    std::size_t first = 0;
    while (first + epochAt(uses, first).uses.size() < uses.size()) first += epochAt(uses, first).uses.size();
    const AccessPoint last = scopeAfter(epochAt(uses, first));
    scope.pass = last.pass;
    scope.stages |= last.stages;
    scope.access |= last.access;
  }

  void planResource(uint32_t resource) {
    const CellState start = stateBefore(resource);
    const uint32_t first = cells_.firstOf(resource);
    found_.clear();
    for (uint32_t cell = first; cell < first + cells_.countOf(resource); ++cell) {
      planCell(resource, cell, start);
    }
    mergeRanges(found_);
    all_.insert(all_.end(), found_.begin(), found_.end());
  }

  /// Gives every batch its run of barriers.
  void emit() {
    std::stable_sort(all_.begin(), all_.end(),
                     [](const PlacedBarrier& a, const PlacedBarrier& b) { return a.step < b.step; });
    std::size_t next = 0;
    for (uint32_t step = 0; step <= plan_.passes.size(); ++step) {
      BarrierBatch& batch = step < plan_.passes.size() ? plan_.passes[step].before : plan_.submissions.back().atEnd;
      batch.images.first = static_cast<uint32_t>(plan_.imageBarriers.size());
      batch.buffers.first = static_cast<uint32_t>(plan_.bufferBarriers.size());
      for (; next < all_.size() && all_[next].step == step; ++next) {
        const ImageBarrier& barrier = all_[next].barrier;
        if (declaration_.resources[barrier.resource].isImage) {
          plan_.imageBarriers.push_back(barrier);
          ++batch.images.count;
        } else {
          plan_.bufferBarriers.push_back(
              {.resource = barrier.resource, .from = barrier.from, .to = barrier.to, .reason = barrier.reason});
          ++batch.buffers.count;
        }
      }
      plan_.barrierBatches += !batch.empty();
    }
  }

  CellState stateBefore(uint32_t resource) const {
    const DeclaredResource& declared = declaration_.resources[resource];
    CellState state;
    if (declared.retained()) {
      // The barrier at the end of the frame before made it visible to everything.
      if (declared.isImage) state.layout = restStateOf(declared).layout;
    } else if (declared.imported()) {
      const AccessState& before = declared.before;
      if (declared.isImage) state.layout = before.layout;
      state.wrote = writesMemory(before.access);
      state.last = {.stages = before.stages, .access = before.access & kWriteAccess};
      if (before.stages != 0) state.visible = Visibility::to(before.stages, state.wrote ? 0 : before.access);
    } else {
      for (uint32_t occupant : occupants_[resource]) {
        state.last.pass = finalScopes_[occupant].pass;
        state.last.stages |= finalScopes_[occupant].stages;
        state.last.access |= finalScopes_[occupant].access;
      }
      state.alias = state.last.stages != 0;
      state.wrote = state.last.access != 0;
    }
    return state;
  }

  /// Adds what follows the graph as one more use.
  void addUseAfter(const DeclaredResource& resource, VkImageLayout layoutBefore) {
    if (!resource.observable() || (resource.retained() && uses_.empty())) return;
    AccessState after = resource.retained() ? restStateOf(resource) : resource.after;
    const VkImageLayout current = uses_.empty() ? layoutBefore : uses_.back().layout;
    if (!resource.isImage || after.layout == VK_IMAGE_LAYOUT_UNDEFINED) after.layout = current;
    if (after.stages == 0 && after.layout == current) return;
    uses_.push_back({.step = static_cast<uint32_t>(plan_.passes.size()),
                     .pass = AccessPoint::kOutside,
                     .stages = after.stages,
                     .access = after.access,
                     .layout = after.layout,
                     .writes = writesMemory(after.access),
                     .needsContent = true});
  }

  void planCell(uint32_t resource, uint32_t cell, const CellState& start) {
    const DeclaredResource& declared = declaration_.resources[resource];
    const std::span<const CellUse> uses = timeline_.of(cell);
    uses_.assign(uses.begin(), uses.end());
    addUseAfter(declared, start.layout);
    CellState state = start;
    for (std::size_t first = 0; first < uses_.size();) {
      const Epoch epoch = epochAt(uses_, first);
      const bool transition = declared.isImage && state.layout != epoch.layout();
      if (!transition && !state.wrote && !epoch.writes()) {
        joinReads(resource, cell, state, epoch);
      } else {
        if (transition || state.last.stages != 0) separate(resource, cell, state, epoch, transition);
        enter(state, epoch, transition);
      }
      first += epoch.uses.size();
    }
  }

  /// The host read before the graph, and the graph goes on reading in the same layout: only reads to which the
  /// content is not visible yet need a barrier.
  void joinReads(uint32_t resource, uint32_t cell, CellState& state, const Epoch& epoch) {
    Epoch missing;
    for (std::size_t i = 0; i < epoch.uses.size(); ++i) {
      const CellUse& use = epoch.uses[i];
      VkPipelineStageFlags2 uncovered = 0;
      for (VkPipelineStageFlags2 rest = use.stages; rest != 0; rest &= rest - 1) {
        const VkPipelineStageFlags2 stage = rest & ~(rest - 1);
        if (!state.visible.covers(stage, use.access)) uncovered |= stage;
      }
      if (uncovered == 0) continue;
      if (missing.uses.empty()) missing.uses = epoch.uses.subspan(i);
      missing.stages |= uncovered;
      missing.access |= use.access;
    }
    std::span<const CellUse> unordered = epoch.uses;
    if (!missing.uses.empty()) {
      add(resource, cell, missing,
          {.from = state.last, .oldLayout = state.layout, .reason = BarrierReason::readAfterWrite}, missing.access);
      state.visible.add(missing.stages, missing.access);
      // The barrier waits for the host, and for the reads before it, which are at the host's stages.
      state.last.stages = 0;
      unordered = missing.uses;
    }
    state.last.pass = epoch.uses.back().pass;
    for (const CellUse& use : unordered) state.last.stages |= use.stages;
  }

  /// A barrier between two epochs.
  void separate(uint32_t resource, uint32_t cell, const CellState& state, const Epoch& epoch, bool transition) {
    VkAccessFlags2 access = epoch.access;
    if (!transition && !state.wrote) {  // Write after read.
      access = epoch.needsContent() ? state.visible.uncovered(epoch.stages, epoch.access & ~kWriteAccess) : 0;
    }
    const bool discard = epoch.writes() && !epoch.needsContent();
    const bool dropped = transition && discard;
    add(resource, cell, epoch,
        {.from = state.last,
         .oldLayout = dropped ? VK_IMAGE_LAYOUT_UNDEFINED : state.layout,
         .reason = reasonFor(state, epoch)},
        access);
  }

  static BarrierReason reasonFor(const CellState& state, const Epoch& epoch) {
    if (state.alias) return BarrierReason::alias;
    if (state.last.stages == 0) return BarrierReason::layout;
    if (state.wrote) return epoch.needsContent() ? BarrierReason::readAfterWrite : BarrierReason::writeAfterWrite;
    return epoch.writes() ? BarrierReason::writeAfterRead : BarrierReason::layout;
  }

  void add(uint32_t resource, uint32_t cell, const Epoch& epoch, ImageBarrier barrier, VkAccessFlags2 access) {
    barrier.resource = resource;
    barrier.range = cells_.rangeOf(resource, cell);
    barrier.to = {.pass = epoch.uses.front().pass, .stages = epoch.stages, .access = access};
    barrier.newLayout = epoch.layout();
    found_.push_back({epoch.uses.front().step, barrier});
  }

  static void enter(CellState& state, const Epoch& epoch, bool transition) {
    const bool untouched = !transition && !state.wrote && state.last.stages == 0;
    state.layout = epoch.layout();
    state.last = scopeAfter(epoch);
    state.wrote = epoch.writes();
    state.alias = false;
    if (epoch.writes()) {
      state.visible = Visibility::to(0, 0);
    } else if (!untouched) {
      state.visible = Visibility::to(epoch.stages, epoch.access);
    }
  }

  const Declaration& declaration_;
  const Cells& cells_;
  const Timeline& timeline_;
  Plan& plan_;
  std::vector<AccessPoint> finalScopes_;          // By resource: what its successor in memory waits for.
  std::vector<std::vector<uint32_t>> occupants_;  // By resource: who had its memory before.
  std::vector<CellUse> uses_;                     // Of the current cell.
  std::vector<PlacedBarrier> found_;              // Of the current resource.
  std::vector<PlacedBarrier> all_;
};

}  // namespace

void planBarriers(const Declaration& declaration, const Cells& cells, const Timeline& timeline, Plan& plan) {
  BarrierPlanner(declaration, cells, timeline, plan).run();
}

}  // namespace rendergraph
