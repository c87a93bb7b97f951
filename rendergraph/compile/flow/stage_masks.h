// What the collective stage and access flags of Vulkan stand for, and the stages at which uses wait for semaphores.
#pragma once

#include <vulkan/vulkan_core.h>

namespace lensgraph::rendergraph {

VkPipelineStageFlags2 expandedStages(VkPipelineStageFlags2 stages);
VkAccessFlags2 expandedAccess(VkAccessFlags2 access);

/// Like expandedStages(), except that HOST is never implied by ALL_COMMANDS.
inline VkPipelineStageFlags2 elementaryStages(VkPipelineStageFlags2 stages) {
  constexpr VkPipelineStageFlags2 kHost = VK_PIPELINE_STAGE_2_HOST_BIT;
  return (expandedStages(stages) & ~kHost) | (stages & kHost);
}

/// The lowest bit; 0 for 0.
constexpr VkFlags64 firstBitOf(VkFlags64 flags) {
  return flags & ~(flags - 1);
}

/// Calls use(flag) for each bit, the lowest first.
template <class Use>
void forEachBit(VkFlags64 flags, Use&& use) {
  for (; flags != 0; flags &= flags - 1) use(firstBitOf(flags));
}

/// Stage used to link two dependencies when neither names one. COMPUTE, because every graphics and compute queue has it.
inline constexpr VkPipelineStageFlags2 kChainStage = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;

/// The stages at which a use waits for a semaphore. A host access, an access without stages and an ALL_COMMANDS access
/// wait at kChainStage instead; their barrier chains from it, so the rest of the queue keeps running.
inline VkPipelineStageFlags2 semaphoreStages(VkPipelineStageFlags2 stages) {
  const VkPipelineStageFlags2 onDevice = stages & ~VK_PIPELINE_STAGE_2_HOST_BIT;
  return onDevice != 0 && (onDevice & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) == 0 ? onDevice : kChainStage;
}

}  // namespace lensgraph::rendergraph
