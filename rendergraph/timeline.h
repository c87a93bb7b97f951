// How each cell is used over time by the passes in execution order. Pure; barriers and attachments are read off it.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <vector>

namespace rendergraph {

struct Declaration;
class Cells;

/// One use of a cell: all accesses of one pass to it together.
struct CellUse {
  uint32_t step = 0;  ///< Position in execution order.
  uint32_t pass = 0;
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  bool writes = false;
  bool needsContent = false;  ///< Of what was there before the pass.
};

class Timeline {
 public:
  Timeline(const Declaration& declaration, const Cells& cells, std::span<const uint32_t> order);
  /// In execution order.
  std::span<const CellUse> of(uint32_t cell) const {
    return {uses_.data() + starts_[cell], uses_.data() + ends_[cell]};
  }

 private:
  std::vector<uint32_t> starts_, ends_;
  std::vector<CellUse> uses_;
};

}  // namespace rendergraph
