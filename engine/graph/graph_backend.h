// rendergraph::Backend on a Vulkan device: makes the graph's memory and objects, records and submits its commands.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "engine/vulkan/command_buffers.h"
#include "engine/vulkan/descriptors.h"
#include "engine/vulkan/device.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/pipelines.h"
#include "rendergraph/backend.h"

namespace lensgraph::engine {

/// Choices that change how the backend allocates, never what a frame looks like.
struct GraphBackendOptions {
  /// Memory of their own also for resources for which the driver merely prefers it. Off: where it demands it only. The
  /// driver's wish is for large attachments as a rule, those that the graph's aliasing saves most with, and what it
  /// gives for it (compression metadata, clears) is not in its answer; measure on the device in question.
  bool dedicatedWherePreferred = false;
};

/// Recording is thread-safe as rendergraph::Backend asks; everything else is for one thread at a time. Several backends
/// may serve one device, on several threads. The device outlives it. Vulkan failures become GraphErrors.
class GraphBackend final : public rendergraph::Backend {
 public:
  using CommandStream = rendergraph::CommandStream;
  using RecorderId = rendergraph::RecorderId;

  /// Pipelines are cached on disk in defaultPipelineCacheFile().
  explicit GraphBackend(const Device& device, const GraphBackendOptions& options = {});
  ~GraphBackend() override;

  const Device& device() const { return device_; }
  /// Pipelines, set layouts and samplers of this backend, for recordings that make their own.
  PipelineStore& pipelines() { return pipelines_; }
  /// A set with `bindings` as bindings 0, 1, …, which lives until the frame that the stream belongs to has finished.
  VkDescriptorSet transientSet(const CommandStream& commands, VkDescriptorSetLayout layout,
                               std::span<const rendergraph::ResolvedBinding> bindings);
  /// Writes `bindings` to bindings 0, 1, … of a set of the caller.
  void writeSet(VkDescriptorSet set, std::span<const rendergraph::ResolvedBinding> bindings);
  /// Bytes of memory in use and the number of blocks.
  VkDeviceSize allocatedBytes() const { return allocatedBytes_; }
  std::size_t heapCount() const { return heaps_.size(); }

  // DeviceFacts
  uint32_t maxImageSize() const override;
  uint32_t maxImageLayers() const override;
  VkDeviceSize maxBufferSize() const override;
  VkDeviceSize maxStorageRange() const override;
  VkDeviceSize maxUniformRange() const override;
  std::span<const rendergraph::QueueFacts> queues() const override { return queues_; }
  rendergraph::MemoryRequirements requirements(const rendergraph::ImageDesc& desc,
                                               VkImageUsageFlags usage) const override;
  rendergraph::MemoryRequirements requirements(const rendergraph::BufferDesc& desc,
                                               VkBufferUsageFlags usage) const override;

  // Objects
  rendergraph::HeapId createHeap(VkDeviceSize size, uint32_t memoryTypeBits, rendergraph::MemoryKind memory,
                                 std::string_view name) override;
  void destroyHeap(rendergraph::HeapId heap) override;
  void* hostAddress(rendergraph::HeapId heap) override;
  VkImage createImage(const rendergraph::ImageRequest& request, rendergraph::HeapId heap, VkDeviceSize offset) override;
  rendergraph::DedicatedImage createDedicatedImage(const rendergraph::ImageRequest& request) override;
  void destroyImage(VkImage image) override;
  VkBuffer createBuffer(const rendergraph::BufferRequest& request, rendergraph::HeapId heap,
                        VkDeviceSize offset) override;
  rendergraph::DedicatedBuffer createDedicatedBuffer(const rendergraph::BufferRequest& request) override;
  void destroyBuffer(VkBuffer buffer) override;
  VkImageView createView(const rendergraph::ViewDesc& desc, std::string_view name) override;
  void destroyView(VkImageView view) override;
  VkEvent createEvent(std::string_view name) override;
  void destroyEvent(VkEvent event) override;
  void resetEvent(VkEvent event) override;

  // Recorders and submission
  RecorderId createRecorder(uint32_t queue, std::string_view name) override;
  void destroyRecorder(RecorderId recorder) override;
  void resetRecorder(RecorderId recorder) override;
  VkSemaphore createTimeline(std::string_view name) override;
  void destroyTimeline(VkSemaphore timeline) override;
  uint64_t timelineValue(VkSemaphore timeline) override;
  void waitTimelines(const VkSemaphoreWaitInfo& wait) override;
  void submit(uint32_t queue, const VkSubmitInfo2& submission) override;

