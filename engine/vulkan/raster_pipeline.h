// Graphics pipelines for dynamic rendering, from the few choices that the project's draws differ in.
#pragma once

#include <span>
#include <string>

#include "engine/vulkan/device.h"
#include "engine/vulkan/vulkan_api.h"
#include "rendergraph/program.h"

namespace lensgraph::engine {

/// Viewport and scissor are dynamic, and the cull mode where it is asked for. Spans and pointers need to live only until the pipeline is made.
struct RasterPipelineDesc {
  std::string name;
  rendergraph::SpirV vertex, geometry, fragment;  ///< Geometry and fragment may be empty.
  rendergraph::RasterState state;
  bool dynamicCull = false;  ///< Cull mode by vkCmdSetCullMode() instead of the state's.
  const VkSpecializationInfo* specialization = nullptr;
  std::span<const VkFormat> colorFormats;
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;  ///< Of the attachments.
  std::span<const VkVertexInputBindingDescription> vertexBindings;
  std::span<const VkVertexInputAttributeDescription> vertexAttributes;
};

/// Throws engine::Error that names the pipeline.
Unique<VkPipeline> makeRasterPipeline(const Device& device, VkPipelineCache cache, VkPipelineLayout layout,
                                      const RasterPipelineDesc& desc);

}  // namespace lensgraph::engine
