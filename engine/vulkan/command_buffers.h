// Command buffers: pools of them, one-off submissions that are waited for, and uploads through staging memory.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/vulkan/device.h"
#include "engine/vulkan/memory.h"

namespace lensgraph::engine {

/// Command buffers for one queue (index in Device::queues()), used by one thread at a time and taken back together.
class CommandPool {
 public:
  CommandPool(const Device& device, uint32_t queue, std::string_view name);

  /// Begins a command buffer that is submitted once. Throws engine::Error when the device is out of memory.
  VkCommandBuffer begin();
  /// Takes all back, whether ended or not. Precondition: the device has finished with them.
  void reset();

 private:
  const Device& device_;
  std::string name_;
  Unique<VkCommandPool> pool_;
  std::vector<VkCommandBuffer> buffers_;
  std::size_t used_ = 0;
};

/// Records with `record`, submits and waits.
void runOnce(const Device& device, const std::function<void(VkCommandBuffer)>& record);

/// Copies bytes into a device-local buffer; done when it returns.
void upload(const Device& device, const GpuBuffer& target, std::span<const std::byte> bytes);

/// Copies tightly packed texels of every mip, largest first, into an image of one layer; layout UNDEFINED to
/// SHADER_READ_ONLY_OPTIMAL. Done when it returns.
void upload(const Device& device, const GpuImage& target, std::span<const std::byte> texels);

}  // namespace lensgraph::engine
