// Vulkan as the engine sees it: its types, one check for results, one owner for handles. No functions: those are in
// vulkan_functions.h.
#pragma once

#include <vulkan/vulkan_core.h>

#include <string>
#include <string_view>
#include <utility>

#include "engine/error.h"

namespace lensgraph::engine {

/// What check() throws: an Error (kind failed) that remembers the result.
class VulkanError : public Error {
 public:
  VulkanError(std::string_view what, VkResult result);
  /// What the call returned.
  VkResult result() const { return result_; }

 private:
  VkResult result_;
};

/// Throws VulkanError "what failed: VK_ERROR_…" unless the result is VK_SUCCESS. The graph's backend calls
/// checkForGraph() (engine/graph/graph_error.h) instead, which throws the same as a GraphError.
void check(VkResult result, std::string_view what);
/// The name in Vulkan's headers; VK_ERROR_UNKNOWN for results that the engine never meets.
std::string_view nameOf(VkResult result);

/// Throws engine::Error (kind failed) with a reason and a remedy.
[[noreturn]] void throwDeviceError(std::string reason, std::string remedy);
/// There is no driver, or none that has a device.
[[noreturn]] void throwNoDevice();

/// Owns one device object; moves, never copies. The device outlives it.
template <class Object>
class Unique {
 public:
  /// The Vulkan function that destroys an object of this type.
  using Destroy = void(VKAPI_PTR*)(VkDevice, Object, const VkAllocationCallbacks*);

  Unique() = default;
  Unique(VkDevice device, Object object, Destroy destroy) : device_(device), object_(object), destroy_(destroy) {}
  ~Unique() { reset(); }
  Unique(Unique&& other) noexcept
      : device_(other.device_), object_(std::exchange(other.object_, VK_NULL_HANDLE)), destroy_(other.destroy_) {}
  Unique& operator=(Unique&& other) noexcept {
    if (this != &other) {
      reset();
      device_ = other.device_;
      object_ = std::exchange(other.object_, VK_NULL_HANDLE);
      destroy_ = other.destroy_;
    }
    return *this;
  }

  /// VK_NULL_HANDLE when there is none.
  Object get() const { return object_; }
  explicit operator bool() const { return object_ != VK_NULL_HANDLE; }
  /// Gives the object up: the caller destroys it.
  Object release() { return std::exchange(object_, VK_NULL_HANDLE); }
  /// Destroys the object now, if there is one.
  void reset() {
    if (object_ != VK_NULL_HANDLE) destroy_(device_, std::exchange(object_, VK_NULL_HANDLE), nullptr);
  }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  Object object_ = VK_NULL_HANDLE;
  Destroy destroy_ = nullptr;
};

}  // namespace lensgraph::engine
