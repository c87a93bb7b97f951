// What living passes do with each resource, and what memory that takes. Pure.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/device_facts.h"

namespace lensgraph::rendergraph {

struct Declaration;

struct ResourceNeed {
  bool used = false;
  VkImageUsageFlags image = 0;
  VkBufferUsageFlags buffer = 0;
  MemoryRequirements requirements;  ///< Of resources that the graph creates; size 0 for others.
};

/// By resource.
std::vector<ResourceNeed> findResourceNeeds(const Declaration& declaration, std::span<const uint8_t> alive,
                                            const DeviceFacts& device);

}  // namespace lensgraph::rendergraph
