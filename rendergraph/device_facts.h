// What compile() must know of a device: limits, queues, and the memory that images and buffers need.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>

#include "rendergraph/resource.h"

namespace lensgraph::rendergraph {

struct MemoryRequirements {
  VkDeviceSize size = 0;
  VkDeviceSize alignment = 1;
  uint32_t memoryTypeBits = UINT32_MAX;
  bool dedicated = false;  ///< The device wants an allocation for this resource alone; it is never aliased.
  bool operator==(const MemoryRequirements&) const = default;
};

/// One queue of a device. Every queue can transfer.
struct QueueFacts {
  uint32_t family = 0;  ///< Between queues of one family no ownership is transferred.
  bool graphics = true;
  bool compute = true;
  bool operator==(const QueueFacts&) const = default;
};

/// What compile() must know of a device. Pure: the same question always gets the same answer.
class DeviceFacts {
 public:
  virtual ~DeviceFacts() = default;
  virtual uint32_t maxImageSize() const { return 16384; }  ///< px.
  virtual uint32_t maxImageLayers() const { return 2048; }
  virtual VkDeviceSize maxBufferSize() const { return VkDeviceSize{1} << 31; }  ///< Bytes, of any buffer.
  /// Bytes of a buffer that shaders read or write as storage, and of one that they read as uniform: a binding shows the
  /// whole buffer.
  virtual VkDeviceSize maxStorageRange() const { return maxBufferSize(); }
  virtual VkDeviceSize maxUniformRange() const { return maxBufferSize(); }
  /// The queues that a plan may use, at least one. The first does graphics, compute and transfer; it takes what no
  /// other queue can do or nothing prefers elsewhere.
  virtual std::span<const QueueFacts> queues() const;
  virtual MemoryRequirements requirements(const ImageDesc& desc, VkImageUsageFlags usage) const = 0;
  virtual MemoryRequirements requirements(const BufferDesc& desc, VkBufferUsageFlags usage) const = 0;
};

/// A device that does not exist: linear sizes, 64 KiB alignment, one memory type. For tests and offline plans.
class NominalDevice : public DeviceFacts {
 public:
  MemoryRequirements requirements(const ImageDesc& desc, VkImageUsageFlags usage) const override;
  MemoryRequirements requirements(const BufferDesc& desc, VkBufferUsageFlags usage) const override;
};

}  // namespace lensgraph::rendergraph
