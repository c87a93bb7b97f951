// What the executor asks of a device. engine/graph_backend implements it on Vulkan; a host engine may implement
// it on its own abstraction; tests implement it without a device.
//
// Failures throw GraphError (Misuse::device) with the Vulkan result in words.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <string_view>

#include "rendergraph/compiler.h"
#include "rendergraph/program.h"
#include "rendergraph/resource.h"

namespace rendergraph {

/// A memory block of the backend; 0 is none.
using HeapId = uint64_t;

struct ViewDesc {
  VkImage image = VK_NULL_HANDLE;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageViewType type = VK_IMAGE_VIEW_TYPE_2D;
  Subresources range;  ///< Resolved.
  bool operator==(const ViewDesc&) const = default;
};

/// Binding with its graph handle replaced by Vulkan objects.
struct ResolvedBinding {
  Binding::Kind kind;
  VkImageView view = VK_NULL_HANDLE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  SamplerDesc sampler;
  VkBuffer buffer = VK_NULL_HANDLE;
};

struct ResolvedDispatch {
  const ComputeProgram& program;
  std::span<const ResolvedBinding> bindings;
  std::span<const std::byte> pushConstants;
  std::span<const uint32_t> specialization;
  Groups groups;
  VkBuffer indirect = VK_NULL_HANDLE;
  VkDeviceSize indirectOffset = 0;
};

struct ResolvedDraw {
  const RasterProgram& program;
  std::span<const ResolvedBinding> bindings;
  std::span<const std::byte> pushConstants;
  std::span<const uint32_t> specialization;
  uint32_t vertexCount = 3;
  uint32_t instanceCount = 1;
  VkExtent2D renderArea;
  std::span<const VkFormat> colorFormats;
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;
};

class Backend : public DeviceFacts {
 public:
  // Memory and objects. Objects made here live until destroyed; destroy* wait for nothing: the executor calls them
  // only after the last submission that used the object has finished.
  virtual HeapId createHeap(const VkDeviceSize size, uint32_t memoryTypeBits, MemoryKind memory,
                            std::string_view name) = 0;
  virtual void destroyHeap(HeapId heap) = 0;
  /// Host address of an upload or readback heap; valid until the heap is destroyed.
  virtual void* hostAddress(HeapId heap) = 0;
  virtual VkImage createImage(const ImageDesc& desc, VkImageUsageFlags usage, HeapId heap, VkDeviceSize offset,
                              std::string_view name) = 0;
  virtual void destroyImage(VkImage image) = 0;
  virtual VkBuffer createBuffer(const BufferDesc& desc, VkBufferUsageFlags usage, HeapId heap, VkDeviceSize offset,
                                std::string_view name) = 0;
  virtual void destroyBuffer(VkBuffer buffer) = 0;
  virtual VkImageView createView(const ViewDesc& desc, std::string_view name) = 0;
  virtual void destroyView(VkImageView view) = 0;

  // Commands. One command buffer is open at a time in this version.
  /// Begins a command buffer; transient objects (descriptor sets) of the submission before are recycled. When the
  /// command buffer begun before was never submitted (a recording threw), it is abandoned and its content dropped.
  virtual VkCommandBuffer beginCommands() = 0;
  /// Ends, submits and waits until the device is done.
  virtual void submitAndWait(VkCommandBuffer commands) = 0;
  virtual void barrier(VkCommandBuffer commands, const VkDependencyInfo& dependency) = 0;
  virtual void beginRendering(VkCommandBuffer commands, const VkRenderingInfo& rendering) = 0;
  virtual void endRendering(VkCommandBuffer commands) = 0;
  virtual void beginLabel(VkCommandBuffer commands, std::string_view name) = 0;
  virtual void endLabel(VkCommandBuffer commands) = 0;
  virtual void dispatch(VkCommandBuffer commands, const ResolvedDispatch& dispatch) = 0;
  virtual void draw(VkCommandBuffer commands, const ResolvedDraw& draw) = 0;
  virtual void copyImage(VkCommandBuffer commands, VkImage from, VkImage to, const VkImageCopy& region) = 0;
  virtual void copyImageToBuffer(VkCommandBuffer commands, VkImage from, VkBuffer to,
                                 const VkBufferImageCopy& region) = 0;
  virtual void copyBuffer(VkCommandBuffer commands, VkBuffer from, VkBuffer to, VkDeviceSize bytes) = 0;
  virtual void fillBuffer(VkCommandBuffer commands, VkBuffer to, uint32_t word) = 0;
  /// The range is in layout TRANSFER_DST_OPTIMAL, as is the destination of copies; their source is in
  /// TRANSFER_SRC_OPTIMAL.
  virtual void clearImage(VkCommandBuffer commands, VkImage image, const VkClearColorValue& value,
                          const VkImageSubresourceRange& range) = 0;
  virtual void clearDepthImage(VkCommandBuffer commands, VkImage image, float depth,
                               const VkImageSubresourceRange& range) = 0;

  // Time. Slots are reset by beginCommands(); 0 … maxTimestamps()-1.
  virtual uint32_t maxTimestamps() const = 0;
  virtual void writeTimestamp(VkCommandBuffer commands, VkPipelineStageFlags2 stage, uint32_t slot) = 0;
  /// After submitAndWait: nanoseconds of slots 0 … count-1, of an arbitrary origin.
  virtual void readTimestamps(std::span<double> nanoseconds) = 0;
};

}  // namespace rendergraph
