// What each usage means to Vulkan: stages, access bits, layout, usage flags. This table is the only place where the four
// are put together.
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstdint>

#include "rendergraph/usage.h"

namespace lensgraph::rendergraph {

struct AccessRules {
  VkPipelineStageFlags2 stages;  ///< 0: the shader stages that touch the resource.
  VkAccessFlags2 access;
  VkImageLayout layout;            ///< UNDEFINED for buffers.
  VkImageUsageFlags imageUsage;    ///< 0 when an image cannot be used so.
  VkBufferUsageFlags bufferUsage;  ///< 0 when a buffer cannot be used so.
  bool possible;                   ///< Whether the usage can read (read) or write (write, modify) at all.
  bool anyColorImage;              ///< Right for every colour image of the graph.
  bool anyBuffer;                  ///< Right for every buffer of the graph.
};

inline constexpr std::size_t kUsages = static_cast<std::size_t>(Usage::host) + 1;
inline constexpr std::size_t kAccessModes = static_cast<std::size_t>(AccessMode::modify) + 1;
/// Of each usage in each mode. A table, since every declared access asks it.
extern const std::array<AccessRules, kUsages * kAccessModes> kAccessRules;

inline const AccessRules& rulesOf(Usage usage, AccessMode mode) {
  return kAccessRules[static_cast<std::size_t>(usage) * kAccessModes + static_cast<std::size_t>(mode)];
}

/// Whether the usage happens in shaders, so that the caller names the stages.
bool usesShaderStages(Usage usage);

/// Every access bit that writes memory; the others read.
inline constexpr VkAccessFlags2 kWriteAccess =
    VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_HOST_WRITE_BIT |
    VK_ACCESS_2_MEMORY_WRITE_BIT;
/// Whether any bit of `access` writes memory.
bool writesMemory(VkAccessFlags2 access);

/// The layout in which one pass can use the same subresource in both ways; UNDEFINED when there is none (an
/// attachment cannot be written and read otherwise in one pass).
VkImageLayout combinedLayout(VkImageLayout a, VkImageLayout b);

}  // namespace lensgraph::rendergraph
