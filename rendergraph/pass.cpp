// Declaring what a pass does, and the checks that one declaration call allows.
//
// Every access is stored with all defaults resolved, so that compile() and the executor read plain facts. A misuse
// is noted and the call goes on as if it had been right, so that one compile() reports all of them; only a handle
// that names no resource of this graph throws at once.
#include "rendergraph/pass.h"

#include <string>

#include "rendergraph/declaration.h"
#include "rendergraph/graph.h"

namespace rendergraph {

namespace {

struct Request {
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

VkPipelineStageFlags2 shaderStagesOf(PassKind kind) {
  switch (kind) {
    case PassKind::raster:
      return VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT |
             VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    case PassKind::compute:
      return VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    case PassKind::transfer:
    case PassKind::host:
      return 0;
  }
  return 0;
}

std::string quoted(std::string_view text) {
  return "'" + std::string(text) + "'";
}

/// Reports in the name of one request.
struct Reporter {
  Declaration& declaration;
  const Request& request;
  void operator()(Misuse misuse, std::string reason, std::string remedy) const {
    declaration.report(misuse, request.pass, request.resource, std::move(reason), std::move(remedy), request.where);
  }
};

void checkVersion(const Reporter& report, const DeclaredResource& resource) {
  if (report.request.version == resource.version) return;
  std::string last;
  for (const DeclaredAccess& access : report.declaration.accessesOfResource(report.request.resource)) {
    if (access.writes()) last = report.declaration.passes[access.pass].name;
  }
  report(Misuse::staleVersion,
         "version " + std::to_string(report.request.version) + " is used, but pass " + quoted(last) +
             " has made version " + std::to_string(resource.version),
         "use the handle that the last write returned");
}

void checkUsage(const Reporter& report, const DeclaredResource& resource) {
  const Request& request = report.request;
  const AccessRules rules = rulesOf(request.usage, request.mode, 0);
  const std::string usage = quoted(nameOf(request.usage));
  if ((resource.isImage ? rules.imageUsage : rules.bufferUsage) == 0) {
    report(Misuse::missingUsage,
           std::string(resource.isImage ? "an image" : "a buffer") + " cannot be used as " + usage,
           "choose a usage that fits");
  }
  if (!allows(request.usage, request.mode)) {
    report(Misuse::missingUsage,
           "usage " + usage + (request.mode == AccessMode::read ? " cannot read" : " cannot write"),
           request.mode == AccessMode::read ? "declare a write or modify" : "choose a usage that writes");
  }
  if (usesShaderStages(request.usage) && request.stages == 0 &&
      shaderStagesOf(report.declaration.passes[request.pass].kind) == 0) {
    report(Misuse::missingUsage, "usage " + usage + " happens in shaders, which this kind of pass has none of",
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
    report(Misuse::missingUsage, "the host created it without the usage flag for " + usage,
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

/// Makes the range fit; false when it did not.
bool checkRange(const Reporter& report, const DeclaredResource& resource, Subresources& range) {
  if (!resource.isImage) {
    range = {.firstMip = 0, .mipCount = 1, .firstLayer = 0, .layerCount = 1, .aspects = 0};
    return true;
  }
  const Subresources asked = resolved(range, resource.image);
  if (inside(asked, resource.image)) {
    range = asked;
    return true;
  }
  report(Misuse::subresourceRange,
         "mips " + std::to_string(asked.firstMip) + "+" + std::to_string(asked.mipCount) + ", layers " +
             std::to_string(asked.firstLayer) + "+" + std::to_string(asked.layerCount) +
             " are not inside the image of " + std::to_string(resource.image.mips) + " mips and " +
             std::to_string(resource.image.layers) + " layers",
         "name mips, layers and aspects that the image has");
  range = resolved({}, resource.image);
  return false;
}

bool meet(const DeclaredResource& resource, const Subresources& a, const Subresources& b) {
  return !resource.isImage || overlap(a, b);
}

void checkConflicts(const Reporter& report, const DeclaredResource& resource, const Subresources& range,
                    VkImageLayout layout) {
  for (const DeclaredAccess& other : report.declaration.accessesOfPass(report.request.pass)) {
    if (other.resource != report.request.resource || !meet(resource, other.range, range)) continue;
    if (other.writes() && report.request.mode != AccessMode::read) {
      report(Misuse::doubleWrite, "the pass writes the same subresource twice",
             "declare one write of the whole, or split the pass");
      return;
    }
    if (resource.isImage && combinedLayout(other.layout, layout) == VK_IMAGE_LAYOUT_UNDEFINED) {
      report(Misuse::doubleWrite,
             "the pass uses the same subresource as " + quoted(nameOf(other.usage)) + " and as " +
                 quoted(nameOf(report.request.usage)),
             "read a copy, or the version before, in an image of its own");
      return;
    }
  }
}

/// Accesses of one pass that share a subresource must agree on its layout; spreads until all do.
void agreeOnLayouts(Declaration& declaration, uint32_t pass, uint32_t resource) {
  for (bool changed = true; changed;) {
    changed = false;
    for (uint32_t a = declaration.passes[pass].firstAccess; a != kNone; a = declaration.accesses[a].nextOfPass) {
      for (uint32_t b = declaration.accesses[a].nextOfPass; b != kNone; b = declaration.accesses[b].nextOfPass) {
        DeclaredAccess& first = declaration.accesses[a];
        DeclaredAccess& second = declaration.accesses[b];
        if (first.resource != resource || second.resource != resource || first.layout == second.layout) continue;
        if (!overlap(first.range, second.range)) continue;
        const VkImageLayout layout = combinedLayout(first.layout, second.layout);
        if (layout == VK_IMAGE_LAYOUT_UNDEFINED) continue;  // Reported as a conflict.
        first.layout = second.layout = layout;
        changed = true;
      }
    }
  }
}

void append(Declaration& declaration, const DeclaredAccess& access) {
  const auto index = static_cast<uint32_t>(declaration.accesses.size());
  declaration.accesses.push_back(access);
  DeclaredPass& pass = declaration.passes[access.pass];
  DeclaredResource& resource = declaration.resources[access.resource];
  if (pass.lastAccess == kNone)
    pass.firstAccess = index;
  else
    declaration.accesses[pass.lastAccess].nextOfPass = index;
  pass.lastAccess = index;
  if (resource.lastAccess == kNone)
    resource.firstAccess = index;
  else
    declaration.accesses[resource.lastAccess].nextOfResource = index;
  resource.lastAccess = index;
}

/// Checks and stores one access. Returns the version of the resource afterwards.
uint32_t addAccess(Declaration& declaration, Request request) {
  DeclaredResource& resource = declaration.resources[request.resource];
  const Reporter report{declaration, request};
  checkVersion(report, resource);
  checkUsage(report, resource);
  checkFormat(report, resource);
  Subresources range = request.range;
  checkRange(report, resource, range);
  if (resource.origin == Origin::historyPrevious && request.mode != AccessMode::read) {
    report(Misuse::staleVersion, "last frame's content of a history cannot be written", "write History::next instead");
  }
  VkPipelineStageFlags2 stages = request.stages;
  if (stages == 0) stages = shaderStagesOf(declaration.passes[request.pass].kind);
  const AccessRules rules = rulesOf(request.usage, request.mode, stages);
  checkConflicts(report, resource, range, rules.layout);
  append(declaration, {.pass = request.pass,
                       .resource = request.resource,
                       .version = request.version,
                       .usage = request.usage,
                       .mode = request.mode,
                       .role = request.role,
                       .load = request.load,
                       .clear = request.clear,
                       .range = range,
                       .stages = rules.stages,
                       .access = rules.access,
                       .layout = resource.isImage ? rules.layout : VK_IMAGE_LAYOUT_UNDEFINED,
                       .where = request.where});
  if (resource.isImage) agreeOnLayouts(declaration, request.pass, request.resource);
  return request.mode == AccessMode::read ? resource.version : ++resource.version;
}

/// Notes the size of an attachment, which all attachments of the pass share.
void addAttachmentSize(Declaration& declaration, const Request& request) {
  DeclaredPass& pass = declaration.passes[request.pass];
  const Reporter report{declaration, request};
  const DeclaredAccess& access = declaration.accesses.back();
  const ImageDesc& desc = declaration.resources[request.resource].image;
  const VkExtent2D extent = mipExtent(desc, access.range.firstMip);
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
    report(Misuse::sizeMismatch,
           "this attachment has " + std::to_string(extent.width) + "x" + std::to_string(extent.height) + " px and " +
               std::to_string(access.range.layerCount) + " layers, the first one " +
               std::to_string(pass.renderArea.width) + "x" + std::to_string(pass.renderArea.height) + " and " +
               std::to_string(pass.renderLayers),
           "give all attachments of a pass the same size and layer count");
  }
  for (const DeclaredAccess& other : declaration.accessesOfPass(request.pass)) {
    if (other.role == AttachmentRole::none || &other == &access) continue;
    if (other.role == AttachmentRole::depth && request.role == AttachmentRole::depth) {
      report(Misuse::doubleWrite, "the pass has a depth attachment already", "declare one");
    }
    if (declaration.resources[other.resource].image.samples != desc.samples) {
      report(Misuse::sizeMismatch, "its sample count differs from that of the other attachments",
             "give all attachments of a pass the same sample count");
    }
    break;
  }
}

AccessMode modeOf(LoadOp load) {
  return load == LoadOp::load ? AccessMode::modify : AccessMode::write;
}

template <class Tag>
uint32_t addPlain(Declaration& declaration, uint32_t pass, const Handle<Tag>& handle, Usage usage, AccessMode mode,
                  const Subresources& range, VkPipelineStageFlags2 stages, std::source_location where) {
  return addAccess(declaration, {.pass = pass,
                                 .resource = declaration.indexOf(handle, pass, where),
                                 .version = handle.version,
                                 .usage = usage,
                                 .mode = mode,
                                 .range = range,
                                 .stages = stages,
                                 .where = where});
}

template <class Tag>
Handle<Tag> atVersion(Handle<Tag> handle, uint32_t version) {
  handle.version = version;
  return handle;
}

}  // namespace

void Pass::sample(Image image, Subresources range, VkPipelineStageFlags2 stages, Location where) {
  addPlain(*graph_->declaration_, index_, image, Usage::sampled, AccessMode::read, range, stages, where);
}

void Pass::read(Image image, Usage usage, Subresources range, VkPipelineStageFlags2 stages, Location where) {
  addPlain(*graph_->declaration_, index_, image, usage, AccessMode::read, range, stages, where);
}

void Pass::read(Buffer buffer, Usage usage, VkPipelineStageFlags2 stages, Location where) {
  addPlain(*graph_->declaration_, index_, buffer, usage, AccessMode::read, {}, stages, where);
}

Image Pass::write(Image image, Usage usage, Subresources range, VkPipelineStageFlags2 stages, Location where) {
  return atVersion(image,
                   addPlain(*graph_->declaration_, index_, image, usage, AccessMode::write, range, stages, where));
}

Buffer Pass::write(Buffer buffer, Usage usage, VkPipelineStageFlags2 stages, Location where) {
  return atVersion(buffer,
                   addPlain(*graph_->declaration_, index_, buffer, usage, AccessMode::write, {}, stages, where));
}

Image Pass::modify(Image image, Usage usage, Subresources range, VkPipelineStageFlags2 stages, Location where) {
  return atVersion(image,
                   addPlain(*graph_->declaration_, index_, image, usage, AccessMode::modify, range, stages, where));
}

Buffer Pass::modify(Buffer buffer, Usage usage, VkPipelineStageFlags2 stages, Location where) {
  return atVersion(buffer,
                   addPlain(*graph_->declaration_, index_, buffer, usage, AccessMode::modify, {}, stages, where));
}

Image Pass::color(Image image, const ColorAttachment& attachment, Location where) {
  Declaration& declaration = *graph_->declaration_;
  Request request{.pass = index_,
                  .resource = declaration.indexOf(image, index_, where),
                  .version = image.version,
                  .usage = Usage::colorAttachment,
                  .mode = modeOf(attachment.load),
                  .range = attachment.range,
                  .stages = 0,
                  .where = where,
                  .role = AttachmentRole::color,
                  .load = attachment.load};
  request.clear.color = attachment.clear;
  image.version = addAccess(declaration, request);
  addAttachmentSize(declaration, request);
  return image;
}

Image Pass::depth(Image image, const DepthAttachment& attachment, Location where) {
  Declaration& declaration = *graph_->declaration_;
  Request request{.pass = index_,
                  .resource = declaration.indexOf(image, index_, where),
                  .version = image.version,
                  .usage = Usage::depthAttachment,
                  .mode = modeOf(attachment.load),
                  .range = attachment.range,
                  .stages = 0,
                  .where = where,
                  .role = AttachmentRole::depth,
                  .load = attachment.load};
  request.clear.depthStencil = {.depth = attachment.clear, .stencil = 0};
  image.version = addAccess(declaration, request);
  addAttachmentSize(declaration, request);
  return image;
}

void Pass::depthReadOnly(Image image, Subresources range, Location where) {
  Declaration& declaration = *graph_->declaration_;
  const Request request{.pass = index_,
                        .resource = declaration.indexOf(image, index_, where),
                        .version = image.version,
                        .usage = Usage::depthReadOnly,
                        .mode = AccessMode::read,
                        .range = range,
                        .stages = 0,
                        .where = where,
                        .role = AttachmentRole::depth,
                        .load = LoadOp::load};
  addAccess(declaration, request);
  addAttachmentSize(declaration, request);
}

void Pass::renderArea(VkExtent2D extent, uint32_t layers) {
  DeclaredPass& pass = graph_->declaration_->passes[index_];
  if (pass.hasAttachments) return;  // The attachments decide.
  pass.renderArea = extent;
  pass.renderLayers = layers;
}

void Pass::sideEffect() {
  graph_->declaration_->passes[index_].sideEffect = true;
}

void Pass::prefer(QueuePreference queue) {
  graph_->declaration_->passes[index_].queue = queue;
}

}  // namespace rendergraph
