// What a single declared access can be wrong about. Each check notes a misuse and goes on as if the call had been
// right, so that one compile() reports all of them.
#pragma once

#include <source_location>

#include "rendergraph/declare/access_table.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

/// An access as the host asked for it. The checks take it by value: one whose address leaves the caller would have to
/// be put together in memory for every access, and most need no check.
struct AccessRequest {
  uint32_t resource;
  uint32_t version;
  uint32_t pass;
  Usage usage;
  AccessMode mode;
  AttachmentRole role = AttachmentRole::none;
  LoadOp load = LoadOp::dontCare;
  const Subresources& range;
  VkPipelineStageFlags2 stages = 0;
  std::source_location where;
};

/// The range of an access to a buffer.
inline constexpr Subresources kWholeBuffer{
    .firstMip = 0, .mipCount = 1, .firstLayer = 0, .layerCount = 1, .aspects = 0};

/// Shader stages that a kind of pass has; 0: none.
inline VkPipelineStageFlags2 shaderStagesOf(PassKind kind) {
  constexpr VkPipelineStageFlags2 kRaster = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
                                            VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT |
                                            VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  if (kind == PassKind::compute) return VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  return kind == PassKind::raster ? kRaster : 0;
}

/// Version, usage and format. `rules` are those of the request.
void checkAccess(Declaration& declaration, AccessRequest request, const AccessRules& rules);

/// The requested range with its defaults replaced; one outside the image is reported, and the whole image returned.
Subresources checkedRange(Declaration& declaration, AccessRequest request);

/// Whether the access may stand beside the other accesses of its pass to the same subresources.
void checkConflicts(Declaration& declaration, AccessRequest request, const Subresources& range, VkImageLayout layout);

/// Size, layers and samples of the attachment declared last against the others of its pass.
void checkAttachment(Declaration& declaration, AccessRequest request);

}  // namespace lensgraph::rendergraph
