// The graph's objects on Vulkan: memory, images, buffers, views, time. Commands are in graph_backend_commands.cpp.
#include "engine/graph_backend.h"

#include <algorithm>
#include <string>

#include "rendergraph/error.h"

namespace engine {
namespace {

constexpr uint32_t kTimestamps = 8192;  // Two a pass: room for 4096 passes in one submission.

void require(VkResult result, const std::string& what, std::string_view resource) {
  if (result == VK_SUCCESS) return;
  const bool memory = result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY;
  throw rendergraph::GraphError({{.misuse = rendergraph::Misuse::device,
                                  .pass = {},
                                  .resource = std::string(resource),
                                  .reason = what + " failed: " + std::string(nameOf(result)),
                                  .remedy = memory ? "use a smaller picture or fewer layers" : "",
                                  .where = std::source_location::current()}});
}

}  // namespace

GraphBackend::GraphBackend(const Device& device)
    : device_(device), pipelines_(device, defaultPipelineCacheFile(device)), descriptors_(device), commands_(device) {
  VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = kTimestamps;
  VkQueryPool pool = VK_NULL_HANDLE;
  check(device.vk().vkCreateQueryPool(device.handle(), &info, nullptr, &pool), "vkCreateQueryPool");
  queries_ = {device.handle(), pool, device.vk().vkDestroyQueryPool};
}

GraphBackend::~GraphBackend() = default;

uint32_t GraphBackend::maxImageSize() const {
  return device_.limits().maxImageDimension2D;
}
uint32_t GraphBackend::maxImageLayers() const {
  return std::min(device_.limits().maxImageArrayLayers, device_.limits().maxFramebufferLayers);
}
VkDeviceSize GraphBackend::maxBufferSize() const {
  return device_.limits().maxStorageBufferRange;
}

rendergraph::MemoryRequirements GraphBackend::requirements(const rendergraph::ImageDesc& desc,
                                                           VkImageUsageFlags usage) const {
  const auto info = imageCreateInfo(desc, usage);
  VkDeviceImageMemoryRequirements query{VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS};
  query.pCreateInfo = &info;
  VkMemoryRequirements2 found{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
  device_.vk().vkGetDeviceImageMemoryRequirements(device_.handle(), &query, &found);
  // Images and buffers share heaps: the granularity between them is folded into every alignment.
  const auto& requirements = found.memoryRequirements;
  return {requirements.size, std::max(requirements.alignment, device_.limits().bufferImageGranularity),
          requirements.memoryTypeBits};
}

rendergraph::MemoryRequirements GraphBackend::requirements(const rendergraph::BufferDesc& desc,
                                                           VkBufferUsageFlags usage) const {
  const auto info = bufferCreateInfo(desc.size, usage | desc.extraUsage);
  VkDeviceBufferMemoryRequirements query{VK_STRUCTURE_TYPE_DEVICE_BUFFER_MEMORY_REQUIREMENTS};
  query.pCreateInfo = &info;
  VkMemoryRequirements2 found{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
  device_.vk().vkGetDeviceBufferMemoryRequirements(device_.handle(), &query, &found);
  const auto& requirements = found.memoryRequirements;
  return {requirements.size, std::max(requirements.alignment, device_.limits().bufferImageGranularity),
          requirements.memoryTypeBits};
}

rendergraph::HeapId GraphBackend::createHeap(VkDeviceSize size, uint32_t memoryTypeBits, rendergraph::MemoryKind memory,
                                             std::string_view name) {
  try {
    heaps_.emplace(nextHeap_, allocateMemory(device_, size, memoryTypeBits, memory));
  } catch (const std::exception& error) {
    throw rendergraph::GraphError({{.misuse = rendergraph::Misuse::device,
                                    .pass = {},
                                    .resource = std::string(name),
                                    .reason = error.what(),
                                    .remedy = "use a smaller picture or fewer layers",
                                    .where = std::source_location::current()}});
  }
  return nextHeap_++;
}

void GraphBackend::destroyHeap(rendergraph::HeapId heap) {
  heaps_.erase(heap);
}
void* GraphBackend::hostAddress(rendergraph::HeapId heap) {
  return heaps_.at(heap).address;
}

VkImage GraphBackend::createImage(const rendergraph::ImageDesc& desc, VkImageUsageFlags usage, rendergraph::HeapId heap,
                                  VkDeviceSize offset, std::string_view name) {
  const auto info = imageCreateInfo(desc, usage);
  VkImage image = VK_NULL_HANDLE;
  require(device_.vk().vkCreateImage(device_.handle(), &info, nullptr, &image), "vkCreateImage", name);
  const VkResult bound = device_.vk().vkBindImageMemory(device_.handle(), image, heaps_.at(heap).memory.get(), offset);
  if (bound != VK_SUCCESS) destroyImage(image);
  require(bound, "vkBindImageMemory", name);
  device_.setName(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<uint64_t>(image), std::string(name));
  return image;
}

void GraphBackend::destroyImage(VkImage image) {
  device_.vk().vkDestroyImage(device_.handle(), image, nullptr);
}

VkBuffer GraphBackend::createBuffer(const rendergraph::BufferDesc& desc, VkBufferUsageFlags usage,
                                    rendergraph::HeapId heap, VkDeviceSize offset, std::string_view name) {
  const auto info = bufferCreateInfo(desc.size, usage | desc.extraUsage);
  VkBuffer buffer = VK_NULL_HANDLE;
  require(device_.vk().vkCreateBuffer(device_.handle(), &info, nullptr, &buffer), "vkCreateBuffer", name);
  const VkResult bound =
      device_.vk().vkBindBufferMemory(device_.handle(), buffer, heaps_.at(heap).memory.get(), offset);
  if (bound != VK_SUCCESS) destroyBuffer(buffer);
  require(bound, "vkBindBufferMemory", name);
  device_.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer), std::string(name));
  return buffer;
}

void GraphBackend::destroyBuffer(VkBuffer buffer) {
  device_.vk().vkDestroyBuffer(device_.handle(), buffer, nullptr);
}

VkImageView GraphBackend::createView(const rendergraph::ViewDesc& desc, std::string_view name) {
  VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.image = desc.image;
  info.viewType = desc.type;
  info.format = desc.format;
  info.subresourceRange = {desc.range.aspects, desc.range.firstMip, desc.range.mipCount, desc.range.firstLayer,
                           desc.range.layerCount};
  VkImageView view = VK_NULL_HANDLE;
  require(device_.vk().vkCreateImageView(device_.handle(), &info, nullptr, &view), "vkCreateImageView", name);
  device_.setName(VK_OBJECT_TYPE_IMAGE_VIEW, reinterpret_cast<uint64_t>(view), std::string(name));
  return view;
}

void GraphBackend::destroyView(VkImageView view) {
  device_.vk().vkDestroyImageView(device_.handle(), view, nullptr);
}

uint32_t GraphBackend::maxTimestamps() const {
  return kTimestamps;
}

void GraphBackend::writeTimestamp(VkCommandBuffer commands, VkPipelineStageFlags2 stage, uint32_t slot) {
  device_.vk().vkCmdWriteTimestamp2(commands, stage, queries_.get(), slot);
}

void GraphBackend::readTimestamps(std::span<double> nanoseconds) {
  if (nanoseconds.empty()) return;
  ticks_.resize(nanoseconds.size());
  require(device_.vk().vkGetQueryPoolResults(device_.handle(), queries_.get(), 0, static_cast<uint32_t>(ticks_.size()),
                                             ticks_.size() * sizeof(uint64_t), ticks_.data(), sizeof(uint64_t),
                                             VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults", "timestamps");
  for (std::size_t i = 0; i < ticks_.size(); ++i) {
    // Relative to the first, so that a double keeps the nanoseconds.
    nanoseconds[i] = static_cast<double>(static_cast<int64_t>(ticks_[i] - ticks_[0])) *
                     static_cast<double>(device_.limits().timestampPeriod);
  }
}

}  // namespace engine
