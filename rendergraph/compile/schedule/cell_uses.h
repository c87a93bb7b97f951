// How each cell is used over time by the passes in execution order. Pure; barriers, attachments and waits between
// queues are read off it.
#pragma once

#include <vulkan/vulkan_core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

struct Declaration;
struct DeclaredResource;
struct Schedule;
class Cells;

/// One use of a cell: all accesses to it of one pass, or of the passes that share one rendering.
struct CellUse {
  uint32_t step = 0;          ///< First step of the rendering, or of the pass.
  uint32_t pass = 0;          ///< The first that touches the cell.
  uint32_t lastPass = kNone;  ///< The last one.
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
  uint32_t queue = 0;
  bool writes = false;
  bool needsContent = false;  ///< Of what was there before.
};

class CellUses {
 public:
  CellUses(const Declaration& declaration, const Cells& cells, const Schedule& schedule);
  /// In execution order.
  std::span<const CellUse> of(uint32_t cell) const {
    return {uses_.data() + starts_[cell], uses_.data() + ends_[cell]};
  }

 private:
  std::vector<uint32_t> starts_, ends_;
  std::vector<CellUse> uses_;
};

/// What follows the graph, as a use by queue 0 after the last step; none when nobody asks for anything.
/// `layoutBefore`: the layout before the first of `uses`, which are all of the cell.
std::optional<CellUse> useAfterGraph(const DeclaredResource& resource, std::span<const CellUse> uses,
                                     VkImageLayout layoutBefore, uint32_t steps, bool overlappingFrames);

/// One write, or a run of reads in one layout: inside it, nothing has to be ordered.
struct Epoch {
  std::span<const CellUse> uses;
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
  VkImageLayout layout() const { return uses.front().layout; }
  bool writes() const { return uses.front().writes; }
  bool needsContent() const { return uses.front().needsContent; }
  bool onSeveralQueues() const {
    return std::ranges::any_of(uses, [&](const CellUse& use) { return use.queue != uses.front().queue; });
  }
};

/// The epoch that starts at uses[first]. `oneQueue`: a run of reads ends where another queue goes on.
inline Epoch epochAt(std::span<const CellUse> uses, std::size_t first, bool oneQueue = false) {
  std::size_t end = first + 1;
  if (!uses[first].writes) {
    while (end < uses.size() && !uses[end].writes && uses[end].layout == uses[first].layout &&
           !(oneQueue && uses[end].queue != uses[first].queue)) {
      ++end;
    }
  }
  Epoch epoch{.uses = uses.subspan(first, end - first)};
  for (const CellUse& use : epoch.uses) {
    epoch.stages |= use.stages;
    epoch.access |= use.access;
  }
  return epoch;
}

/// The uses of the last epoch. Precondition: there are uses.
inline std::span<const CellUse> lastEpochOf(std::span<const CellUse> uses) {
  std::size_t first = uses.size() - 1;
  while (first > 0 && !uses[first].writes && !uses[first - 1].writes && uses[first - 1].layout == uses.back().layout) {
    --first;
  }
  return uses.subspan(first);
}

/// The part of an epoch that one queue executes.
inline Epoch partOf(const Epoch& epoch, uint32_t queue) {
  Epoch part{.uses = epoch.uses};
  for (const CellUse& use : epoch.uses) {
    if (use.queue != queue) continue;
    part.stages |= use.stages;
    part.access |= use.access;
  }
  return part;
}

}  // namespace lensgraph::rendergraph
