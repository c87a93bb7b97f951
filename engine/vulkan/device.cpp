// Chooses a physical device by the user's wish and by what the graph and the techniques need (kNeeded), and makes the
// device with its queues.
#include "engine/vulkan/device.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>

#include "engine/error.h"
#include "engine/vulkan/vulkan_functions.h"

namespace lensgraph::engine {
namespace {

/// The feature structs, chained. Filled by the driver to see what there is, or by us to ask for it.
struct Features {
  VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};

  Features() {
    core.pNext = &v12;
    v12.pNext = &v13;
  }
  Features(const Features&) = delete;
  Features& operator=(const Features&) = delete;
};

struct NeededFeature {
  const char* name;
  VkBool32& (*in)(Features&);
};

const NeededFeature kNeeded[] = {
    {"dynamicRendering", [](Features& f) -> VkBool32& { return f.v13.dynamicRendering; }},
    {"synchronization2", [](Features& f) -> VkBool32& { return f.v13.synchronization2; }},
    // SPIR-V 1.6, which glslang writes for Vulkan 1.3, gives workgroup sizes as LocalSizeId.
    {"maintenance4", [](Features& f) -> VkBool32& { return f.v13.maintenance4; }},
    {"timelineSemaphore", [](Features& f) -> VkBool32& { return f.v12.timelineSemaphore; }},
    {"hostQueryReset", [](Features& f) -> VkBool32& { return f.v12.hostQueryReset; }},
    {"geometryShader", [](Features& f) -> VkBool32& { return f.core.features.geometryShader; }},
    {"shaderClipDistance", [](Features& f) -> VkBool32& { return f.core.features.shaderClipDistance; }},
    {"fragmentStoresAndAtomics", [](Features& f) -> VkBool32& { return f.core.features.fragmentStoresAndAtomics; }},
};

const char* typeName(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    default:
      return "other";
  }
}

int capability(const std::string& type) {
  const char* const order[] = {"other", "cpu", "virtual", "integrated", "discrete"};
  return static_cast<int>(std::find(std::begin(order), std::end(order), type) - std::begin(order));
}

std::vector<VkQueueFamilyProperties> queueFamilies(const InstanceFunctions& vk, VkPhysicalDevice physical) {
  uint32_t count = 0;
  vk.vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vk.vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  return families;
}

/// Index of the queue family with all of `wanted`, none of `unwanted`, and the fewest other abilities (decoding video,
/// say), since a family made for one thing does it beside the others; -1 when there is none.
int findQueueFamily(const std::vector<VkQueueFamilyProperties>& families, VkQueueFlags wanted, VkQueueFlags unwanted) {
  int best = -1;
  for (std::size_t i = 0; i < families.size(); ++i) {
    const VkQueueFlags flags = families[i].queueFlags;
    if ((flags & wanted) != wanted || (flags & unwanted) != 0 || families[i].queueCount == 0) continue;
    if (best < 0 || std::popcount(flags) < std::popcount(families[best].queueFlags)) best = static_cast<int>(i);
  }
  return best;
}

/// Graphics, compute and timestamps; -1 when there is none.
int findMainFamily(std::vector<VkQueueFamilyProperties> families) {
  for (auto& family : families) {
    if (family.timestampValidBits == 0) family.queueFlags = 0;
  }
  return findQueueFamily(families, VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT, 0);
}

/// Copies and nothing else, of any part of an image.
int findTransferFamily(std::vector<VkQueueFamilyProperties> families) {
  for (auto& family : families) {
    const VkExtent3D& grain = family.minImageTransferGranularity;
    if (grain.width != 1 || grain.height != 1 || grain.depth != 1) family.queueFlags = 0;
  }
  return findQueueFamily(families, VK_QUEUE_TRANSFER_BIT, VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT);
}

DeviceDescription describe(const InstanceFunctions& vk, VkPhysicalDevice physical) {
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
  properties.pNext = &driver;
  vk.vkGetPhysicalDeviceProperties2(physical, &properties);
  DeviceDescription description;
  description.name = properties.properties.deviceName;
  description.type = typeName(properties.properties.deviceType);
  description.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  if (properties.properties.apiVersion < VK_API_VERSION_1_3) {
    description.missing.emplace_back("Vulkan 1.3");
    return description;
  }
  Features features;
  vk.vkGetPhysicalDeviceFeatures2(physical, &features.core);
  for (const auto& needed : kNeeded) {
    if (needed.in(features) == VK_FALSE) description.missing.emplace_back(needed.name);
  }
  if (findMainFamily(queueFamilies(vk, physical)) < 0)
    description.missing.emplace_back("a queue for graphics and compute with timestamps");
  return description;
}

std::vector<VkPhysicalDevice> enumerate(const VulkanInstance& instance) {
  uint32_t count = 0;
  instance.vk().vkEnumeratePhysicalDevices(instance.handle(), &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  instance.vk().vkEnumeratePhysicalDevices(instance.handle(), &count, devices.data());
  devices.resize(count);
  return devices;
}

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool matches(const std::string& select, std::size_t index, const DeviceDescription& description) {
  std::size_t wanted = 0;
  const auto parsed = std::from_chars(select.data(), select.data() + select.size(), wanted);
  if (parsed.ec == std::errc{} && parsed.ptr == select.data() + select.size()) return wanted == index;
  return lowered(description.name).find(lowered(select)) != std::string::npos;
}

std::string join(const std::vector<std::string>& words) {
  std::string joined;
  for (const auto& word : words) joined += (joined.empty() ? "" : ", ") + word;
  return joined;
}

}  // namespace

