// The Vulkan objects behind the resources of one execution.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <vector>

namespace lensgraph::rendergraph {

class ViewCache;

struct ResourceObjects {
  VkImage image = VK_NULL_HANDLE;
  VkBuffer buffer = VK_NULL_HANDLE;
  ViewCache* views = nullptr;    ///< Where its views live.
  std::byte* address = nullptr;  ///< Of host-visible buffers.
};

using ResourceTable = std::vector<ResourceObjects>;  ///< By resource of the declaration.

}  // namespace lensgraph::rendergraph
