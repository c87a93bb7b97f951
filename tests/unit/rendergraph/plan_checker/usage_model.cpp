// The checker's own table of usages.
#include "plan_checker/usage_model.h"

namespace lensgraph::plan_checker {

using namespace rendergraph;

namespace {

constexpr std::array<VkPipelineStageFlags2, kStageCount> kStages = {
    VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT,
    VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
    VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT, VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
    // For all that no usage names, and ALL_COMMANDS reaches all the same.
    VK_PIPELINE_STAGE_2_TESSELLATION_EVALUATION_SHADER_BIT, VK_PIPELINE_STAGE_2_HOST_BIT};

constexpr StageMask kGraphicsStages = 0x9FF;  // The first nine, up to COLOR_ATTACHMENT_OUTPUT, and tessellation.

// In the order of the mask's bits.
constexpr std::array<VkAccessFlags2, 15> kAccesses = {VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT,
                                                      VK_ACCESS_2_INDEX_READ_BIT,
                                                      VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT,
                                                      VK_ACCESS_2_UNIFORM_READ_BIT,
                                                      VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                                      VK_ACCESS_2_SHADER_STORAGE_READ_BIT,
                                                      VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
                                                      VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
                                                      VK_ACCESS_2_TRANSFER_READ_BIT,
                                                      VK_ACCESS_2_HOST_READ_BIT,
                                                      VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                                      VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                                                      VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                                                      VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                                      VK_ACCESS_2_HOST_WRITE_BIT};

bool isAttachment(Usage usage) {
  return usage == Usage::colorAttachment || usage == Usage::depthAttachment || usage == Usage::depthReadOnly;
}

}  // namespace

StageMask stageMask(VkPipelineStageFlags2 stages) {
  // ALL_COMMANDS is everything on the device; the host's stage must be named.
  StageMask mask = (stages & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) != 0 ? kDeviceStages : 0;
  if ((stages & VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT) != 0) mask |= kGraphicsStages;
  for (uint32_t i = 0; i < kStageCount; ++i) mask |= (stages & kStages[i]) != 0 ? 1u << i : 0u;
  return mask;
}

AccessMask accessMask(VkAccessFlags2 access) {
  AccessMask mask = 0;
  for (uint32_t i = 0; i < kAccesses.size(); ++i) mask |= (access & kAccesses[i]) != 0 ? 1u << i : 0u;
  if ((access & VK_ACCESS_2_MEMORY_READ_BIT) != 0) mask |= kReads;
  if ((access & VK_ACCESS_2_MEMORY_WRITE_BIT) != 0) mask |= kWrites;
  return mask;
}

VkPipelineStageFlags2 stageFlags(StageMask stages) {
  VkPipelineStageFlags2 flags = 0;
  for (uint32_t i = 0; i < kStageCount; ++i) flags |= (stages >> i & 1) != 0 ? kStages[i] : 0;
  return flags;
}

StageMask stagesOf(const QueueFacts& queue) {
  StageMask stages = stageMask(VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT | VK_PIPELINE_STAGE_2_HOST_BIT);
  if (queue.graphics) stages |= kGraphicsStages;
  if (queue.compute)
    stages |= stageMask(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT);
  return stages;
}

VkImageLayout layoutFor(Usage usage) {
  switch (usage) {
    case Usage::sampled:
      return VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    case Usage::colorAttachment:
      return VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    case Usage::depthAttachment:
      return VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    case Usage::depthReadOnly:
      return VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    case Usage::transferSource:
      return VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    case Usage::transferDestination:
      return VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    default:
      return VK_IMAGE_LAYOUT_GENERAL;
  }
}

void addAccess(Use& use, const DeclaredAccess& access) {
  const bool reads = access.mode != AccessMode::write, writes = access.mode != AccessMode::read;
  const auto touch = [&](VkPipelineStageFlags2 stages, VkAccessFlags2 read, VkAccessFlags2 write) {
    use.add(stageMask(stages), accessMask((reads ? read : 0) | (writes ? write : 0)));
  };
  switch (access.usage) {
    case Usage::sampled:
      touch(access.stages, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0);
      break;
    case Usage::storage:
      touch(access.stages, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
      break;
    case Usage::colorAttachment:
      touch(VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
            VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
      break;
    case Usage::depthAttachment:
    case Usage::depthReadOnly:  // Tested in any case.
      use.add(stageMask(VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT),
              accessMask(VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                         (writes ? VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT : 0)));
      break;
    case Usage::transferSource:
    case Usage::transferDestination:
      // A partial transfer write keeps the rest without reading it.
      touch(VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
            access.usage == Usage::transferSource ? VK_ACCESS_2_TRANSFER_READ_BIT : 0, VK_ACCESS_2_TRANSFER_WRITE_BIT);
      break;
    case Usage::uniform:
      touch(access.stages, VK_ACCESS_2_UNIFORM_READ_BIT, 0);
      break;
    case Usage::indirect:
      touch(VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, 0);
      break;
    case Usage::vertex:
      touch(VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, 0);
      break;
    case Usage::index:
      touch(VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT, 0);
      break;
    case Usage::host:
      touch(VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, VK_ACCESS_2_HOST_WRITE_BIT);
      break;
  }
  use.reads = use.reads || reads;
  use.writes = use.writes || writes;
  use.onlyAttachment = use.onlyAttachment && isAttachment(access.usage);
}

}  // namespace lensgraph::plan_checker
