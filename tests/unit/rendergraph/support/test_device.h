// A device that does not exist, with chosen queues, memory types and wishes for dedicated memory.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "rendergraph/compiler.h"

namespace lensgraph {

class TestDevice : public rendergraph::NominalDevice {
 public:
  using Queues = std::vector<rendergraph::QueueFacts>;
  static inline const rendergraph::QueueFacts kAll{.family = 0};
  static inline const rendergraph::QueueFacts kAsyncCompute{.family = 1, .graphics = false};
  static inline const rendergraph::QueueFacts kTransfer{.family = 2, .graphics = false, .compute = false};

  /// `dedicatedFrom`: resources of at least so many bytes want memory of their own. With `severalMemoryTypes`,
  /// depth images, other images and buffers have no memory type in common with all others.
  explicit TestDevice(Queues queues = {kAll}, bool severalMemoryTypes = false,
                      VkDeviceSize dedicatedFrom = std::numeric_limits<VkDeviceSize>::max())
      : queues_(std::move(queues)), severalMemoryTypes_(severalMemoryTypes), dedicatedFrom_(dedicatedFrom) {}

  std::span<const rendergraph::QueueFacts> queues() const override { return queues_; }
  rendergraph::MemoryRequirements requirements(const rendergraph::ImageDesc& desc,
                                               VkImageUsageFlags usage) const override {
    const bool depth = (rendergraph::aspectsOf(desc.format) & VK_IMAGE_ASPECT_DEPTH_BIT) != 0;
    return adapted(NominalDevice::requirements(desc, usage), depth ? 0b001 : 0b011);
  }
  rendergraph::MemoryRequirements requirements(const rendergraph::BufferDesc& desc,
                                               VkBufferUsageFlags usage) const override {
    return adapted(NominalDevice::requirements(desc, usage), 0b110);
  }

 private:
  rendergraph::MemoryRequirements adapted(rendergraph::MemoryRequirements requirements, uint32_t types) const {
    if (severalMemoryTypes_) requirements.memoryTypeBits = types;
    requirements.dedicated = requirements.size >= dedicatedFrom_;
    return requirements;
  }

  Queues queues_;
  bool severalMemoryTypes_;
  VkDeviceSize dedicatedFrom_;
};

}  // namespace lensgraph