  // Recording
  CommandStream beginCommands(RecorderId recorder) override;
  void endCommands(const CommandStream& commands) override;
  void barrier(const CommandStream& commands, const VkDependencyInfo& dependency) override;
  void setEvent(const CommandStream& commands, VkEvent event, const VkDependencyInfo& dependency) override;
  void waitEvent(const CommandStream& commands, VkEvent event, const VkDependencyInfo& dependency) override;
  void beginRendering(const CommandStream& commands, const VkRenderingInfo& rendering) override;
  void endRendering(const CommandStream& commands) override;
  void beginLabel(const CommandStream& commands, std::string_view name) override;
  void endLabel(const CommandStream& commands) override;
  void dispatch(const CommandStream& commands, const rendergraph::ResolvedDispatch& dispatch) override;
  void draw(const CommandStream& commands, const rendergraph::ResolvedDraw& draw) override;
  void copyImage(const CommandStream& commands, VkImage from, VkImage to, const VkImageCopy& region) override;
  void copyImageToBuffer(const CommandStream& commands, VkImage from, VkBuffer to,
                         const VkBufferImageCopy& region) override;
  void copyBuffer(const CommandStream& commands, VkBuffer from, VkBuffer to, VkDeviceSize bytes) override;
  void fillBuffer(const CommandStream& commands, VkBuffer to, uint32_t word, VkDeviceSize bytes) override;
  void updateBuffer(const CommandStream& commands, VkBuffer to, VkDeviceSize offset,
                    std::span<const std::byte> bytes) override;
  void clearImage(const CommandStream& commands, VkImage image, const VkClearColorValue& value,
                  const VkImageSubresourceRange& range) override;
  void clearDepthImage(const CommandStream& commands, VkImage image, float depth,
                       const VkImageSubresourceRange& range) override;
  void writeTimestamp(const CommandStream& commands, VkPipelineStageFlags2 stage, VkQueryPool pool,
                      uint32_t slot) override;

  // Time
  bool hasTimestamps(uint32_t queue) const override;
  double nanosecondsPerTick() const override;
  VkQueryPool createTimestamps(uint32_t count, std::string_view name) override;
  void destroyTimestamps(VkQueryPool pool) override;
  void resetTimestamps(VkQueryPool pool, uint32_t count) override;
  void readTimestamps(VkQueryPool pool, uint32_t first, std::span<uint64_t> ticks) override;

 private:
  /// One recorder: used by one thread at a time.
  struct Recorder {
    CommandPool pool;
    DescriptorRing descriptors;
    SetWriter writer;
    std::vector<BindingKind> kinds;
  };
  /// Signalled with a timeline's value.
  struct SentFence {
    VkSemaphore timeline;
    uint64_t value;
    Unique<VkFence> fence;
  };
  struct Heap {
    MemoryBlock block;
    VkDeviceSize size = 0;
  };
  static Recorder& recorderOf(const CommandStream& commands) { return *reinterpret_cast<Recorder*>(commands.recorder); }

  void bind(const CommandStream& commands, VkPipelineBindPoint point, const BoundPipeline& pipeline,
            std::span<const rendergraph::ResolvedBinding> bindings, std::span<const std::byte> pushConstants);
  Unique<VkFence> takeFence();
  template <class CreateInfo>
  void share(CreateInfo& info, bool concurrent) const;
  rendergraph::MemoryRequirements folded(const VkMemoryRequirements2& found) const;
  rendergraph::HeapId keep(MemoryBlock block, VkDeviceSize size, std::string_view name);
  rendergraph::HeapId createDedicated(const VkMemoryRequirements& needs, rendergraph::MemoryKind memory,
                                      const VkMemoryDedicatedAllocateInfo& owner, std::string_view name);

  const Device& device_;
  GraphBackendOptions options_;
  std::vector<rendergraph::QueueFacts> queues_;
  std::vector<uint32_t> families_;  ///< Of queues_, each once.
  PipelineStore pipelines_;
  std::unordered_map<rendergraph::HeapId, Heap> heaps_;
  rendergraph::HeapId nextHeap_ = 1;
  VkDeviceSize allocatedBytes_ = 0;
  std::vector<std::unique_ptr<Recorder>> recorders_;
  std::vector<SentFence> sent_;
  std::vector<Unique<VkFence>> fences_;  ///< Unsignalled, to be used again.
};

}  // namespace lensgraph::engine
