// compile(): declaration in, plan out. A pure function: no Vulkan objects, no clock, no global state.
#pragma once

#include <cstdint>

#include "rendergraph/plan.h"
#include "rendergraph/resource.h"

namespace rendergraph {

struct Declaration;

struct MemoryRequirements {
  VkDeviceSize size = 0;
  VkDeviceSize alignment = 1;
  uint32_t memoryTypeBits = UINT32_MAX;
  bool operator==(const MemoryRequirements&) const = default;
};

/// What compile() must know of a device. Pure: the same question always gets the same answer.
class DeviceFacts {
 public:
  virtual ~DeviceFacts() = default;
  virtual uint32_t maxImageSize() const { return 16384; }  ///< px.
  virtual uint32_t maxImageLayers() const { return 2048; }
  virtual VkDeviceSize maxBufferSize() const { return VkDeviceSize{1} << 31; }
  virtual MemoryRequirements requirements(const ImageDesc& desc, VkImageUsageFlags usage) const = 0;
  virtual MemoryRequirements requirements(const BufferDesc& desc, VkBufferUsageFlags usage) const = 0;
};

/// A device that does not exist: linear sizes, 64 KiB alignment, one memory type. For tests and offline plans.
class NominalDevice : public DeviceFacts {
 public:
  MemoryRequirements requirements(const ImageDesc& desc, VkImageUsageFlags usage) const override;
  MemoryRequirements requirements(const BufferDesc& desc, VkBufferUsageFlags usage) const override;
};

enum class Order : uint8_t {
  declared,     ///< As the passes were declared.
  leastMemory,  ///< Greedy: the ready pass that keeps the fewest bytes alive.
  mostOverlap,  ///< Dependent passes far apart, so that barriers wait for nothing.
};

struct CompileOptions {
  Order order = Order::declared;
  bool aliasing = true;  ///< Off: every resource has its own memory (to measure what aliasing saves).
  bool operator==(const CompileOptions&) const = default;
};

/// Throws GraphError with every problem found. The declaration is not changed.
Plan compile(const Declaration& declaration, const CompileOptions& options, const DeviceFacts& device);

/// Hash over every field of the declaration that the plan depends on (not names, recordings, clear values or
/// the imported Vulkan objects).
uint64_t structuralHash(const Declaration& declaration, const CompileOptions& options);

}  // namespace rendergraph
