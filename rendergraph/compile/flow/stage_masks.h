// What the collective stage and access flags of Vulkan stand for, and the stages at which uses wait for semaphores.
#pragma once

#include <vulkan/vulkan_core.h>

namespace lensgraph::rendergraph {

VkPipelineStageFlags2 expandedStages(VkPipelineStageFlags2 stages);
VkAccessFlags2 expandedAccess(VkAccessFlags2 access);

/// The same, but that the host's stage is in nothing but itself.
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

/// Where a chain of dependencies passes through that has no stage of its own; queue 0 and every computing one have it.
inline constexpr VkPipelineStageFlags2 kChainStage = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;

/// The stages at which a use waits for a semaphore. One by the host, or at no stage, has none of its own that could
/// wait, and one at all of them shall not make the whole queue wait: what protects these chains from another.
inline VkPipelineStageFlags2 semaphoreStages(VkPipelineStageFlags2 stages) {
  const VkPipelineStageFlags2 onDevice = stages & ~VK_PIPELINE_STAGE_2_HOST_BIT;
  return onDevice != 0 && (onDevice & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) == 0 ? onDevice : kChainStage;
}

}  // namespace lensgraph::rendergraph
