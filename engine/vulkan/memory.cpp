// Chooses a memory type for a kind of memory, allocates it, and makes buffers and images with memory of their own.
#include "engine/vulkan/memory.h"

#include <algorithm>

#include "engine/vulkan/vulkan_functions.h"

namespace lensgraph::engine {
namespace {

struct KindProperties {
  VkMemoryPropertyFlags needed;
  VkMemoryPropertyFlags liked;
};

KindProperties propertiesOf(rendergraph::MemoryKind kind) {
  constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  switch (kind) {
    case rendergraph::MemoryKind::device:
      return {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    case rendergraph::MemoryKind::upload:
      return {kHost, 0};
    case rendergraph::MemoryKind::readback:
      return {kHost, VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
  }
  return {0, 0};
}

uint32_t findMemoryType(const Device& device, uint32_t typeBits, KindProperties properties) {
  const auto& memory = device.memory();
  for (const VkMemoryPropertyFlags wanted : {properties.needed | properties.liked, properties.needed}) {
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      const bool allowed = (typeBits >> i & 1u) != 0;
      if (allowed && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    }
  }
  throwDeviceError("no memory type fits a resource", "use another device");
}

}  // namespace

MemoryBlock allocateMemory(const Device& device, VkDeviceSize size, uint32_t memoryTypeBits,
                           rendergraph::MemoryKind kind, const VkMemoryDedicatedAllocateInfo* dedicated) {
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.pNext = dedicated;
  info.allocationSize = size;
  info.memoryTypeIndex = findMemoryType(device, memoryTypeBits, propertiesOf(kind));
  VkDeviceMemory memory = VK_NULL_HANDLE;
  const VkResult result = device.vk().vkAllocateMemory(device.handle(), &info, nullptr, &memory);
  check(result, "allocating " + std::to_string(size) + " bytes of device memory");
  MemoryBlock block;
  block.memory = {device.handle(), memory, device.vk().vkFreeMemory};
  if (kind != rendergraph::MemoryKind::device) {
    check(device.vk().vkMapMemory(device.handle(), memory, 0, VK_WHOLE_SIZE, 0, &block.address), "vkMapMemory");
  }
  return block;
}

VkImageCreateInfo imageCreateInfo(const rendergraph::ImageDesc& desc, VkImageUsageFlags usage) {
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = desc.format;
  info.extent = {desc.width, desc.height, 1};
  info.mipLevels = desc.mips;
  info.arrayLayers = desc.layers;
  info.samples = desc.samples;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = usage | desc.extraUsage;
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  return info;
}

VkBufferCreateInfo bufferCreateInfo(VkDeviceSize size, VkBufferUsageFlags usage) {
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = usage;
  return info;
}

GpuBuffer makeBuffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, rendergraph::MemoryKind kind,
                     const std::string& name) {
  const auto& vk = device.vk();
  const auto info = bufferCreateInfo(std::max<VkDeviceSize>(size, 16), usage);
  VkBuffer buffer = VK_NULL_HANDLE;
  check(vk.vkCreateBuffer(device.handle(), &info, nullptr, &buffer), "vkCreateBuffer " + name);
  GpuBuffer result;
  result.buffer = {device.handle(), buffer, vk.vkDestroyBuffer};
  result.size = info.size;
  VkMemoryRequirements requirements;
  vk.vkGetBufferMemoryRequirements(device.handle(), buffer, &requirements);
  result.block = allocateMemory(device, requirements.size, requirements.memoryTypeBits, kind);
  check(vk.vkBindBufferMemory(device.handle(), buffer, result.block.memory.get(), 0), "vkBindBufferMemory " + name);
  device.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer), name);
  return result;
}

GpuImage makeImage(const Device& device, const rendergraph::ImageDesc& desc, VkImageUsageFlags usage,
                   const std::string& name) {
  const auto& vk = device.vk();
  const auto info = imageCreateInfo(desc, usage);
  VkImage image = VK_NULL_HANDLE;
  check(vk.vkCreateImage(device.handle(), &info, nullptr, &image), "vkCreateImage " + name);
  GpuImage result;
  result.desc = desc;
  result.image = {device.handle(), image, vk.vkDestroyImage};
  VkMemoryRequirements requirements;
  vk.vkGetImageMemoryRequirements(device.handle(), image, &requirements);
  result.block =
      allocateMemory(device, requirements.size, requirements.memoryTypeBits, rendergraph::MemoryKind::device);
  check(vk.vkBindImageMemory(device.handle(), image, result.block.memory.get(), 0), "vkBindImageMemory " + name);
  VkImageViewCreateInfo viewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  viewInfo.image = image;
  viewInfo.viewType = desc.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
  viewInfo.format = desc.format;
  viewInfo.subresourceRange = {rendergraph::aspectsOf(desc.format), 0, desc.mips, 0, desc.layers};
  VkImageView view = VK_NULL_HANDLE;
  check(vk.vkCreateImageView(device.handle(), &viewInfo, nullptr, &view), "vkCreateImageView " + name);
  result.view = {device.handle(), view, vk.vkDestroyImageView};
  device.setName(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<uint64_t>(image), name);
  return result;
}

}  // namespace lensgraph::engine
