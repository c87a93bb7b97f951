// Tables of names.
#include "rendergraph/inspect/vulkan_names.h"

#include <cstdint>
#include <cstdio>
#include <span>

namespace lensgraph::rendergraph {

namespace {

struct Flag {
  uint64_t bit;
  std::string_view name;
};

constexpr Flag kStages[] = {
    {VK_PIPELINE_STAGE_2_TOP_OF_PIPE_BIT, "top"},
    {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, "indirect"},
    {VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT, "vertexInput"},
    {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, "vertex"},
    {VK_PIPELINE_STAGE_2_TESSELLATION_CONTROL_SHADER_BIT, "tessControl"},
    {VK_PIPELINE_STAGE_2_TESSELLATION_EVALUATION_SHADER_BIT, "tessEvaluation"},
    {VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT, "geometry"},
    {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, "fragment"},
    {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT, "earlyTests"},
    {VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT, "lateTests"},
    {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, "colorOutput"},
    {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, "compute"},
    {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, "transfer"},
    {VK_PIPELINE_STAGE_2_BOTTOM_OF_PIPE_BIT, "bottom"},
    {VK_PIPELINE_STAGE_2_HOST_BIT, "host"},
    {VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT, "allGraphics"},
    {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, "all"},
    {VK_PIPELINE_STAGE_2_COPY_BIT, "copy"},
    {VK_PIPELINE_STAGE_2_RESOLVE_BIT, "resolve"},
    {VK_PIPELINE_STAGE_2_BLIT_BIT, "blit"},
    {VK_PIPELINE_STAGE_2_CLEAR_BIT, "clear"},
    {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, "indexInput"},
    {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, "vertexAttributes"},
    {VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT, "preRasterization"},
};

constexpr Flag kAccesses[] = {
    {VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, "indirectRead"},
    {VK_ACCESS_2_INDEX_READ_BIT, "indexRead"},
    {VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, "vertexRead"},
    {VK_ACCESS_2_UNIFORM_READ_BIT, "uniformRead"},
    {VK_ACCESS_2_INPUT_ATTACHMENT_READ_BIT, "inputRead"},
    {VK_ACCESS_2_SHADER_READ_BIT, "shaderRead"},
    {VK_ACCESS_2_SHADER_WRITE_BIT, "shaderWrite"},
    {VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT, "colorRead"},
    {VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, "colorWrite"},
    {VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, "depthRead"},
    {VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, "depthWrite"},
    {VK_ACCESS_2_TRANSFER_READ_BIT, "transferRead"},
    {VK_ACCESS_2_TRANSFER_WRITE_BIT, "transferWrite"},
    {VK_ACCESS_2_HOST_READ_BIT, "hostRead"},
    {VK_ACCESS_2_HOST_WRITE_BIT, "hostWrite"},
    {VK_ACCESS_2_MEMORY_READ_BIT, "memoryRead"},
    {VK_ACCESS_2_MEMORY_WRITE_BIT, "memoryWrite"},
    {VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, "sampledRead"},
    {VK_ACCESS_2_SHADER_STORAGE_READ_BIT, "storageRead"},
    {VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, "storageWrite"},
};

std::string joined(uint64_t bits, std::span<const Flag> flags) {
  if (bits == 0) return "none";
  std::string text;
  for (const Flag& flag : flags) {
    if ((bits & flag.bit) == 0) continue;
    bits &= ~flag.bit;
    text += (text.empty() ? "" : "+") + std::string(flag.name);
  }
  if (bits != 0) {
    char number[32];
    std::snprintf(number, sizeof number, "0x%llx", static_cast<unsigned long long>(bits));
    text += (text.empty() ? "" : "+") + std::string(number);
  }
  return text;
}

}  // namespace

std::string stageNames(VkPipelineStageFlags2 stages) {
  return joined(stages, kStages);
}

std::string accessNames(VkAccessFlags2 access) {
  return joined(access, kAccesses);
}

std::string layoutName(VkImageLayout layout) {
  switch (layout) {
    case VK_IMAGE_LAYOUT_UNDEFINED:
      return "undefined";
    case VK_IMAGE_LAYOUT_GENERAL:
      return "general";
    case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
      return "colorAttachment";
    case VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL:
      return "depthAttachment";
    case VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL:
      return "depthReadOnly";
    case VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL:
      return "shaderReadOnly";
    case VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL:
      return "transferSource";
    case VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL:
      return "transferDestination";
    case VK_IMAGE_LAYOUT_PRESENT_SRC_KHR:
      return "present";
    default:
      return "layout" + std::to_string(static_cast<int>(layout));
  }
}

std::string_view nameOf(VkAttachmentLoadOp load) {
  switch (load) {
    case VK_ATTACHMENT_LOAD_OP_LOAD:
      return "load";
    case VK_ATTACHMENT_LOAD_OP_CLEAR:
      return "clear";
    default:
      return "dontCare";
  }
}

std::string_view nameOf(VkAttachmentStoreOp store) {
  switch (store) {
    case VK_ATTACHMENT_STORE_OP_STORE:
      return "store";
    case VK_ATTACHMENT_STORE_OP_NONE:
      return "none";
    default:
      return "dontCare";
  }
}

}  // namespace lensgraph::rendergraph
