// What a single declared access can be wrong about. Each check notes a misuse and goes on as if the call had been
// right, so that one compile() reports all of them.
#pragma once

#include <source_location>

#include "rendergraph/declaration.h"

namespace rendergraph {

/// An access as the host asked for it.
struct AccessRequest {
  uint32_t pass;
  uint32_t resource;
  uint32_t version;
  Usage usage;
  AccessMode mode;
  Subresources range;
  VkPipelineStageFlags2 stages;
  std::source_location where;
  AttachmentRole role = AttachmentRole::none;
  LoadOp load = LoadOp::dontCare;
  VkClearValue clear = {};
};

/// Shader stages that a kind of pass has; 0: none.
VkPipelineStageFlags2 shaderStagesOf(PassKind kind);

/// Version, usage and format. `rules` are those of the request.
void checkAccess(Declaration& declaration, const AccessRequest& request, const AccessRules& rules);

/// The requested range with its defaults replaced; one outside the image is reported, and the whole image returned.
Subresources checkedRange(Declaration& declaration, const AccessRequest& request);

/// Whether the access may stand beside the other accesses of its pass to the same subresources.
void checkConflicts(Declaration& declaration, const AccessRequest& request, const Subresources& range,
                    VkImageLayout layout);

/// Size, layers and samples of the attachment declared last against the others of its pass.
void checkAttachment(Declaration& declaration, const AccessRequest& request);

}  // namespace rendergraph
