// What each usage does to memory, as the plan checker understands Vulkan: stages, accesses, layouts. Written down a
// second time on purpose, so that a mistake in the library's own table is found.
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstdint>

#include "rendergraph/declaration.h"

namespace plan_checker {

inline constexpr uint32_t kStageCount = 12;
using StageMask = uint32_t;  ///< One bit for each elementary stage.

/// Every read and every write access that the graph knows.
inline constexpr VkAccessFlags2 kReads =
    VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT | VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT |
    VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
    VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_HOST_READ_BIT;
inline constexpr VkAccessFlags2 kWrites =
    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_HOST_WRITE_BIT;

/// The elementary stages, and accesses, that collective flags stand for.
StageMask stageMask(VkPipelineStageFlags2 stages);
VkAccessFlags2 accessMask(VkAccessFlags2 access);

using Touches = std::array<VkAccessFlags2, kStageCount>;  // What happens at each stage.

/// One use of a subresource by one pass, or by the host.
struct Use {
  StageMask stages = 0;
  Touches touches{};
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  bool reads = false, writes = false;

  void add(StageMask at, VkAccessFlags2 access) {
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

}  // namespace plan_checker
