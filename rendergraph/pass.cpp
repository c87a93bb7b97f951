// Declaring what a pass does. Every access is stored with all defaults resolved, so that compile() and the executor
// read plain facts. Misuse is noted by access_checks; only a handle that names no resource of this graph throws at
// once.
#include "rendergraph/pass.h"

#include "rendergraph/access_checks.h"
#include "rendergraph/declaration.h"
#include "rendergraph/graph.h"

namespace rendergraph {

namespace {

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

/// Room for one more access, linked to its pass and its resource.
DeclaredAccess& append(Declaration& declaration, uint32_t passIndex, uint32_t resourceIndex) {
  const auto index = static_cast<uint32_t>(declaration.accesses.size());
  DeclaredAccess& access = declaration.accesses.emplace_back();
  access.pass = passIndex;
  access.resource = resourceIndex;
  DeclaredPass& pass = declaration.passes[passIndex];
  DeclaredResource& resource = declaration.resources[resourceIndex];
  if (passIndex < declaration.latestPass) declaration.inOrder = false;
  declaration.latestPass = passIndex;
  (pass.lastAccess == kNone ? pass.firstAccess : declaration.accesses[pass.lastAccess].nextOfPass) = index;
  (resource.lastAccess == kNone ? resource.firstAccess : declaration.accesses[resource.lastAccess].nextOfResource) =
      index;
  pass.lastAccess = resource.lastAccess = index;
  return access;
}

/// Whether the pass has used the resource before.
bool usedBefore(const Declaration& declaration, uint32_t pass, uint32_t resource) {
  for (const DeclaredAccess& access : declaration.accessesOfPass(pass)) {
    if (access.resource == resource) return true;
  }
  return false;
}

/// The usual case, in which checkAccess() would find nothing: a colour image or a buffer of the graph.
bool plainlyRight(const AccessRequest& request, const DeclaredResource& resource, const AccessRules& rules) {
  if (request.version != resource.version || !resource.created() || !rules.possible || rules.stages == 0) return false;
  if (!resource.isImage) return rules.bufferUsage != 0 && request.usage != Usage::host;
  return rules.imageUsage != 0 && resource.aspects == VK_IMAGE_ASPECT_COLOR_BIT &&
         request.usage != Usage::depthAttachment && request.usage != Usage::depthReadOnly;
}

bool isWhole(const Subresources& range, const DeclaredResource& resource) {
  return resource.isImage && range == Subresources{} && resource.image.mips != 0 && resource.image.layers != 0 &&
         resource.aspects != 0;
}

Subresources wholeOf(const DeclaredResource& resource) {
  return {.firstMip = 0,
          .mipCount = resource.image.mips,
          .firstLayer = 0,
          .layerCount = resource.image.layers,
          .aspects = resource.aspects};
}

/// Checks and stores one access. Returns the version of the resource afterwards.
uint32_t addAccess(Declaration& declaration, const AccessRequest& request) {
  const DeclaredPass& pass = declaration.passes[request.pass];
  DeclaredResource& resource = declaration.resources[request.resource];
  if (pass.disabled) return request.version;  // As if the call had not been made.
  const VkPipelineStageFlags2 stages = request.stages != 0 ? request.stages : shaderStagesOf(pass.kind);
  const AccessRules rules = rulesOf(request.usage, request.mode, stages);
  if (!plainlyRight(request, resource, rules)) checkAccess(declaration, request, rules);
  const Subresources range = isWhole(request.range, resource) ? wholeOf(resource) : checkedRange(declaration, request);
  const bool again = usedBefore(declaration, request.pass, request.resource);
  if (again) checkConflicts(declaration, request, range, rules.layout);
  DeclaredAccess& access = append(declaration, request.pass, request.resource);
  access.usage = request.usage;
  access.mode = request.mode;
  access.role = request.role;
  access.load = request.load;
  access.range = range;
  access.stages = rules.stages;
  access.version = request.version;
  access.layout = resource.isImage ? rules.layout : VK_IMAGE_LAYOUT_UNDEFINED;
  access.access = rules.access;
  access.clear = request.clear;
  access.where = request.where;
  if (again && resource.isImage) agreeOnLayouts(declaration, request.pass, request.resource);
  return request.mode == AccessMode::read ? resource.version : ++resource.version;
}

uint32_t addAttachment(Declaration& declaration, const AccessRequest& request) {
  const uint32_t version = addAccess(declaration, request);
  if (!declaration.passes[request.pass].disabled) checkAttachment(declaration, request);
  return version;
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
  AccessRequest request{.pass = index_,
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
  image.version = addAttachment(declaration, request);
  return image;
}

Image Pass::depth(Image image, const DepthAttachment& attachment, Location where) {
  Declaration& declaration = *graph_->declaration_;
  AccessRequest request{.pass = index_,
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
  image.version = addAttachment(declaration, request);
  return image;
}

Image Pass::resolve(Image target, Subresources range, Location where) {
  Declaration& declaration = *graph_->declaration_;
  target.version = addAttachment(declaration, {.pass = index_,
                                               .resource = declaration.indexOf(target, index_, where),
                                               .version = target.version,
                                               .usage = Usage::colorAttachment,
                                               .mode = AccessMode::write,
                                               .range = range,
                                               .stages = 0,
                                               .where = where,
                                               .role = AttachmentRole::resolve});
  return target;
}

void Pass::depthReadOnly(Image image, Subresources range, Location where) {
  Declaration& declaration = *graph_->declaration_;
  const AccessRequest request{.pass = index_,
                              .resource = declaration.indexOf(image, index_, where),
                              .version = image.version,
                              .usage = Usage::depthReadOnly,
                              .mode = AccessMode::read,
                              .range = range,
                              .stages = 0,
                              .where = where,
                              .role = AttachmentRole::depth,
                              .load = LoadOp::load};
  addAttachment(declaration, request);
}

void Pass::renderArea(VkExtent2D extent, uint32_t layers) {
  DeclaredPass& pass = graph_->declaration_->passes[index_];
  if (pass.hasAttachments) return;  // The attachments decide.
  pass.renderArea = extent;
  pass.renderLayers = layers;
}

void Pass::onlyIf(bool condition) {
  DeclaredPass& pass = graph_->declaration_->passes[index_];
  if (pass.firstAccess != kNone) {
    graph_->declaration_->report(Misuse::undeclaredAccess, index_, kNone, "its condition comes after its accesses",
                                 "call onlyIf() right after addPass()", pass.where);
    return;
  }
  pass.disabled = !condition;
}

void Pass::sideEffect() {
  graph_->declaration_->passes[index_].sideEffect = true;
}

void Pass::prefer(QueuePreference queue) {
  graph_->declaration_->passes[index_].queue = queue;
}

}  // namespace rendergraph
