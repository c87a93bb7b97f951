// Descriptor sets that live for one frame, from pools that grow to the frame's need and are then reused.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/vulkan/device.h"
#include "engine/vulkan/pipelines.h"
#include "engine/vulkan/vulkan_api.h"
#include "rendergraph/backend.h"

namespace lensgraph::engine {

/// Used by one thread at a time.
class DescriptorRing {
 public:
  explicit DescriptorRing(const Device& device) : device_(device) {}

  /// Takes back every set. Precondition: the device has finished with them.
  void reset();
  /// Throws engine::Error when the device is out of memory.
  VkDescriptorSet allocate(VkDescriptorSetLayout layout);

 private:
  void addPool();
  const Device& device_;
  std::vector<Unique<VkDescriptorPool>> pools_;
  std::size_t current_ = 0;
};

/// Writes sets; keeps its memory from call to call.
class SetWriter {
 public:
  /// `bindings` become bindings 0, 1, … of the set.
  void write(const Device& device, PipelineStore& pipelines, VkDescriptorSet set,
             std::span<const rendergraph::ResolvedBinding> bindings);

 private:
  std::vector<VkDescriptorImageInfo> images_;
  std::vector<VkDescriptorBufferInfo> buffers_;
  std::vector<VkWriteDescriptorSet> writes_;
};

}  // namespace lensgraph::engine
