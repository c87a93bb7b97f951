// Where commands go.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace lensgraph::rendergraph {

/// Command buffers of a backend and the transient objects (descriptor sets) that their commands need; 0 is none.
using RecorderId = uint64_t;

struct CommandStream {
  VkCommandBuffer buffer = VK_NULL_HANDLE;
  RecorderId recorder = 0;  ///< Where the transient objects of these commands live. One thread uses it at a time.
};

}  // namespace lensgraph::rendergraph
