// rendergraph::Backend on a Vulkan device: makes the graph's memory and objects, records and submits its commands.
#pragma once

#include <unordered_map>
#include <vector>

#include "engine/commands.h"
#include "engine/descriptors.h"
#include "engine/device.h"
#include "engine/memory.h"
#include "engine/pipelines.h"
#include "rendergraph/backend.h"

namespace engine {

/// Not thread-safe. The device outlives it. Vulkan failures become GraphErrors (Misuse::device).
class GraphBackend final : public rendergraph::Backend {
 public:
  /// Pipelines are cached on disk in defaultPipelineCacheFile().
  explicit GraphBackend(const Device& device);
  ~GraphBackend() override;

  const Device& device() const { return device_; }
  PipelineStore& pipelines() { return pipelines_; }
  /// A set that lives until the submission being recorded has finished.
  VkDescriptorSet transientSet(VkDescriptorSetLayout layout) { return descriptors_.allocate(layout); }
  /// Writes `bindings` to bindings 0, 1, … of the set.
  void writeSet(VkDescriptorSet set, std::span<const rendergraph::ResolvedBinding> bindings);

  // DeviceFacts
  uint32_t maxImageSize() const override;
  uint32_t maxImageLayers() const override;
  VkDeviceSize maxBufferSize() const override;
  rendergraph::MemoryRequirements requirements(const rendergraph::ImageDesc& desc,
                                               VkImageUsageFlags usage) const override;
  rendergraph::MemoryRequirements requirements(const rendergraph::BufferDesc& desc,
                                               VkBufferUsageFlags usage) const override;

  // Objects
  rendergraph::HeapId createHeap(VkDeviceSize size, uint32_t memoryTypeBits, rendergraph::MemoryKind memory,
                                 std::string_view name) override;
  void destroyHeap(rendergraph::HeapId heap) override;
  void* hostAddress(rendergraph::HeapId heap) override;
  VkImage createImage(const rendergraph::ImageDesc& desc, VkImageUsageFlags usage, rendergraph::HeapId heap,
                      VkDeviceSize offset, std::string_view name) override;
  void destroyImage(VkImage image) override;
  VkBuffer createBuffer(const rendergraph::BufferDesc& desc, VkBufferUsageFlags usage, rendergraph::HeapId heap,
                        VkDeviceSize offset, std::string_view name) override;
  void destroyBuffer(VkBuffer buffer) override;
  VkImageView createView(const rendergraph::ViewDesc& desc, std::string_view name) override;
  void destroyView(VkImageView view) override;

  // Commands
  VkCommandBuffer beginCommands() override;
  void submitAndWait(VkCommandBuffer commands) override;
  void barrier(VkCommandBuffer commands, const VkDependencyInfo& dependency) override;
  void beginRendering(VkCommandBuffer commands, const VkRenderingInfo& rendering) override;
  void endRendering(VkCommandBuffer commands) override;
  void beginLabel(VkCommandBuffer commands, std::string_view name) override;
  void endLabel(VkCommandBuffer commands) override;
  void dispatch(VkCommandBuffer commands, const rendergraph::ResolvedDispatch& dispatch) override;
  void draw(VkCommandBuffer commands, const rendergraph::ResolvedDraw& draw) override;
  void copyImage(VkCommandBuffer commands, VkImage from, VkImage to, const VkImageCopy& region) override;
  void copyImageToBuffer(VkCommandBuffer commands, VkImage from, VkBuffer to, const VkBufferImageCopy& region) override;
  void copyBuffer(VkCommandBuffer commands, VkBuffer from, VkBuffer to, VkDeviceSize bytes) override;
  void fillBuffer(VkCommandBuffer commands, VkBuffer to, uint32_t word) override;
  void clearImage(VkCommandBuffer commands, VkImage image, const VkClearColorValue& value,
                  const VkImageSubresourceRange& range) override;
  void clearDepthImage(VkCommandBuffer commands, VkImage image, float depth,
                       const VkImageSubresourceRange& range) override;

  // Time
  uint32_t maxTimestamps() const override;
  void writeTimestamp(VkCommandBuffer commands, VkPipelineStageFlags2 stage, uint32_t slot) override;
  void readTimestamps(std::span<double> nanoseconds) override;

 private:
  void bind(VkCommandBuffer commands, VkPipelineBindPoint point, const BoundPipeline& pipeline,
            std::span<const rendergraph::ResolvedBinding> bindings, std::span<const std::byte> pushConstants);
  std::span<const BindingKind> kindsOf(std::span<const rendergraph::ResolvedBinding> bindings);

  const Device& device_;
  PipelineStore pipelines_;
  DescriptorRing descriptors_;
  CommandLoop commands_;
  Unique<VkQueryPool> queries_;
  std::unordered_map<rendergraph::HeapId, MemoryBlock> heaps_;
  rendergraph::HeapId nextHeap_ = 1;
  // Reused between calls, so that recording allocates nothing.
  std::vector<BindingKind> kinds_;
  std::vector<VkDescriptorImageInfo> imageInfos_;
  std::vector<VkDescriptorBufferInfo> bufferInfos_;
  std::vector<VkWriteDescriptorSet> writes_;
  std::vector<uint64_t> ticks_;
};

}  // namespace engine
