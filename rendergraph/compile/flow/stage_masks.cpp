// Vulkan 1.3, "Synchronization and Cache Control": which stages and accesses the collective flags include.
#include "rendergraph/compile/flow/stage_masks.h"

#include "rendergraph/declare/access_table.h"

namespace lensgraph::rendergraph {

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

}  // namespace lensgraph::rendergraph
