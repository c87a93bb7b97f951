// Turns a RasterPipelineDesc into Vulkan's create-info structs and makes the pipeline.
#include "engine/vulkan/raster_pipeline.h"

#include <vector>

#include "engine/vulkan/shader_module.h"
#include "engine/vulkan/vulkan_functions.h"

namespace lensgraph::engine {
namespace {

/// Shader modules and their stages, alive until the pipeline is made.
struct Stages {
  std::vector<Unique<VkShaderModule>> modules;
  std::vector<VkPipelineShaderStageCreateInfo> infos;

  void add(const Device& device, VkShaderStageFlagBits stage, rendergraph::SpirV code, const RasterPipelineDesc& desc) {
    if (code.empty()) return;
    modules.push_back(makeShaderModule(device, code, desc.name));
    VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = stage;
    info.module = modules.back().get();
    info.pName = "main";
    info.pSpecializationInfo = desc.specialization;
    infos.push_back(info);
  }
};

VkPipelineColorBlendAttachmentState blendAttachment(bool blend) {
  VkPipelineColorBlendAttachmentState state{};
  state.colorWriteMask =
      VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  state.blendEnable = blend ? VK_TRUE : VK_FALSE;
  state.srcColorBlendFactor = state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstColorBlendFactor = state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.colorBlendOp = state.alphaBlendOp = VK_BLEND_OP_ADD;
  return state;
}

VkPipelineDepthStencilStateCreateInfo depthState(const rendergraph::RasterState& state) {
  VkPipelineDepthStencilStateCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  info.depthTestEnable = state.depthTest ? VK_TRUE : VK_FALSE;
  info.depthWriteEnable = state.depthWrite ? VK_TRUE : VK_FALSE;
  info.depthCompareOp = state.depthCompare;
  return info;
}

VkPipelineRasterizationStateCreateInfo rasterizationState(const rendergraph::RasterState& state) {
  VkPipelineRasterizationStateCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  info.polygonMode = VK_POLYGON_MODE_FILL;
  info.cullMode = state.cull;
  // Counter-clockwise in a right-handed world; the projection turns y down and Vulkan measures in that space.
  info.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  info.lineWidth = 1.0f;
  return info;
}

}  // namespace

Unique<VkPipeline> makeRasterPipeline(const Device& device, VkPipelineCache cache, VkPipelineLayout layout,
                                      const RasterPipelineDesc& desc) {
  Stages stages;
  stages.add(device, VK_SHADER_STAGE_VERTEX_BIT, desc.vertex, desc);
  stages.add(device, VK_SHADER_STAGE_GEOMETRY_BIT, desc.geometry, desc);
  stages.add(device, VK_SHADER_STAGE_FRAGMENT_BIT, desc.fragment, desc);

  VkPipelineVertexInputStateCreateInfo vertexInput{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  vertexInput.vertexBindingDescriptionCount = static_cast<uint32_t>(desc.vertexBindings.size());
  vertexInput.pVertexBindingDescriptions = desc.vertexBindings.data();
  vertexInput.vertexAttributeDescriptionCount = static_cast<uint32_t>(desc.vertexAttributes.size());
  vertexInput.pVertexAttributeDescriptions = desc.vertexAttributes.data();
  VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = desc.state.topology;
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = viewport.scissorCount = 1;
  const auto rasterization = rasterizationState(desc.state);
  VkPipelineMultisampleStateCreateInfo multisample{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  multisample.rasterizationSamples = desc.samples;
  const auto depth = depthState(desc.state);
  const std::vector<VkPipelineColorBlendAttachmentState> attachments(desc.colorFormats.size(),
                                                                     blendAttachment(desc.state.blend));
  VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blend.attachmentCount = static_cast<uint32_t>(attachments.size());
  blend.pAttachments = attachments.data();
  const VkDynamicState dynamics[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_CULL_MODE};
  VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamic.dynamicStateCount = desc.dynamicCull ? 3 : 2;
  dynamic.pDynamicStates = dynamics;

  VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.colorAttachmentCount = static_cast<uint32_t>(desc.colorFormats.size());
  rendering.pColorAttachmentFormats = desc.colorFormats.data();
  rendering.depthAttachmentFormat = desc.depthFormat;
  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
  info.pNext = &rendering;
  info.stageCount = static_cast<uint32_t>(stages.infos.size());
  info.pStages = stages.infos.data();
  info.pVertexInputState = &vertexInput;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &rasterization;
  info.pMultisampleState = &multisample;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(device.vk().vkCreateGraphicsPipelines(device.handle(), cache, 1, &info, nullptr, &pipeline),
        "graphics pipeline " + desc.name);
  device.setName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(pipeline), desc.name);
  return {device.handle(), pipeline, device.vk().vkDestroyPipeline};
}

}  // namespace lensgraph::engine