std::vector<DeviceDescription> listDevices() {
  const VulkanInstance instance(false);
  std::vector<DeviceDescription> list;
  for (VkPhysicalDevice device : enumerate(instance)) list.push_back(describe(instance.vk(), device));
  return list;
}

Device::Device(const DeviceOptions& options) : instance_(options.validation) {
  choose(options.select);
  createDevice();
}

Device::~Device() {
  if (device_ != VK_NULL_HANDLE) {
    functions_->vkDeviceWaitIdle(device_);
    functions_->vkDestroyDevice(device_, nullptr);
  }
}

void Device::choose(const std::string& select) {
  const auto devices = enumerate(instance_);
  std::string names;
  std::string refused;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const auto description = describe(instance_.vk(), devices[i]);
    names += (names.empty() ? "" : "; ") + std::to_string(i) + ": " + description.name;
    if (!select.empty() && !matches(select, i, description)) continue;
    if (!description.missing.empty()) {
      refused += (refused.empty() ? "" : "; ") + description.name + " lacks " + join(description.missing);
      continue;
    }
    if (physical_ == VK_NULL_HANDLE || capability(description.type) > capability(description_.type)) {
      physical_ = devices[i];
      description_ = description;
    }
  }
  if (physical_ != VK_NULL_HANDLE) return;
  if (devices.empty()) throwNoDevice();
  if (!refused.empty())
    throwDeviceError("no usable Vulkan device: " + refused, "update the driver, or use another device");
  throw Error({.file = {},  // bad input, not a failure: the name is the user's
               .field = "device",
               .reason = "none matches '" + select + "'",
               .remedy = "choose by index or by part of the name: " + names});
}

void Device::chooseQueues() {
  const auto families = queueFamilies(instance_.vk(), physical_);
  const auto add = [&](const char* name, int family) {
    if (family < 0) return;
    const auto& properties = families[static_cast<std::size_t>(family)];
    queues_.push_back({.name = name,
                       .handle = VK_NULL_HANDLE,
                       .family = static_cast<uint32_t>(family),
                       .graphics = (properties.queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0,
                       .compute = (properties.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0,
                       .timestampBits = properties.timestampValidBits});
  };
  add("graphics", findMainFamily(families));
  add("compute", findQueueFamily(families, VK_QUEUE_COMPUTE_BIT, VK_QUEUE_GRAPHICS_BIT));
  add("transfer", findTransferFamily(families));
}

void Device::createDevice() {
  const InstanceFunctions& vk = instance_.vk();
  chooseQueues();
  const float priority = 1.0f;
  std::vector<VkDeviceQueueCreateInfo> queueInfos;
  for (const DeviceQueue& queue : queues_) {
    VkDeviceQueueCreateInfo& info = queueInfos.emplace_back();
    info = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    info.queueFamilyIndex = queue.family;  // Each family occurs once: what they can do differs.
    info.queueCount = 1;
    info.pQueuePriorities = &priority;
  }

  Features available;
  vk.vkGetPhysicalDeviceFeatures2(physical_, &available.core);
  Features wanted;
  for (const auto& needed : kNeeded) needed.in(wanted) = VK_TRUE;
  // Welcome, not needed.
  wanted.core.features.samplerAnisotropy = available.core.features.samplerAnisotropy;

  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.pNext = &wanted.core;
  info.queueCreateInfoCount = static_cast<uint32_t>(queueInfos.size());
  info.pQueueCreateInfos = queueInfos.data();
  check(vk.vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
  functions_ =
      std::make_unique<const DeviceFunctions>(deviceFunctions(instance_.loader(), vk, instance_.handle(), device_));
  for (DeviceQueue& queue : queues_) {
    functions_->vkGetDeviceQueue(device_, queue.family, 0, &queue.handle);
    setName(VK_OBJECT_TYPE_QUEUE, reinterpret_cast<uint64_t>(queue.handle), queue.name);
  }

  VkPhysicalDeviceMaintenance4Properties maintenance4{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &maintenance4};
  vk.vkGetPhysicalDeviceProperties2(physical_, &properties);
  limits_ = properties.properties.limits;
  maxBufferSize_ = maintenance4.maxBufferSize;
  vk.vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
}

VkResult Device::submit(uint32_t queue, const VkSubmitInfo2& submission, VkFence fence) const {
  const std::scoped_lock lock(submission_);
  return functions_->vkQueueSubmit2(queues_[queue].handle, 1, &submission, fence);
}

void Device::setName(VkObjectType type, uint64_t object, std::string_view name) const {
  // Names cost the driver memory and are read only under validation and debuggers, which load the same extension.
  if (functions_->vkSetDebugUtilsObjectNameEXT == nullptr || object == 0) return;
  const std::string terminated(name);
  VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
  info.objectType = type;
  info.objectHandle = object;
  info.pObjectName = terminated.c_str();
  functions_->vkSetDebugUtilsObjectNameEXT(device_, &info);
}

}  // namespace lensgraph::engine
