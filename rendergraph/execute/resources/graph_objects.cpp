// Asks the backend for the object, and for the host's address of upload and readback buffers.
#include "rendergraph/execute/resources/graph_objects.h"

namespace lensgraph::rendergraph {

namespace {

ImageRequest imageRequest(const ObjectRequest& request) {
  return {request.imageDesc, request.imageUsage, request.concurrent, request.name};
}

BufferRequest bufferRequest(const ObjectRequest& request) {
  return {request.bufferDesc, request.bufferUsage, request.concurrent, request.name};
}

std::byte* hostAddress(Backend& backend, const ObjectRequest& request, HeapId heap, VkDeviceSize offset) {
  if (request.isImage || request.bufferDesc.memory == MemoryKind::device) return nullptr;
  return static_cast<std::byte*>(backend.hostAddress(heap)) + offset;
}

}  // namespace

GraphObject makeInHeap(Backend& backend, const ObjectRequest& request, HeapId heap, VkDeviceSize offset) {
  GraphObject made;
  if (request.isImage) {
    made.image = UniqueImage(backend, backend.createImage(imageRequest(request), heap, offset));
  } else {
    made.buffer = UniqueBuffer(backend, backend.createBuffer(bufferRequest(request), heap, offset));
  }
  made.address = hostAddress(backend, request, heap, offset);
  return made;
}

GraphObject makeDedicated(Backend& backend, const ObjectRequest& request) {
  GraphObject made;
  if (request.isImage) {
    const DedicatedImage both = backend.createDedicatedImage(imageRequest(request));
    made.heap = UniqueHeap(backend, both.heap);
    made.image = UniqueImage(backend, both.image);
  } else {
    const DedicatedBuffer both = backend.createDedicatedBuffer(bufferRequest(request));
    made.heap = UniqueHeap(backend, both.heap);
    made.buffer = UniqueBuffer(backend, both.buffer);
  }
  made.address = hostAddress(backend, request, made.heap.get(), 0);
  return made;
}

}  // namespace lensgraph::rendergraph
