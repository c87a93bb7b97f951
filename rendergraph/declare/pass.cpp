// Declaring what a pass does. Every access is stored with all defaults resolved, so that compile() and the executor
// read plain facts. Misuse is noted by access_checks; only a handle that names no resource of this graph throws at
// once.
#include "rendergraph/pass.h"

#include "rendergraph/declare/access_checks.h"
#include "rendergraph/declare/access_table.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/declare/subresources.h"

namespace lensgraph::rendergraph {

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

/// Whether the pass has used the resource before.
bool usedBefore(const Declaration& declaration, uint32_t pass, uint32_t resource) {
  if (declaration.resources[resource].lastPass == pass) return true;
  for (const DeclaredAccess& access : declaration.accessesOfPass(pass)) {
    if (access.resource == resource) return true;
  }
  return false;
}

VkPipelineStageFlags2 stagesOf(const AccessRules& rules, const AccessRequest& request, PassKind kind) {
  if (rules.stages != 0) return rules.stages;
  return request.stages != 0 ? request.stages : shaderStagesOf(kind);
}

Subresources wholeOf(const DeclaredResource& resource) {
  return {.firstMip = 0,
          .mipCount = resource.image.mips,
          .firstLayer = 0,
          .layerCount = resource.image.layers,
          .aspects = resource.aspects};
}

/// The usual case, in which the checks find nothing: an ordinary resource, as a whole, in the latest version, for the
/// first time in the pass that was declared last.
[[gnu::always_inline]] inline bool isPlain(const Declaration& declaration, const AccessRequest& request,
                                           const DeclaredResource& resource) {
  const AccessRules& rules = rulesOf(request.usage, request.mode);
  return resource.ordinary && request.version == resource.version && request.range.namesAll() &&
         (resource.isImage ? rules.anyColorImage : rules.anyBuffer) && resource.lastPass != request.pass &&
         request.pass >= declaration.latestPass && declaration.inOrder;
}

/// Stores an access and links it to its pass and its resource. Returns the version of the resource afterwards.
[[gnu::always_inline]] inline uint32_t store(Declaration& declaration, const AccessRequest& request,
                                             const Subresources& range, VkPipelineStageFlags2 stages) {
  const uint32_t index = declaration.accesses.size();
  const AccessRules& rules = rulesOf(request.usage, request.mode);
  DeclaredPass& pass = declaration.passes[request.pass];
  DeclaredResource& resource = declaration.resources[request.resource];
  DeclaredAccess& access = declaration.accesses.add();
  access.pass = request.pass;
  access.resource = request.resource;
  access.usage = request.usage;
  access.mode = request.mode;
  access.role = request.role;
  access.load = request.load;
  access.range = range;
  access.stages = stages;
  access.previousOfResource = resource.lastAccess;
  access.version = request.version;
  access.layout = resource.isImage ? rules.layout : VK_IMAGE_LAYOUT_UNDEFINED;
  access.access = rules.access;
  access.where = request.where;
  if (request.pass < declaration.latestPass) declaration.inOrder = false;
  declaration.latestPass = request.pass;
  (pass.lastAccess == kNone ? pass.firstAccess : declaration.accesses[pass.lastAccess].nextOfPass) = index;
  pass.lastAccess = resource.lastAccess = index;
  resource.lastPass = request.pass;
  return request.mode == AccessMode::read ? resource.version : ++resource.version;
}

/// Every case, with all checks.
[[gnu::noinline]] uint32_t checkAndStore(Declaration& declaration, AccessRequest request) {
  const DeclaredResource& resource = declaration.resources[request.resource];
  const AccessRules& rules = rulesOf(request.usage, request.mode);
  const VkPipelineStageFlags2 stages = stagesOf(rules, request, declaration.passes[request.pass].kind);
  checkAccess(declaration, request, rules);
  const Subresources range = checkedRange(declaration, request);
  const bool again = usedBefore(declaration, request.pass, request.resource);
  if (again) checkConflicts(declaration, request, range, rules.layout);
  const uint32_t version = store(declaration, request, range, stages);
  if (again && resource.isImage) agreeOnLayouts(declaration, request.pass, request.resource);
  return version;
}

/// Checks and stores one access. Returns the version of the resource afterwards.
[[gnu::always_inline]] inline uint32_t addAccess(Declaration& declaration, const AccessRequest& request) {
  const DeclaredPass& pass = declaration.passes[request.pass];
  const DeclaredResource& resource = declaration.resources[request.resource];
  if (pass.disabled) return request.version;  // As if the call had not been made.
  const VkPipelineStageFlags2 stages = stagesOf(rulesOf(request.usage, request.mode), request, pass.kind);
  if (stages == 0 || !isPlain(declaration, request, resource)) return checkAndStore(declaration, request);
  return store(declaration, request, resource.isImage ? wholeOf(resource) : kWholeBuffer, stages);
}

uint32_t addAttachment(Declaration& declaration, const AccessRequest& request, const VkClearValue& clear = {}) {
  const uint32_t version = addAccess(declaration, request);
  if (declaration.passes[request.pass].disabled) return version;
  declaration.accesses.back().clear = clear;
  checkAttachment(declaration, request);
  return version;
}

AccessMode modeOf(LoadOp load) {
  return load == LoadOp::load ? AccessMode::modify : AccessMode::write;
}

template <class Tag>
uint32_t addPlain(Declaration& declaration, uint32_t pass, const Handle<Tag>& handle, Usage usage, AccessMode mode,
                  const Subresources& range, VkPipelineStageFlags2 stages, std::source_location where) {
  return addAccess(declaration, {.resource = declaration.indexOf(handle, pass, where),
                                 .version = handle.version,
                                 .pass = pass,
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
  addPlain(*declaration_, index_, image, Usage::sampled, AccessMode::read, range, stages, where);
}

void Pass::read(Image image, Usage usage, Subresources range, VkPipelineStageFlags2 stages, Location where) {
  addPlain(*declaration_, index_, image, usage, AccessMode::read, range, stages, where);
}

void Pass::read(Buffer buffer, Usage usage, VkPipelineStageFlags2 stages, Location where) {
  addPlain(*declaration_, index_, buffer, usage, AccessMode::read, {}, stages, where);
}

Image Pass::write(Image image, Usage usage, Subresources range, VkPipelineStageFlags2 stages, Location where) {
  return atVersion(image, addPlain(*declaration_, index_, image, usage, AccessMode::write, range, stages, where));
}

Buffer Pass::write(Buffer buffer, Usage usage, VkPipelineStageFlags2 stages, Location where) {
  return atVersion(buffer, addPlain(*declaration_, index_, buffer, usage, AccessMode::write, {}, stages, where));
}

Image Pass::modify(Image image, Usage usage, Subresources range, VkPipelineStageFlags2 stages, Location where) {
  return atVersion(image, addPlain(*declaration_, index_, image, usage, AccessMode::modify, range, stages, where));
}

Buffer Pass::modify(Buffer buffer, Usage usage, VkPipelineStageFlags2 stages, Location where) {
  return atVersion(buffer, addPlain(*declaration_, index_, buffer, usage, AccessMode::modify, {}, stages, where));
}

Image Pass::color(Image image, const ColorAttachment& attachment, Location where) {
  Declaration& declaration = *declaration_;
  image.version = addAttachment(declaration,
                                {.resource = declaration.indexOf(image, index_, where),
                                 .version = image.version,
                                 .pass = index_,
                                 .usage = Usage::colorAttachment,
                                 .mode = modeOf(attachment.load),
                                 .role = AttachmentRole::color,
                                 .load = attachment.load,
                                 .range = attachment.range,
                                 .where = where},
                                {.color = attachment.clear});
  return image;
}

Image Pass::depth(Image image, const DepthAttachment& attachment, Location where) {
  Declaration& declaration = *declaration_;
  image.version = addAttachment(declaration,
                                {.resource = declaration.indexOf(image, index_, where),
                                 .version = image.version,
                                 .pass = index_,
                                 .usage = Usage::depthAttachment,
                                 .mode = modeOf(attachment.load),
                                 .role = AttachmentRole::depth,
                                 .load = attachment.load,
                                 .range = attachment.range,
                                 .where = where},
                                {.depthStencil = {.depth = attachment.clear, .stencil = 0}});
  return image;
}

Image Pass::resolve(Image target, Subresources range, Location where) {
  Declaration& declaration = *declaration_;
  target.version = addAttachment(declaration, {.resource = declaration.indexOf(target, index_, where),
                                               .version = target.version,
                                               .pass = index_,
                                               .usage = Usage::colorAttachment,
                                               .mode = AccessMode::write,
                                               .role = AttachmentRole::resolve,
                                               .range = range,
                                               .where = where});
  return target;
}

void Pass::depthReadOnly(Image image, Subresources range, Location where) {
  Declaration& declaration = *declaration_;
  addAttachment(declaration, {.resource = declaration.indexOf(image, index_, where),
                              .version = image.version,
                              .pass = index_,
                              .usage = Usage::depthReadOnly,
                              .mode = AccessMode::read,
                              .role = AttachmentRole::depth,
                              .load = LoadOp::load,
                              .range = range,
                              .where = where});
}

void Pass::renderArea(VkExtent2D extent, uint32_t layers) {
  DeclaredPass& pass = declaration_->passes[index_];
  if (pass.hasAttachments) return;  // The attachments decide.
  pass.renderArea = extent;
  pass.renderLayers = layers;
}

void Pass::onlyIf(bool condition) {
  DeclaredPass& pass = declaration_->passes[index_];
  if (pass.firstAccess != kNone) {
    declaration_->report(Misuse::undeclaredAccess, index_, kNone, "its condition comes after its accesses",
                         "call onlyIf() right after addPass()", pass.where);
    return;
  }
  pass.disabled = !condition;
}

void Pass::sideEffect() {
  declaration_->passes[index_].sideEffect = true;
}

void Pass::prefer(QueuePreference queue) {
  declaration_->passes[index_].queue = queue;
}

void* Pass::allocateRecording(std::size_t size, std::size_t alignment) {
  return declaration_->arena.allocate(size, alignment);
}

void Pass::setRecording(void* recording, Recorder recorder, Destroyer destroyer) {
  DeclaredPass& declared = declaration_->passes[index_];
  if (declared.destroyer != nullptr) declared.destroyer(declared.recording);  // record() was called again.
  declared.recording = recording;
  declared.recorder = recorder;
  declared.destroyer = destroyer;
  if (destroyer != nullptr) declaration_->recordingsToDestroy = true;
}

}  // namespace lensgraph::rendergraph
