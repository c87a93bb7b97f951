// Command buffers: one pool, one-off submissions that are waited for, and uploads through staging memory.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "engine/device.h"
#include "engine/memory.h"

namespace engine {

/// A command buffer that is recorded, submitted and waited for, again and again. Not thread-safe.
class CommandLoop {
 public:
  explicit CommandLoop(const Device& device);
  CommandLoop(const CommandLoop&) = delete;
  CommandLoop& operator=(const CommandLoop&) = delete;

  /// Begins recording. Precondition: the submission before has been waited for (submitAndWait does).
  VkCommandBuffer begin();
  /// Ends, submits and waits. Throws engine::Error when the device is lost.
  void submitAndWait();

 private:
  const Device& device_;
  Unique<VkCommandPool> pool_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  Unique<VkFence> fence_;
};

/// Records with `record`, submits and waits.
void runOnce(const Device& device, const std::function<void(VkCommandBuffer)>& record);

/// Copies bytes into a device-local buffer; done when it returns.
void upload(const Device& device, const GpuBuffer& target, std::span<const std::byte> bytes);

/// Copies tightly packed texels of every mip, largest first, into an image of one layer; layout UNDEFINED to
/// SHADER_READ_ONLY_OPTIMAL. Done when it returns.
void upload(const Device& device, const GpuImage& target, std::span<const std::byte> texels);

}  // namespace engine
