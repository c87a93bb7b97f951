// An image or buffer of the graph with its memory and its views, and how one is made.
#pragma once

#include <cstddef>
#include <string_view>

#include "rendergraph/backend.h"
#include "rendergraph/execute/resources/resource_table.h"
#include "rendergraph/execute/resources/unique_handle.h"
#include "rendergraph/execute/resources/view_cache.h"

namespace lensgraph::rendergraph {

/// Either an image or a buffer. Members are destroyed from the last to the first: views, the object, its memory.
struct GraphObject {
  UniqueHeap heap;  ///< Memory that holds this object alone; empty when the object lies in a heap of somebody else.
  UniqueImage image;
  UniqueBuffer buffer;
  ViewCache views;
  std::byte* address = nullptr;  ///< Where the host sees a host-visible buffer.

  /// The entry of a resource table that stands for the object, which outlives the entry.
  ResourceObjects entry() {
    return {.image = image.get(), .buffer = buffer.get(), .views = &views, .address = address};
  }
};

struct ObjectRequest {
  bool isImage = true;
  const ImageDesc& imageDesc;    ///< Images only.
  const BufferDesc& bufferDesc;  ///< Buffers only.
  VkImageUsageFlags imageUsage = 0;
  VkBufferUsageFlags bufferUsage = 0;
  bool concurrent = false;  ///< As in ImageRequest.
  std::string_view name;
};

/// Both throw GraphError (outOfMemory, device); then nothing was made.
/// The object at an offset (bytes) of a heap, which outlives it.
GraphObject makeInHeap(Backend& backend, const ObjectRequest& request, HeapId heap, VkDeviceSize offset);
/// The object with an allocation that the device wants for it alone.
GraphObject makeDedicated(Backend& backend, const ObjectRequest& request);

}  // namespace lensgraph::rendergraph
