// What each usage does to memory, as the plan checker understands Vulkan: stages, accesses, layouts. Written down a
// second time on purpose, so that a mistake in the library's own table is found.
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstdint>

#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::plan_checker {

inline constexpr uint32_t kStageCount = 13;
using StageMask = uint32_t;  ///< One bit for each elementary stage.
/// The stages of the device and that of the host.
inline constexpr StageMask kHostStage = 1u << (kStageCount - 1);
inline constexpr StageMask kDeviceStages = kHostStage - 1;

using AccessMask = uint16_t;  ///< One bit for each elementary access: ten that read, then five that write.
inline constexpr AccessMask kReads = 0x03FF, kWrites = 0x7C00;

/// The elementary stages, and accesses, that flags of Vulkan stand for.
StageMask stageMask(VkPipelineStageFlags2 stages);
AccessMask accessMask(VkAccessFlags2 access);
/// The flags of elementary stages.
VkPipelineStageFlags2 stageFlags(StageMask stages);

/// The stages that exist on a queue.
StageMask stagesOf(const rendergraph::QueueFacts& queue);

using Touches = std::array<AccessMask, kStageCount>;  ///< What happens at each stage.

/// One use of a subresource by one pass, or by the host.
struct Use {
  StageMask stages = 0;
  Touches touches{};
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  bool reads = false, writes = false;
  bool onlyAttachment = true;  ///< As long as nothing else is added.

  void add(StageMask at, AccessMask access) {
    stages |= at;
    for (uint32_t i = 0; i < kStageCount; ++i) {
      if ((at >> i & 1) != 0) touches[i] |= access;
    }
  }
};

/// The layout that a usage alone asks for.
VkImageLayout layoutFor(rendergraph::Usage usage);
/// Adds one declared access to what a pass does with a subresource.
void addAccess(Use& use, const rendergraph::DeclaredAccess& access);

}  // namespace lensgraph::plan_checker
