// One Vulkan device: a queue for graphics, compute and transfer, and those that work beside it where there are any.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "engine/vulkan/vulkan_api.h"
#include "engine/vulkan/vulkan_instance.h"

namespace lensgraph::engine {

struct DeviceFunctions;

/// Which device, and whether it is watched.
struct DeviceOptions {
  /// Index in listDevices(), or part of a device's name (any case). Empty: the most capable usable device
  /// (discrete, then integrated, virtual, CPU).
  std::string select;
  bool validation = false;  ///< Core and synchronization validation; messages in Device::validationLog().
};

/// A device in words, for lists and errors.
struct DeviceDescription {
  std::string name;                  ///< As the driver says it.
  std::string type;                  ///< "discrete", "integrated", "virtual", "cpu", "other".
  std::string driver;                ///< Driver name and version.
  std::vector<std::string> missing;  ///< Features we need that it lacks; empty when usable.
};

/// All Vulkan devices of this machine, usable or not, in the loader's order. Throws engine::Error without a loader.
std::vector<DeviceDescription> listDevices();

/// One queue of a device.
struct DeviceQueue {
  std::string name;  ///< "graphics", "compute", "transfer".
  VkQueue handle = VK_NULL_HANDLE;
  uint32_t family = 0;         ///< Index of its queue family.
  bool graphics = false;       ///< Whether it draws …
  bool compute = false;        ///< … and dispatches. Every queue copies.
  uint32_t timestampBits = 0;  ///< Valid bits of its timestamps; 0: it writes none.
};

/// A VkDevice of its own instance, and what is asked of it again and again. Several may be alive at once. Const
/// functions may be called from any thread.
class Device {
 public:
  /// Throws engine::Error when no device fits, naming what the best candidate lacks.
  explicit Device(const DeviceOptions& options = {});
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceDescription& description() const { return description_; }
  VkInstance instance() const { return instance_.handle(); }
  VkPhysicalDevice physical() const { return physical_; }
  VkDevice handle() const { return device_; }
  /// The first does everything; then, from families without graphics, one for compute and one that only copies, where
  /// the device has such families.
  const std::vector<DeviceQueue>& queues() const { return queues_; }
  /// vkQueueSubmit2 of one batch, by index in queues(). From any thread: Vulkan wants one at a time.
  VkResult submit(uint32_t queue, const VkSubmitInfo2& submission, VkFence fence = VK_NULL_HANDLE) const;
  /// The functions to call with this device, its queues and command buffers: vulkan_functions.h.
  const DeviceFunctions& vk() const { return *functions_; }
  /// The physical device's limits and memory types, asked for once.
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  VkDeviceSize maxBufferSize() const { return maxBufferSize_; }  ///< Bytes; larger ones may not be made.
  const VkPhysicalDeviceMemoryProperties& memory() const { return memory_; }

  /// Everything the validation layers have said; empty without validation. Outlives the device.
  const std::shared_ptr<ValidationLog>& validationLog() const { return instance_.log(); }

  /// A name for debuggers and validation messages; does nothing without debug utils.
  void setName(VkObjectType type, uint64_t object, std::string_view name) const;

 private:
  void choose(const std::string& select);
  void createDevice();
  void chooseQueues();

  VulkanInstance instance_;
  DeviceDescription description_;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  std::vector<DeviceQueue> queues_;
  mutable std::mutex submission_;
  std::unique_ptr<const DeviceFunctions> functions_;
  VkPhysicalDeviceLimits limits_{};
  VkDeviceSize maxBufferSize_ = 0;
  VkPhysicalDeviceMemoryProperties memory_{};
};

}  // namespace lensgraph::engine
