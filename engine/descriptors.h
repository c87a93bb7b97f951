// Descriptor sets that live for one submission, from pools that grow to the frame's need and are then reused.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/device.h"
#include "engine/vulkan_api.h"

namespace engine {

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

}  // namespace engine
