// What the executor asks of a device. engine/graph/graph_backend implements it on Vulkan; a host engine may implement
// it on its own abstraction; tests implement it without a device.
//
// Failures throw GraphError (Misuse::device, outOfMemory, deviceLost) with the Vulkan result in words; a function that
// throws has made nothing.
//
// Threads: an executor calls from one thread at a time, except for what the section "Recording" marks: that is called
// from several threads at once, each with a recorder of its own. A host that uses several executors on several threads
// gives each its own backend, and makes submit() safe among the backends of one device.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <string_view>

#include "rendergraph/command_stream.h"
#include "rendergraph/device_facts.h"
#include "rendergraph/program.h"
#include "rendergraph/resource.h"

namespace lensgraph::rendergraph {

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
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;  ///< Of all attachments.
};

struct ImageRequest {
  const ImageDesc& desc;
  VkImageUsageFlags usage = 0;  ///< ImageDesc::extraUsage comes on top.
  bool concurrent = false;      ///< VK_SHARING_MODE_CONCURRENT among the families of queues(); else exclusive.
  std::string_view name;
};

struct BufferRequest {
  const BufferDesc& desc;
  VkBufferUsageFlags usage = 0;  ///< BufferDesc::extraUsage comes on top.
  bool concurrent = false;       ///< As in ImageRequest.
  std::string_view name;
};

/// An object and the memory that holds nothing else (VkMemoryDedicatedAllocateInfo).
struct DedicatedImage {
  HeapId heap = 0;
  VkImage image = VK_NULL_HANDLE;
};
struct DedicatedBuffer {
  HeapId heap = 0;
  VkBuffer buffer = VK_NULL_HANDLE;
};

class Backend : public DeviceFacts {
 public:
  // Memory and objects. They live until destroyed; destroy* wait for nothing: the executor calls them only after the
  // last submission that used the object has finished. Images and buffers are destroyed before their heaps.
  virtual HeapId createHeap(VkDeviceSize size, uint32_t memoryTypeBits, MemoryKind memory, std::string_view name) = 0;
  virtual void destroyHeap(HeapId heap) = 0;
  /// Host address of an upload or readback heap; valid until the heap is destroyed.
  virtual void* hostAddress(HeapId heap) = 0;
  virtual VkImage createImage(const ImageRequest& request, HeapId heap, VkDeviceSize offset) = 0;
  virtual DedicatedImage createDedicatedImage(const ImageRequest& request) = 0;
  virtual void destroyImage(VkImage image) = 0;
  virtual VkBuffer createBuffer(const BufferRequest& request, HeapId heap, VkDeviceSize offset) = 0;
  virtual DedicatedBuffer createDedicatedBuffer(const BufferRequest& request) = 0;
  virtual void destroyBuffer(VkBuffer buffer) = 0;
  /// Called from recordings too; the executor sees to it that one call is under way at a time.
  virtual VkImageView createView(const ViewDesc& desc, std::string_view name) = 0;
  virtual void destroyView(VkImageView view) = 0;
  /// Unset.
  virtual VkEvent createEvent(std::string_view name) = 0;
  virtual void destroyEvent(VkEvent event) = 0;
  /// Unsets it. No submission under way uses it.
  virtual void resetEvent(VkEvent event) = 0;

  // Recorders, for command buffers of one queue (index in queues()).
  virtual RecorderId createRecorder(uint32_t queue, std::string_view name) = 0;
  virtual void destroyRecorder(RecorderId recorder) = 0;
  /// Takes back every command buffer and transient object, to be handed out again; abandons what was begun and not
  /// ended. The device has finished with all of them.
  virtual void resetRecorder(RecorderId recorder) = 0;

