// The Vulkan functions that the engine calls, as tables of pointers which are looked up at run time: one table for the
// loader, one per instance, one per device. They are our own instead of volk's because a host may have libvulkan's
// functions, or volk's global pointers, under the same names; tables are members, so no linker ever mixes them up.
//
// Private to the engine: device.h and vulkan_instance.h only forward-declare the tables. Who calls Vulkan through
// Device::vk() includes this file; to call another function, add its name to a list.
#pragma once

#include "engine/vulkan/vulkan_api.h"

// clang-format off
#define LENSGRAPH_LOADER_FUNCTIONS(X) \
  X(vkCreateInstance) \
  X(vkEnumerateInstanceExtensionProperties) \
  X(vkEnumerateInstanceLayerProperties) \
  X(vkEnumerateInstanceVersion)

#define LENSGRAPH_INSTANCE_FUNCTIONS(X) \
  X(vkCreateDevice) \
  X(vkDestroyInstance) \
  X(vkEnumeratePhysicalDevices) \
  X(vkGetDeviceProcAddr) \
  X(vkGetPhysicalDeviceFeatures2) \
  X(vkGetPhysicalDeviceMemoryProperties) \
  X(vkGetPhysicalDeviceProperties2) \
  X(vkGetPhysicalDeviceQueueFamilyProperties)

// Of VK_EXT_debug_utils, which the loader need not have: these pointers may be null.
#define LENSGRAPH_INSTANCE_DEBUG_FUNCTIONS(X) \
  X(vkCreateDebugUtilsMessengerEXT) \
  X(vkDestroyDebugUtilsMessengerEXT)

#define LENSGRAPH_DEVICE_FUNCTIONS(X) \
  X(vkAllocateCommandBuffers) \
  X(vkAllocateDescriptorSets) \
  X(vkAllocateMemory) \
  X(vkBeginCommandBuffer) \
  X(vkBindBufferMemory) \
  X(vkBindImageMemory) \
  X(vkCmdBeginRendering) \
  X(vkCmdBindDescriptorSets) \
  X(vkCmdBindIndexBuffer) \
  X(vkCmdBindPipeline) \
  X(vkCmdBindVertexBuffers) \
  X(vkCmdClearColorImage) \
  X(vkCmdClearDepthStencilImage) \
  X(vkCmdCopyBuffer) \
  X(vkCmdCopyBufferToImage) \
  X(vkCmdCopyImage) \
  X(vkCmdCopyImageToBuffer) \
  X(vkCmdDispatch) \
  X(vkCmdDispatchIndirect) \
  X(vkCmdDraw) \
  X(vkCmdDrawIndexed) \
  X(vkCmdEndRendering) \
  X(vkCmdFillBuffer) \
  X(vkCmdPipelineBarrier2) \
  X(vkCmdPushConstants) \
  X(vkCmdSetCullMode) \
  X(vkCmdSetEvent2) \
  X(vkCmdSetScissor) \
  X(vkCmdSetViewport) \
  X(vkCmdUpdateBuffer) \
  X(vkCmdWaitEvents2) \
  X(vkCmdWriteTimestamp2) \
  X(vkCreateBuffer) \
  X(vkCreateCommandPool) \
  X(vkCreateComputePipelines) \
  X(vkCreateDescriptorPool) \
  X(vkCreateDescriptorSetLayout) \
  X(vkCreateEvent) \
  X(vkCreateFence) \
  X(vkCreateGraphicsPipelines) \
  X(vkCreateImage) \
  X(vkCreateImageView) \
  X(vkCreatePipelineCache) \
  X(vkCreatePipelineLayout) \
  X(vkCreateQueryPool) \
  X(vkCreateSampler) \
  X(vkCreateSemaphore) \
  X(vkCreateShaderModule) \
  X(vkDestroyBuffer) \
  X(vkDestroyCommandPool) \
  X(vkDestroyDescriptorPool) \
  X(vkDestroyDescriptorSetLayout) \
  X(vkDestroyDevice) \
  X(vkDestroyEvent) \
  X(vkDestroyFence) \
  X(vkDestroyImage) \
  X(vkDestroyImageView) \
  X(vkDestroyPipeline) \
  X(vkDestroyPipelineCache) \
  X(vkDestroyPipelineLayout) \
  X(vkDestroyQueryPool) \
  X(vkDestroySampler) \
  X(vkDestroySemaphore) \
  X(vkDestroyShaderModule) \
  X(vkDeviceWaitIdle) \
  X(vkEndCommandBuffer) \
  X(vkFreeMemory) \
  X(vkGetBufferMemoryRequirements) \
  X(vkGetDeviceBufferMemoryRequirements) \
  X(vkGetDeviceImageMemoryRequirements) \
  X(vkGetDeviceQueue) \
  X(vkGetImageMemoryRequirements) \
  X(vkGetPipelineCacheData) \
  X(vkGetQueryPoolResults) \
  X(vkGetSemaphoreCounterValue) \
  X(vkMapMemory) \
  X(vkQueueSubmit2) \
  X(vkResetCommandPool) \
  X(vkResetDescriptorPool) \
  X(vkResetEvent) \
  X(vkResetFences) \
  X(vkResetQueryPool) \
  X(vkUpdateDescriptorSets) \
  X(vkWaitForFences) \
  X(vkWaitSemaphores)

// Of VK_EXT_debug_utils, an extension of the instance: null without it.
#define LENSGRAPH_DEVICE_DEBUG_FUNCTIONS(X) \
  X(vkCmdBeginDebugUtilsLabelEXT) \
  X(vkCmdEndDebugUtilsLabelEXT) \
  X(vkSetDebugUtilsObjectNameEXT)
// clang-format on

namespace lensgraph::engine {

#define LENSGRAPH_POINTER(function) PFN_##function function = nullptr;

/// What can be called before there is an instance.
struct LoaderFunctions {
  PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr = nullptr;
  LENSGRAPH_LOADER_FUNCTIONS(LENSGRAPH_POINTER)
};

/// What is called with an instance or a physical device.
struct InstanceFunctions {
  LENSGRAPH_INSTANCE_FUNCTIONS(LENSGRAPH_POINTER)
  LENSGRAPH_INSTANCE_DEBUG_FUNCTIONS(LENSGRAPH_POINTER)
};

/// What is called with a device, a queue or a command buffer. The pointers lead straight to the driver (or the topmost
/// layer), so each device has its own.
struct DeviceFunctions {
  LENSGRAPH_DEVICE_FUNCTIONS(LENSGRAPH_POINTER)
  LENSGRAPH_DEVICE_DEBUG_FUNCTIONS(LENSGRAPH_POINTER)
};

#undef LENSGRAPH_POINTER

/// Opens libvulkan.so.1, which stays open until the program ends. Throws engine::Error when there is none, or when it
/// is older than Vulkan 1.3.
LoaderFunctions loadVulkan();
/// Throws engine::Error when a function is missing, as do the next.
InstanceFunctions instanceFunctions(const LoaderFunctions& loader, VkInstance instance);
DeviceFunctions deviceFunctions(const LoaderFunctions& loader, const InstanceFunctions& functions, VkInstance instance,
                                VkDevice device);

}  // namespace lensgraph::engine
