// The table of usages; see Vulkan 1.3, "Synchronization and Cache Control", tables of access flags and stages.
#include "rendergraph/declare/access_table.h"

#include <array>

namespace lensgraph::rendergraph {

namespace {

// Depth and stencil share these layouts, so that they are right for formats with one or both aspects and need no
// separateDepthStencilLayouts.
constexpr VkImageLayout kDepthLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
constexpr VkImageLayout kDepthReadLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
constexpr VkPipelineStageFlags2 kDepthStages =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags2 kDepthRead = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
constexpr VkAccessFlags2 kDepthWrite = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

struct Row {
  VkPipelineStageFlags2 stages;  // 0: the shader stages given by the caller.
  VkAccessFlags2 read, write;    // 0: the usage cannot do that.
  VkAccessFlags2 always;         // Besides, in every mode.
  VkImageLayout layout;
  VkImageUsageFlags imageUsage;
  VkBufferUsageFlags bufferUsage;
};

// Indexed by Usage, in the order of its enumerators. A depth attachment that is only written is still tested, hence `always`.
constexpr std::array<Row, kUsages> kTable = {{
    {0, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0, 0, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_USAGE_SAMPLED_BIT,
     0},
    {0, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, 0, VK_IMAGE_LAYOUT_GENERAL,
     VK_IMAGE_USAGE_STORAGE_BIT, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT},
    {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
     VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, 0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, 0},
    {kDepthStages, kDepthRead, kDepthWrite, kDepthRead, kDepthLayout, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 0},
    {kDepthStages, kDepthRead, 0, 0, kDepthReadLayout, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 0},
    {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, 0, 0, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
     VK_IMAGE_USAGE_TRANSFER_SRC_BIT, VK_BUFFER_USAGE_TRANSFER_SRC_BIT},
    {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0, VK_ACCESS_2_TRANSFER_WRITE_BIT, 0, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
     VK_IMAGE_USAGE_TRANSFER_DST_BIT, VK_BUFFER_USAGE_TRANSFER_DST_BIT},
    {0, VK_ACCESS_2_UNIFORM_READ_BIT, 0, 0, VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT},
    {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, 0, 0, VK_IMAGE_LAYOUT_UNDEFINED, 0,
     VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT},
    {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, 0, 0,
     VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT},
    {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT, 0, 0, VK_IMAGE_LAYOUT_UNDEFINED, 0,
     VK_BUFFER_USAGE_INDEX_BUFFER_BIT},
    // The host needs no usage flag; a buffer that only the host touches must still be creatable.
    {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, VK_ACCESS_2_HOST_WRITE_BIT, 0, VK_IMAGE_LAYOUT_UNDEFINED,
     0, VK_BUFFER_USAGE_TRANSFER_SRC_BIT},
}};

constexpr AccessRules combine(Usage usage, AccessMode mode) {
  const Row& row = kTable[static_cast<std::size_t>(usage)];
  VkAccessFlags2 access = row.always;
  if (mode != AccessMode::write) access |= row.read;
  if (mode != AccessMode::read) access |= row.write;
  // A transfer or host write of a part keeps the rest without reading it: modify needs only the write.
  const bool possible = mode == AccessMode::read ? row.read != 0 : row.write != 0;
  const bool needsDepth = usage == Usage::depthAttachment || usage == Usage::depthReadOnly;
  return {.stages = row.stages,
          .access = access,
          .layout = row.layout,
          .imageUsage = row.imageUsage,
          .bufferUsage = row.bufferUsage,
          .possible = possible,
          .anyColorImage = possible && row.imageUsage != 0 && !needsDepth,
          // The host reaches only some kinds of memory.
          .anyBuffer = possible && row.bufferUsage != 0 && usage != Usage::host};
}

constexpr auto combineAll() {
  std::array<AccessRules, kUsages * kAccessModes> rules{};
  for (std::size_t i = 0; i < rules.size(); ++i) {
    rules[i] = combine(static_cast<Usage>(i / kAccessModes), static_cast<AccessMode>(i % kAccessModes));
  }
  return rules;
}

}  // namespace

constexpr std::array<AccessRules, kUsages* kAccessModes> kAccessRules = combineAll();

bool usesShaderStages(Usage usage) {
  return kTable[static_cast<std::size_t>(usage)].stages == 0;
}

bool writesMemory(VkAccessFlags2 access) {
  return (access & kWriteAccess) != 0;
}

VkImageLayout combinedLayout(VkImageLayout a, VkImageLayout b) {
  if (a == b) return a;
  const auto oneOf = [&](VkImageLayout layout) { return a == layout || b == layout; };
  if (oneOf(VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL) || oneOf(kDepthLayout)) return VK_IMAGE_LAYOUT_UNDEFINED;
  if (oneOf(kDepthReadLayout)) {
    return oneOf(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) ? kDepthReadLayout : VK_IMAGE_LAYOUT_UNDEFINED;
  }
  return VK_IMAGE_LAYOUT_GENERAL;
}

}  // namespace lensgraph::rendergraph
