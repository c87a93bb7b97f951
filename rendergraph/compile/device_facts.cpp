// Defaults of DeviceFacts, and the sizes of the nominal device.
#include "rendergraph/device_facts.h"

#include <algorithm>

namespace lensgraph::rendergraph {

namespace {

constexpr VkDeviceSize kAlignment = 64 * 1024;  // Bytes; what most desktop drivers ask of images.

MemoryRequirements aligned(VkDeviceSize bytes) {
  return {.size = (bytes + kAlignment - 1) / kAlignment * kAlignment, .alignment = kAlignment, .memoryTypeBits = 1};
}

}  // namespace

std::span<const QueueFacts> DeviceFacts::queues() const {
  static constexpr QueueFacts kOne;
  return {&kOne, 1};
}

MemoryRequirements NominalDevice::requirements(const ImageDesc& desc, VkImageUsageFlags) const {
  // A format whose size we do not know counts as 4 bytes a texel.
  const VkDeviceSize texel = texelSize(desc.format) != 0 ? texelSize(desc.format) : 4;
  VkDeviceSize texels = 0;
  for (uint32_t level = 0; level < desc.mips; ++level) {
    const VkExtent2D extent = mipExtent(desc, level);
    texels += VkDeviceSize{extent.width} * extent.height;
  }
  return aligned(texels * desc.layers * desc.samples * texel);
}

MemoryRequirements NominalDevice::requirements(const BufferDesc& desc, VkBufferUsageFlags) const {
  return aligned(desc.size);
}

}  // namespace lensgraph::rendergraph
