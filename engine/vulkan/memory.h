// Device memory: blocks for the graph's heaps, and buffers and images that the engine itself keeps (scene data).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/vulkan/device.h"
#include "engine/vulkan/vulkan_api.h"
#include "rendergraph/resource.h"

namespace lensgraph::engine {

/// One allocation of device memory. Host-visible kinds stay mapped.
struct MemoryBlock {
  Unique<VkDeviceMemory> memory;
  void* address = nullptr;  ///< Host address of upload and readback memory, else null.
};

/// Throws engine::Error when no type fits or memory runs out. `size` > 0, bytes.
/// `dedicated`: the image or buffer that the block is to hold alone, or null.
MemoryBlock allocateMemory(const Device& device, VkDeviceSize size, uint32_t memoryTypeBits,
                           rendergraph::MemoryKind kind, const VkMemoryDedicatedAllocateInfo* dedicated = nullptr);

/// A buffer with its own memory.
struct GpuBuffer {
  MemoryBlock block;
  Unique<VkBuffer> buffer;
  VkDeviceSize size = 0;
};
/// `size` 0 makes a buffer of 16 bytes, so that it can be bound.
GpuBuffer makeBuffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, rendergraph::MemoryKind kind,
                     const std::string& name);

/// A two-dimensional image with its own memory and a view of all of it, all mips and layers.
struct GpuImage {
  MemoryBlock block;
  Unique<VkImage> image;
  Unique<VkImageView> view;
  rendergraph::ImageDesc desc;
};
/// Makes it in device memory, with undefined content and layout. Throws engine::Error.
GpuImage makeImage(const Device& device, const rendergraph::ImageDesc& desc, VkImageUsageFlags usage,
                   const std::string& name);

/// Vulkan's description of an image of the graph (its extraUsage included) and of a buffer; for one queue family.
VkImageCreateInfo imageCreateInfo(const rendergraph::ImageDesc& desc, VkImageUsageFlags usage);
VkBufferCreateInfo bufferCreateInfo(VkDeviceSize size, VkBufferUsageFlags usage);

}  // namespace lensgraph::engine
