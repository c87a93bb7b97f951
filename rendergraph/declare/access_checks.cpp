// The checks and their words.
#include "rendergraph/declare/access_checks.h"

#include <string>
#include <utility>

#include "rendergraph/declare/names.h"
#include "rendergraph/declare/subresources.h"

namespace lensgraph::rendergraph {

namespace {

std::string quoted(std::string_view text) {
  return "'" + std::string(text) + "'";
}

/// Reports in the name of one request.
struct Reporter {
  Declaration& declaration;
  const AccessRequest& request;
  void operator()(Misuse misuse, std::string reason, std::string remedy) const {
    declaration.report(misuse, request.pass, request.resource, std::move(reason), std::move(remedy), request.where);
  }
};

void reportVersion(const Reporter& report) {
  const DeclaredResource& resource = report.declaration.resources[report.request.resource];
  std::string last;
  for (const DeclaredAccess& access : report.declaration.accessesOfResource(report.request.resource)) {
    if (!access.writes()) continue;
    last = report.declaration.passes[access.pass].name;
    break;
  }
  report(Misuse::staleVersion,
         "version " + std::to_string(report.request.version) + " is used, but pass " + quoted(last) +
             " has made version " + std::to_string(resource.version),
         "use the handle that the last write returned");
}

void checkUsage(const Reporter& report, const DeclaredResource& resource, const AccessRules& rules) {
  const AccessRequest& request = report.request;
  const auto usage = [&] { return quoted(nameOf(request.usage)); };
  if ((resource.isImage ? rules.imageUsage : rules.bufferUsage) == 0) {
    report(Misuse::missingUsage,
           std::string(resource.isImage ? "an image" : "a buffer") + " cannot be used as " + usage(),
           "choose a usage that fits");
  }
  if (!rules.possible) {
    report(Misuse::missingUsage,
           "usage " + usage() + (request.mode == AccessMode::read ? " cannot read" : " cannot write"),
           request.mode == AccessMode::read ? "declare a write or modify" : "choose a usage that writes");
  }
  if (usesShaderStages(request.usage) && request.stages == 0 &&
      shaderStagesOf(report.declaration.passes[request.pass].kind) == 0) {
    report(Misuse::missingUsage, "usage " + usage() + " happens in shaders, which this kind of pass has none of",
           "make it a compute or raster pass, or name the stages");
  }
  if (!resource.isImage && request.usage == Usage::host && resource.buffer.memory == MemoryKind::device &&
      !resource.imported()) {
    report(Misuse::missingUsage, "its memory is not reachable by the host",
           "create it with MemoryKind::upload or MemoryKind::readback");
  }
  if (!resource.imported()) return;
  const bool allowed = resource.isImage ? (resource.importedImageUsage & rules.imageUsage) != 0
                                        : (resource.importedBufferUsage & rules.bufferUsage) != 0;
  if (!allowed && request.usage != Usage::host) {
    report(Misuse::missingUsage, "the host created it without the usage flag for " + usage(),
           "add the flag where the host creates it, and to the import");
  }
}

void checkFormat(const Reporter& report, const DeclaredResource& resource) {
  if (!resource.isImage || resource.image.format == VK_FORMAT_UNDEFINED) return;
  const bool color = (resource.aspects & VK_IMAGE_ASPECT_COLOR_BIT) != 0;
  switch (report.request.usage) {
    case Usage::colorAttachment:
      if (!color) report(Misuse::formatMismatch, "a depth format is used as colour attachment", "use depth()");
      break;
    case Usage::depthAttachment:
    case Usage::depthReadOnly:
      if ((resource.aspects & VK_IMAGE_ASPECT_DEPTH_BIT) == 0) {
        report(Misuse::formatMismatch, "a format without depth is used as depth attachment", "use a depth format");
      }
      break;
    case Usage::storage:
      if (!color) {
        report(Misuse::formatMismatch, "a depth format is used as storage image", "copy it to a colour format");
      }
      break;
    default:
      break;
  }
}

void reportRange(const Reporter& report, const DeclaredResource& resource, const Subresources& asked) {
  report(Misuse::subresourceRange,
         "mips " + std::to_string(asked.firstMip) + "+" + std::to_string(asked.mipCount) + ", layers " +
             std::to_string(asked.firstLayer) + "+" + std::to_string(asked.layerCount) +
             " are not inside the image of " + std::to_string(resource.image.mips) + " mips and " +
             std::to_string(resource.image.layers) + " layers",
         "name mips, layers and aspects that the image has");
}

void reportSize(const Reporter& report, const DeclaredPass& pass, VkExtent2D extent, uint32_t layers) {
  report(Misuse::sizeMismatch,
         "this attachment has " + std::to_string(extent.width) + "x" + std::to_string(extent.height) + " px and " +
             std::to_string(layers) + " layers, the first one " + std::to_string(pass.renderArea.width) + "x" +
             std::to_string(pass.renderArea.height) + " and " + std::to_string(pass.renderLayers),
         "give all attachments of a pass the same size and layer count");
}

void checkResolve(const Reporter& report, const DeclaredAccess& source, const DeclaredResource& target) {
  const DeclaredResource& resolved = report.declaration.resources[source.resource];
  if (resolved.image.samples == VK_SAMPLE_COUNT_1_BIT || target.image.samples != VK_SAMPLE_COUNT_1_BIT) {
    report(Misuse::sizeMismatch,
           "it resolves " + quoted(resolved.name) + ", but the two do not have several samples and one",
           "resolve an image with several samples into one with a single sample");
  }
  if (resolved.image.format != target.image.format) {
    report(Misuse::formatMismatch, "its format differs from that of " + quoted(resolved.name) + ", which it resolves",
           "give both the same format");
  }
}

void checkSamples(const Reporter& report, const DeclaredAccess& attachment, const ImageDesc& desc) {
  const Declaration& declaration = report.declaration;
  bool first = true;
  for (const DeclaredAccess& other : declaration.accessesOfPass(report.request.pass)) {
    if (&other == &attachment || other.role == AttachmentRole::none || other.role == AttachmentRole::resolve) continue;
    if (other.role == AttachmentRole::depth && report.request.role == AttachmentRole::depth) {
      report(Misuse::doubleWrite, "the pass has a depth attachment already", "declare one");
    }
    if (std::exchange(first, false) && declaration.resources[other.resource].image.samples != desc.samples) {
      report(Misuse::sizeMismatch, "its sample count differs from that of the other attachments",
             "give all attachments of a pass the same sample count");
    }
  }
}

}  // namespace

void checkAccess(Declaration& declaration, AccessRequest request, const AccessRules& rules) {
  const DeclaredResource& resource = declaration.resources[request.resource];
  const Reporter report{declaration, request};
  if (request.version != resource.version) [[unlikely]] {
    reportVersion(report);
  }
  checkUsage(report, resource, rules);
  checkFormat(report, resource);
  if (resource.origin == Origin::historyPrevious && request.mode != AccessMode::read) {
    report(Misuse::staleVersion, "last frame's content of a history cannot be written", "write History::next instead");
  }
}

Subresources checkedRange(Declaration& declaration, AccessRequest request) {
  const DeclaredResource& resource = declaration.resources[request.resource];
  if (!resource.isImage) return kWholeBuffer;
  const Subresources asked = resolved(request.range, resource.image);
  if (inside(asked, resource.image)) [[likely]] {
    return asked;
  }
  reportRange({declaration, request}, resource, asked);
  return resolved({}, resource.image);
}

void checkConflicts(Declaration& declaration, AccessRequest request, const Subresources& range, VkImageLayout layout) {
  const DeclaredResource& resource = declaration.resources[request.resource];
  const Reporter report{declaration, request};
  for (const DeclaredAccess& other : declaration.accessesOfPass(request.pass)) {
    if (other.resource != request.resource || !overlap(resource.isImage, other.range, range)) continue;
    if (other.writes() && request.mode != AccessMode::read) {
      report(Misuse::doubleWrite, "the pass writes the same subresource twice",
             "declare one write of the whole, or split the pass");
      return;
    }
    if (resource.isImage && combinedLayout(other.layout, layout) == VK_IMAGE_LAYOUT_UNDEFINED) {
      report(Misuse::doubleWrite,
             "the pass uses the same subresource as " + quoted(nameOf(other.usage)) + " and as " +
                 quoted(nameOf(request.usage)),
             "read a copy, or the version before, in an image of its own");
      return;
    }
  }
}

void checkAttachment(Declaration& declaration, AccessRequest request) {
  DeclaredPass& pass = declaration.passes[request.pass];
  const Reporter report{declaration, request};
  const DeclaredAccess& access = declaration.accesses.back();
  const DeclaredResource& resource = declaration.resources[request.resource];
  const VkExtent2D extent = mipExtent(resource.image, access.range.firstMip);
  if (pass.kind != PassKind::raster) {
    report(Misuse::missingUsage, "only a raster pass has attachments", "add the pass with PassKind::raster");
  }
  if (access.range.mipCount != 1) {
    report(Misuse::subresourceRange, "an attachment is one mip, not " + std::to_string(access.range.mipCount),
           "name one mip in its range");
  }
  if (!pass.hasAttachments) {
    pass.hasAttachments = true;
    pass.renderArea = extent;
    pass.renderLayers = access.range.layerCount;
  } else if (pass.renderArea.width != extent.width || pass.renderArea.height != extent.height ||
             pass.renderLayers != access.range.layerCount) {
    reportSize(report, pass, extent, access.range.layerCount);
  }
  if (request.role != AttachmentRole::resolve) {
    checkSamples(report, access, resource.image);
    return;
  }
  const DeclaredAccess* source = nullptr;
  for (const DeclaredAccess& other : declaration.accessesOfPass(request.pass)) {
    if (&other != &access) source = &other;
  }
  if (source == nullptr || source->role != AttachmentRole::color) {
    report(Misuse::missingUsage, "there is no colour attachment before it that it could resolve",
           "call resolve() right after the color() that it belongs to");
  } else {
    checkResolve(report, *source, resource);
  }
}

}  // namespace lensgraph::rendergraph
