// Finds the Vulkan loader and fills the tables of vulkan_functions.h with the addresses that it gives.
#include "engine/vulkan/vulkan_functions.h"

#include <dlfcn.h>

#include <string>

namespace lensgraph::engine {
namespace {

/// Stores the address that was found for `name`; null is an error unless the function is optional.
template <class Function>
void assign(Function& pointer, PFN_vkVoidFunction found, const char* name, bool optional = false) {
  if (found == nullptr && !optional) {
    throwDeviceError(std::string("the Vulkan loader or driver lacks ") + name, "update the driver");
  }
  pointer = reinterpret_cast<Function>(found);
}

}  // namespace

LoaderFunctions loadVulkan() {
  LoaderFunctions functions;
  // Never closed: drivers and layers leave threads and exit handlers behind that would then run in unmapped memory.
  for (const char* library : {"libvulkan.so.1", "libvulkan.so"}) {
    if (void* const loader = dlopen(library, RTLD_NOW | RTLD_LOCAL); loader != nullptr) {
      functions.vkGetInstanceProcAddr =
          reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(loader, "vkGetInstanceProcAddr"));
    }
    if (functions.vkGetInstanceProcAddr != nullptr) break;
  }
  if (functions.vkGetInstanceProcAddr == nullptr) {
    throwDeviceError("no Vulkan loader found (libvulkan.so.1)", "install the package libvulkan1");
  }
#define LENSGRAPH_LOAD(name) \
  assign(functions.name, functions.vkGetInstanceProcAddr(VK_NULL_HANDLE, #name), #name, true);
  LENSGRAPH_LOADER_FUNCTIONS(LENSGRAPH_LOAD)
#undef LENSGRAPH_LOAD
  uint32_t version = VK_API_VERSION_1_0;
  // A loader of Vulkan 1.0 does not have this function.
  const bool known =
      functions.vkEnumerateInstanceVersion != nullptr && functions.vkEnumerateInstanceVersion(&version) == VK_SUCCESS;
  if (!known || version < VK_API_VERSION_1_3) {
    throwDeviceError("the Vulkan loader is older than version 1.3", "update the package libvulkan1");
  }
  return functions;
}

InstanceFunctions instanceFunctions(const LoaderFunctions& loader, VkInstance instance) {
  InstanceFunctions functions;
#define LENSGRAPH_LOAD(name) assign(functions.name, loader.vkGetInstanceProcAddr(instance, #name), #name);
#define LENSGRAPH_LOAD_OPTIONAL(name) \
  assign(functions.name, loader.vkGetInstanceProcAddr(instance, #name), #name, true);
  LENSGRAPH_INSTANCE_FUNCTIONS(LENSGRAPH_LOAD)
  LENSGRAPH_INSTANCE_DEBUG_FUNCTIONS(LENSGRAPH_LOAD_OPTIONAL)
#undef LENSGRAPH_LOAD
#undef LENSGRAPH_LOAD_OPTIONAL
  return functions;
}

DeviceFunctions deviceFunctions(const LoaderFunctions& loader, const InstanceFunctions& functions, VkInstance instance,
                                VkDevice device) {
  DeviceFunctions found;
#define LENSGRAPH_LOAD(name) assign(found.name, functions.vkGetDeviceProcAddr(device, #name), #name);
// Vulkan promises an address from vkGetDeviceProcAddr for extensions of the device only.
#define LENSGRAPH_LOAD_OPTIONAL(name) assign(found.name, loader.vkGetInstanceProcAddr(instance, #name), #name, true);
  LENSGRAPH_DEVICE_FUNCTIONS(LENSGRAPH_LOAD)
  LENSGRAPH_DEVICE_DEBUG_FUNCTIONS(LENSGRAPH_LOAD_OPTIONAL)
#undef LENSGRAPH_LOAD
#undef LENSGRAPH_LOAD_OPTIONAL
  return found;
}

}  // namespace lensgraph::engine
