// The Vulkan instance, and what the validation layers say.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/vulkan/vulkan_api.h"

namespace lensgraph::engine {

struct LoaderFunctions;
struct InstanceFunctions;

/// Messages of the validation layers, warnings and errors, in the order in which they came.
struct ValidationLog {
  std::vector<std::string> messages;
};

/// One VkInstance with the loader's functions. Several may be alive at once.
class VulkanInstance {
 public:
  /// Opens the loader and makes an instance.
  /// `validation`: core and synchronization validation, across submissions too. Throws engine::Error when there is no
  /// Vulkan 1.3 loader, or no validation layer although one is asked for.
  explicit VulkanInstance(bool validation);
  ~VulkanInstance();
  VulkanInstance(const VulkanInstance&) = delete;
  VulkanInstance& operator=(const VulkanInstance&) = delete;

  VkInstance handle() const { return instance_; }
  /// The functions to call with the loader and with this instance: vulkan_functions.h.
  const LoaderFunctions& loader() const { return *loader_; }
  const InstanceFunctions& vk() const { return *functions_; }
  /// Outlives the instance, so that what is said at its destruction (leaked objects) can be read.
  const std::shared_ptr<ValidationLog>& log() const { return log_; }

 private:
  void create(bool validation);

  std::unique_ptr<const LoaderFunctions> loader_;
  std::unique_ptr<const InstanceFunctions> functions_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::shared_ptr<ValidationLog> log_ = std::make_shared<ValidationLog>();
};

}  // namespace lensgraph::engine