  // Submission.
  /// A timeline semaphore with value 0.
  virtual VkSemaphore createTimeline(std::string_view name) = 0;
  virtual void destroyTimeline(VkSemaphore timeline) = 0;
  /// The value that it has reached.
  virtual uint64_t timelineValue(VkSemaphore timeline) = 0;
  /// Returns when all have reached their values. Throws GraphError (deviceLost) when they never will.
  virtual void waitTimelines(const VkSemaphoreWaitInfo& wait) = 0;
  /// Gives one batch of command buffers to a queue (index in queues()). It signals one timeline, to a value above all
  /// earlier ones.
  virtual void submit(uint32_t queue, const VkSubmitInfo2& submission) = 0;

  // Recording: from several threads at once, each with its own streams.
  /// Begins a command buffer for one submission. A recorder may have several, one begun after the other has ended.
  virtual CommandStream beginCommands(RecorderId recorder) = 0;
  virtual void endCommands(const CommandStream& commands) = 0;
  virtual void barrier(const CommandStream& commands, const VkDependencyInfo& dependency) = 0;
  /// The event is waited for with the same dependency.
  virtual void setEvent(const CommandStream& commands, VkEvent event, const VkDependencyInfo& dependency) = 0;
  virtual void waitEvent(const CommandStream& commands, VkEvent event, const VkDependencyInfo& dependency) = 0;
  virtual void beginRendering(const CommandStream& commands, const VkRenderingInfo& rendering) = 0;
  virtual void endRendering(const CommandStream& commands) = 0;
  virtual void beginLabel(const CommandStream& commands, std::string_view name) = 0;
  virtual void endLabel(const CommandStream& commands) = 0;
  virtual void dispatch(const CommandStream& commands, const ResolvedDispatch& dispatch) = 0;
  virtual void draw(const CommandStream& commands, const ResolvedDraw& draw) = 0;
  virtual void copyImage(const CommandStream& commands, VkImage from, VkImage to, const VkImageCopy& region) = 0;
  virtual void copyImageToBuffer(const CommandStream& commands, VkImage from, VkBuffer to,
                                 const VkBufferImageCopy& region) = 0;
  virtual void copyBuffer(const CommandStream& commands, VkBuffer from, VkBuffer to, VkDeviceSize bytes) = 0;
  /// `bytes` may be VK_WHOLE_SIZE.
  virtual void fillBuffer(const CommandStream& commands, VkBuffer to, uint32_t word, VkDeviceSize bytes) = 0;
  virtual void updateBuffer(const CommandStream& commands, VkBuffer to, VkDeviceSize offset,
                            std::span<const std::byte> bytes) = 0;
  /// The range is in layout TRANSFER_DST_OPTIMAL, as is the destination of copies; their source is in
  /// TRANSFER_SRC_OPTIMAL.
  virtual void clearImage(const CommandStream& commands, VkImage image, const VkClearColorValue& value,
                          const VkImageSubresourceRange& range) = 0;
  virtual void clearDepthImage(const CommandStream& commands, VkImage image, float depth,
                               const VkImageSubresourceRange& range) = 0;
  virtual void writeTimestamp(const CommandStream& commands, VkPipelineStageFlags2 stage, VkQueryPool pool,
                              uint32_t slot) = 0;

  // Time.
  /// Whether commands of this queue (index in queues()) can write timestamps.
  virtual bool hasTimestamps(uint32_t queue) const = 0;
  virtual double nanosecondsPerTick() const = 0;
  /// Slots 0 … count-1, unwritten.
  virtual VkQueryPool createTimestamps(uint32_t count, std::string_view name) = 0;
  virtual void destroyTimestamps(VkQueryPool pool) = 0;
  /// Makes the first `count` slots unwritten. No submission under way uses them.
  virtual void resetTimestamps(VkQueryPool pool, uint32_t count) = 0;
  /// Ticks of slots first, first + 1, …, of an arbitrary origin, which the device has written. Overflow wraps.
  virtual void readTimestamps(VkQueryPool pool, uint32_t first, std::span<uint64_t> ticks) = 0;
};

}  // namespace lensgraph::rendergraph
