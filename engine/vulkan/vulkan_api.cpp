// Names for Vulkan's results, and the errors made of them.
#include "engine/vulkan/vulkan_api.h"

#include <string>

#include "engine/error.h"

namespace lensgraph::engine {

std::string_view nameOf(VkResult result) {
  switch (result) {
    case VK_SUCCESS:
      return "VK_SUCCESS";
    case VK_NOT_READY:
      return "VK_NOT_READY";
    case VK_TIMEOUT:
      return "VK_TIMEOUT";
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "VK_ERROR_OUT_OF_HOST_MEMORY";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "VK_ERROR_INITIALIZATION_FAILED";
    case VK_ERROR_DEVICE_LOST:
      return "VK_ERROR_DEVICE_LOST";
    case VK_ERROR_MEMORY_MAP_FAILED:
      return "VK_ERROR_MEMORY_MAP_FAILED";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "VK_ERROR_LAYER_NOT_PRESENT";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "VK_ERROR_EXTENSION_NOT_PRESENT";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "VK_ERROR_FEATURE_NOT_PRESENT";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "VK_ERROR_INCOMPATIBLE_DRIVER";
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
      return "VK_ERROR_FORMAT_NOT_SUPPORTED";
    case VK_ERROR_FRAGMENTED_POOL:
      return "VK_ERROR_FRAGMENTED_POOL";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
      return "VK_ERROR_OUT_OF_POOL_MEMORY";
    default:
      return "VK_ERROR_UNKNOWN";
  }
}

VulkanError::VulkanError(std::string_view what, VkResult result)
    : Error(std::string(what) + " failed: " + std::string(nameOf(result)), ErrorKind::failed), result_(result) {}

void check(VkResult result, std::string_view what) {
  if (result != VK_SUCCESS) throw VulkanError(what, result);
}

void throwNoDevice() {
  throwDeviceError("no Vulkan device found", "install the package mesa-vulkan-drivers");
}

void throwDeviceError(std::string reason, std::string remedy) {
  throw Error(ErrorParts{.file = {}, .field = {}, .reason = std::move(reason), .remedy = std::move(remedy)},
              ErrorKind::failed);
}

}  // namespace lensgraph::engine
