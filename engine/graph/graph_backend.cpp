// The graph's objects on Vulkan: memory, images, buffers, views. Recording is in graph_backend_commands.cpp, submission
// and time in graph_backend_submission.cpp.
#include "engine/graph/graph_backend.h"

#include <algorithm>
#include <string>

#include "engine/graph/graph_error.h"
#include "engine/vulkan/vulkan_functions.h"

namespace lensgraph::engine {

using rendergraph::MemoryRequirements;

GraphBackend::GraphBackend(const Device& device, const GraphBackendOptions& options)
    : device_(device), options_(options), pipelines_(device, defaultPipelineCacheFile(device)) {
  for (const DeviceQueue& queue : device.queues()) {
    queues_.push_back({.family = queue.family, .graphics = queue.graphics, .compute = queue.compute});
    if (std::ranges::find(families_, queue.family) == families_.end()) families_.push_back(queue.family);
  }
}

GraphBackend::~GraphBackend() = default;

uint32_t GraphBackend::maxImageSize() const {
  return device_.limits().maxImageDimension2D;
}
uint32_t GraphBackend::maxImageLayers() const {
  return std::min(device_.limits().maxImageArrayLayers, device_.limits().maxFramebufferLayers);
}
VkDeviceSize GraphBackend::maxBufferSize() const {
  return device_.maxBufferSize();
}
VkDeviceSize GraphBackend::maxStorageRange() const {
  return device_.limits().maxStorageBufferRange;
}
VkDeviceSize GraphBackend::maxUniformRange() const {
  return device_.limits().maxUniformBufferRange;
}

// ---- Memory

template <class CreateInfo>
void GraphBackend::share(CreateInfo& info, bool concurrent) const {
  if (!concurrent || families_.size() < 2) return;
  info.sharingMode = VK_SHARING_MODE_CONCURRENT;
  info.queueFamilyIndexCount = static_cast<uint32_t>(families_.size());
  info.pQueueFamilyIndices = families_.data();
}

MemoryRequirements GraphBackend::folded(const VkMemoryRequirements2& found) const {
  const auto& needs = found.memoryRequirements;
  const auto* dedicated = static_cast<const VkMemoryDedicatedRequirements*>(found.pNext);
  // Images and buffers share heaps: the granularity between them is folded into every alignment.
  return {.size = needs.size,
          .alignment = std::max(needs.alignment, device_.limits().bufferImageGranularity),
          .memoryTypeBits = needs.memoryTypeBits,
          .dedicated = dedicated->requiresDedicatedAllocation == VK_TRUE ||
                       (options_.dedicatedWherePreferred && dedicated->prefersDedicatedAllocation == VK_TRUE)};
}

namespace {

/// What serves for both modes of sharing: whether queues share a resource is decided when its needs are known.
MemoryRequirements both(const MemoryRequirements& a, const MemoryRequirements& b) {
  return {.size = std::max(a.size, b.size),
          .alignment = std::max(a.alignment, b.alignment),
          .memoryTypeBits = a.memoryTypeBits & b.memoryTypeBits,
          .dedicated = a.dedicated || b.dedicated};
}

}  // namespace

MemoryRequirements GraphBackend::requirements(const rendergraph::ImageDesc& desc, VkImageUsageFlags usage) const {
  const auto ask = [&](bool concurrent) {
    auto info = imageCreateInfo(desc, usage);
    share(info, concurrent);
    VkDeviceImageMemoryRequirements query{VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS};
    query.pCreateInfo = &info;
    VkMemoryDedicatedRequirements dedicated{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS};
    VkMemoryRequirements2 found{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2, &dedicated};
    device_.vk().vkGetDeviceImageMemoryRequirements(device_.handle(), &query, &found);
    return folded(found);
  };
  return families_.size() < 2 ? ask(false) : both(ask(false), ask(true));
}

MemoryRequirements GraphBackend::requirements(const rendergraph::BufferDesc& desc, VkBufferUsageFlags usage) const {
  const auto ask = [&](bool concurrent) {
    auto info = bufferCreateInfo(desc.size, usage | desc.extraUsage);
    share(info, concurrent);
    VkDeviceBufferMemoryRequirements query{VK_STRUCTURE_TYPE_DEVICE_BUFFER_MEMORY_REQUIREMENTS};
    query.pCreateInfo = &info;
    VkMemoryDedicatedRequirements dedicated{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS};
    VkMemoryRequirements2 found{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2, &dedicated};
    device_.vk().vkGetDeviceBufferMemoryRequirements(device_.handle(), &query, &found);
    return folded(found);
  };
  return families_.size() < 2 ? ask(false) : both(ask(false), ask(true));
}

rendergraph::HeapId GraphBackend::keep(MemoryBlock block, VkDeviceSize size, std::string_view name) {
  device_.setName(VK_OBJECT_TYPE_DEVICE_MEMORY, reinterpret_cast<uint64_t>(block.memory.get()), name);
  heaps_.emplace(nextHeap_, Heap{std::move(block), size});
  allocatedBytes_ += size;
  return nextHeap_++;
}

rendergraph::HeapId GraphBackend::createHeap(VkDeviceSize size, uint32_t memoryTypeBits, rendergraph::MemoryKind memory,
                                             std::string_view name) {
  return withGraphErrors({}, [&] { return keep(allocateMemory(device_, size, memoryTypeBits, memory), size, name); });
}

rendergraph::HeapId GraphBackend::createDedicated(const VkMemoryRequirements& needs, rendergraph::MemoryKind memory,
                                                  const VkMemoryDedicatedAllocateInfo& owner, std::string_view name) {
  return withGraphErrors(name, [&] {
    return keep(allocateMemory(device_, needs.size, needs.memoryTypeBits, memory, &owner), needs.size, name);
  });
}

void GraphBackend::destroyHeap(rendergraph::HeapId heap) {
  const auto found = heaps_.find(heap);
  allocatedBytes_ -= found->second.size;
  heaps_.erase(found);
}
void* GraphBackend::hostAddress(rendergraph::HeapId heap) {
  return heaps_.at(heap).block.address;
}

// ---- Images

VkImage GraphBackend::createImage(const rendergraph::ImageRequest& request, rendergraph::HeapId heap,
                                  VkDeviceSize offset) {
  auto info = imageCreateInfo(request.desc, request.usage);
  share(info, request.concurrent);
  VkImage image = VK_NULL_HANDLE;
  checkForGraph(device_.vk().vkCreateImage(device_.handle(), &info, nullptr, &image), "vkCreateImage", request.name);
  const VkResult bound =
      device_.vk().vkBindImageMemory(device_.handle(), image, heaps_.at(heap).block.memory.get(), offset);
  if (bound != VK_SUCCESS) destroyImage(image);
  checkForGraph(bound, "vkBindImageMemory", request.name);
  device_.setName(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<uint64_t>(image), request.name);
  return image;
}

rendergraph::DedicatedImage GraphBackend::createDedicatedImage(const rendergraph::ImageRequest& request) {
  const auto& vk = device_.vk();
  auto info = imageCreateInfo(request.desc, request.usage);
  share(info, request.concurrent);
  VkImage made = VK_NULL_HANDLE;
  checkForGraph(vk.vkCreateImage(device_.handle(), &info, nullptr, &made), "vkCreateImage", request.name);
  Unique<VkImage> image(device_.handle(), made, vk.vkDestroyImage);
  VkMemoryRequirements needs;
  vk.vkGetImageMemoryRequirements(device_.handle(), made, &needs);
  VkMemoryDedicatedAllocateInfo owner{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO};
  owner.image = made;
  const auto heap = createDedicated(needs, rendergraph::MemoryKind::device, owner, request.name);
  const VkResult bound = vk.vkBindImageMemory(device_.handle(), made, heaps_.at(heap).block.memory.get(), 0);
  if (bound != VK_SUCCESS) {
    image.reset();
    destroyHeap(heap);
  }
  checkForGraph(bound, "vkBindImageMemory", request.name);
  device_.setName(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<uint64_t>(made), request.name);
  return {heap, image.release()};
}

void GraphBackend::destroyImage(VkImage image) {
  device_.vk().vkDestroyImage(device_.handle(), image, nullptr);
}

// ---- Buffers

VkBuffer GraphBackend::createBuffer(const rendergraph::BufferRequest& request, rendergraph::HeapId heap,
                                    VkDeviceSize offset) {
  auto info = bufferCreateInfo(request.desc.size, request.usage | request.desc.extraUsage);
  share(info, request.concurrent);
  VkBuffer buffer = VK_NULL_HANDLE;
  checkForGraph(device_.vk().vkCreateBuffer(device_.handle(), &info, nullptr, &buffer), "vkCreateBuffer", request.name);
  const VkResult bound =
      device_.vk().vkBindBufferMemory(device_.handle(), buffer, heaps_.at(heap).block.memory.get(), offset);
  if (bound != VK_SUCCESS) destroyBuffer(buffer);
  checkForGraph(bound, "vkBindBufferMemory", request.name);
  device_.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer), request.name);
  return buffer;
}

