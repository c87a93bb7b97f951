// Short words for Vulkan's stages, accesses, layouts, load and store operations, for dumps.
#pragma once

#include <vulkan/vulkan_core.h>

#include <string>
#include <string_view>

namespace lensgraph::rendergraph {

/// Names joined by '+', in the order of the bits; "none" for 0; unknown bits in hexadecimal.
std::string stageNames(VkPipelineStageFlags2 stages);
std::string accessNames(VkAccessFlags2 access);
/// "undefined", "general", …; the number for a layout that the graph never uses itself.
std::string layoutName(VkImageLayout layout);
/// "load", "clear", "dontCare"; "store", "none", "dontCare".
std::string_view nameOf(VkAttachmentLoadOp load);
std::string_view nameOf(VkAttachmentStoreOp store);

}  // namespace lensgraph::rendergraph
