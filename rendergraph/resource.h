// Descriptions of images and buffers: plain data, comparable, no Vulkan objects.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace lensgraph::rendergraph {

/// A range of mips and layers. The default names the whole image.
struct Subresources {
  static constexpr uint32_t kAll = UINT32_MAX;
  uint32_t firstMip = 0;
  uint32_t mipCount = kAll;  ///< kAll: to the last mip.
  uint32_t firstLayer = 0;
  uint32_t layerCount = kAll;      ///< kAll: to the last layer.
  VkImageAspectFlags aspects = 0;  ///< 0: every aspect of the format.
  bool operator==(const Subresources&) const = default;
  /// Whether it is the default. By bits, since every declared access asks.
  constexpr bool namesAll() const { return (firstMip | firstLayer | aspects) == 0 && (mipCount & layerCount) == kAll; }
};

/// One mip, all layers.
constexpr Subresources mip(uint32_t level) {
  return {.firstMip = level, .mipCount = 1};
}
/// One layer, all mips.
constexpr Subresources layer(uint32_t index) {
  return {.firstLayer = index, .layerCount = 1};
}

/// A two-dimensional image that the graph creates. Usage flags follow from the declared accesses.
struct ImageDesc {
  VkFormat format = VK_FORMAT_UNDEFINED;
  uint32_t width = 0;   ///< px, 1 … device limit.
  uint32_t height = 0;  ///< px, 1 … device limit.
  uint32_t layers = 1;  ///< Array layers, 1 … device limit.
  uint32_t mips = 1;    ///< Mip levels, 1 … floor(log2(max(width, height))) + 1.
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  VkImageUsageFlags extraUsage = 0;  ///< Usage that no access of the graph implies (a host's own).
  bool operator==(const ImageDesc&) const = default;
};

/// Where a buffer's memory lies. Buffers of different kinds never share a heap.
enum class MemoryKind : uint32_t {
  device,    ///< Device-local; not reachable by the host.
  upload,    ///< Host writes, device reads.
  readback,  ///< Device writes, host reads.
};

/// A buffer that the graph creates. Usage flags follow from the declared accesses.
struct BufferDesc {
  VkDeviceSize size = 0;  ///< Bytes, 1 … device limit.
  MemoryKind memory = MemoryKind::device;
  VkBufferUsageFlags extraUsage = 0;
  bool operator==(const BufferDesc&) const = default;
};

/// Synchronization scope and layout of a resource at one moment; at the edge of the graph.
struct AccessState {
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 access = VK_ACCESS_2_NONE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< Ignored for buffers.
  bool operator==(const AccessState&) const = default;
};

/// An image of the host. The host keeps it alive until the last submission that uses it has finished.
/// `before` with layout UNDEFINED means that its content is not read, only written.
struct ImportedImage {
  VkImage image = VK_NULL_HANDLE;
  VkImageUsageFlags usage = 0;  ///< The usage the host created it with; accesses are checked against it.
  AccessState before;           ///< What the host did last with it.
  AccessState after;            ///< What the host does next with it; layout UNDEFINED: left as the last pass had it.
};

/// A buffer of the host; lifetime as for ImportedImage.
struct ImportedBuffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkBufferUsageFlags usage = 0;
  AccessState before;
  AccessState after;
};

/// Aspects of a format: colour, depth, stencil.
VkImageAspectFlags aspectsOf(VkFormat format);
/// Bytes per texel of the uncompressed formats; 0 for others.
uint32_t texelSize(VkFormat format);

/// The same image with all sides divided, rounded up, at least 1 px; one mip.
constexpr ImageDesc dividedBy(ImageDesc desc, uint32_t divisor) {
  desc.width = (desc.width + divisor - 1) / divisor;
  desc.height = (desc.height + divisor - 1) / divisor;
  desc.mips = 1;
  return desc;
}
/// The same image in another format.
constexpr ImageDesc withFormat(ImageDesc desc, VkFormat format) {
  desc.format = format;
  return desc;
}

/// Size of a mip level, px.
VkExtent2D mipExtent(const ImageDesc& desc, uint32_t level);
/// Levels of a complete mip chain.
uint32_t fullMipCount(uint32_t width, uint32_t height);

}  // namespace lensgraph::rendergraph
