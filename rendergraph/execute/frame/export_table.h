// What a frame exported: the objects behind its exported resources.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <vector>

#include "rendergraph/execute/resources/resource_table.h"

namespace lensgraph::rendergraph {

struct Declaration;

/// What a frame exported, so that it can be looked up when the graph is gone.
struct ExportTable {
  uint32_t serial = 0;              ///< Serial number of the declaration; 0: the table is empty.
  ResourceTable objects;            ///< By resource.
  std::vector<uint8_t> exported;    ///< By resource.
  std::vector<VkDeviceSize> sizes;  ///< By resource: bytes of a buffer, 0 for images.
  /// Replaces the content. Keeps its memory, so that an unchanged frame allocates nothing.
  void take(const Declaration& declaration, const ResourceTable& table);
};

}  // namespace lensgraph::rendergraph