rendergraph::DedicatedBuffer GraphBackend::createDedicatedBuffer(const rendergraph::BufferRequest& request) {
  const auto& vk = device_.vk();
  auto info = bufferCreateInfo(request.desc.size, request.usage | request.desc.extraUsage);
  share(info, request.concurrent);
  VkBuffer made = VK_NULL_HANDLE;
  checkForGraph(vk.vkCreateBuffer(device_.handle(), &info, nullptr, &made), "vkCreateBuffer", request.name);
  Unique<VkBuffer> buffer(device_.handle(), made, vk.vkDestroyBuffer);
  VkMemoryRequirements needs;
  vk.vkGetBufferMemoryRequirements(device_.handle(), made, &needs);
  VkMemoryDedicatedAllocateInfo owner{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO};
  owner.buffer = made;
  const auto heap = createDedicated(needs, request.desc.memory, owner, request.name);
  const VkResult bound = vk.vkBindBufferMemory(device_.handle(), made, heaps_.at(heap).block.memory.get(), 0);
  if (bound != VK_SUCCESS) {
    buffer.reset();
    destroyHeap(heap);
  }
  checkForGraph(bound, "vkBindBufferMemory", request.name);
  device_.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(made), request.name);
  return {heap, buffer.release()};
}

void GraphBackend::destroyBuffer(VkBuffer buffer) {
  device_.vk().vkDestroyBuffer(device_.handle(), buffer, nullptr);
}

// ---- Views

VkImageView GraphBackend::createView(const rendergraph::ViewDesc& desc, std::string_view name) {
  VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.image = desc.image;
  info.viewType = desc.type;
  info.format = desc.format;
  info.subresourceRange = {desc.range.aspects, desc.range.firstMip, desc.range.mipCount, desc.range.firstLayer,
                           desc.range.layerCount};
  VkImageView view = VK_NULL_HANDLE;
  checkForGraph(device_.vk().vkCreateImageView(device_.handle(), &info, nullptr, &view), "vkCreateImageView", name);
  device_.setName(VK_OBJECT_TYPE_IMAGE_VIEW, reinterpret_cast<uint64_t>(view), name);
  return view;
}

void GraphBackend::destroyView(VkImageView view) {
  device_.vk().vkDestroyImageView(device_.handle(), view, nullptr);
}

}  // namespace lensgraph::engine
