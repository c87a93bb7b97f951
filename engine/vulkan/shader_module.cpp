// Makes a VkShaderModule from the words of a SPIR-V program.
#include "engine/vulkan/shader_module.h"

#include "engine/vulkan/vulkan_functions.h"

namespace lensgraph::engine {

Unique<VkShaderModule> makeShaderModule(const Device& device, rendergraph::SpirV code, const std::string& name) {
  VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  info.codeSize = code.size_bytes();
  info.pCode = code.data();
  VkShaderModule module = VK_NULL_HANDLE;
  check(device.vk().vkCreateShaderModule(device.handle(), &info, nullptr, &module), "vkCreateShaderModule " + name);
  return {device.handle(), module, device.vk().vkDestroyShaderModule};
}

}  // namespace lensgraph::engine
