// Makes the instance, with the validation layer and its messenger when they are asked for.
#include "engine/vulkan/vulkan_instance.h"

#include <cstdlib>
#include <cstring>
#include <mutex>

#include "engine/vulkan/vulkan_functions.h"

namespace lensgraph::engine {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  // Layers may call from any thread that records.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  static_cast<ValidationLog*>(user)->messages.emplace_back(data->pMessage);
  return VK_FALSE;
}

bool hasLayer(const LoaderFunctions& vk, const char* name) {
  uint32_t count = 0;
  vk.vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vk.vkEnumerateInstanceLayerProperties(&count, layers.data());
  for (const auto& layer : layers) {
    if (std::strcmp(layer.layerName, name) == 0) return true;
  }
  return false;
}

bool hasExtension(const LoaderFunctions& vk, const char* name) {
  uint32_t count = 0;
  vk.vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vk.vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data());
  for (const auto& extension : extensions) {
    if (std::strcmp(extension.extensionName, name) == 0) return true;
  }
  return false;
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(ValidationLog& log) {
  VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = onMessage;
  info.pUserData = &log;
  return info;
}

}  // namespace

VulkanInstance::VulkanInstance(bool validation) {
  create(validation);
}

void VulkanInstance::create(bool validation) {
  loader_ = std::make_unique<const LoaderFunctions>(loadVulkan());
  if (validation && !hasLayer(*loader_, kValidationLayer)) {
    throwDeviceError("validation was asked for, but VK_LAYER_KHRONOS_validation is not installed",
                     "install the package vulkan-validationlayers");
  }
  const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                      .pNext = nullptr,
                                      .pApplicationName = "lensgraph",
                                      .applicationVersion = 0,
                                      .pEngineName = "lensgraph",
                                      .engineVersion = 0,
                                      .apiVersion = VK_API_VERSION_1_3};
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  if (hasExtension(*loader_, extension)) {
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
  }
  const VkValidationFeatureEnableEXT enables[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = enables;
  const auto messenger = messengerInfo(*log_);
  if (validation) {
    // Without this variable the layer does not look across command buffers of one queue.
    setenv("VK_LAYER_ENABLES", "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT", 0);
    features.pNext = &messenger;
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
  }
  const VkResult made = loader_->vkCreateInstance(&info, nullptr, &instance_);
  // The loader's word for a machine without drivers.
  if (made == VK_ERROR_INCOMPATIBLE_DRIVER) throwNoDevice();
  check(made, "vkCreateInstance");
  functions_ = std::make_unique<const InstanceFunctions>(instanceFunctions(*loader_, instance_));
  if (validation) {
    check(functions_->vkCreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_),
          "vkCreateDebugUtilsMessengerEXT");
  }
}

VulkanInstance::~VulkanInstance() {
  if (messenger_ != VK_NULL_HANDLE) functions_->vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
  if (instance_ != VK_NULL_HANDLE) functions_->vkDestroyInstance(instance_, nullptr);
}

}  // namespace lensgraph::engine
