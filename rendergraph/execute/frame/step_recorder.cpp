// One step: events, barriers, rendering, the pass's own recording.
#include "rendergraph/execute/frame/step_recorder.h"

#include <iterator>

#include "rendergraph/execute/resources/error_names.h"
#include "rendergraph/pass_context.h"

namespace lensgraph::rendergraph {

namespace {

/// Formats without a mean: their samples are resolved to the first one.
bool isInteger(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R8_UINT:
    case VK_FORMAT_R8_SINT:
    case VK_FORMAT_R8G8_UINT:
    case VK_FORMAT_R8G8_SINT:
    case VK_FORMAT_R8G8B8A8_UINT:
    case VK_FORMAT_R8G8B8A8_SINT:
    case VK_FORMAT_A2B10G10R10_UINT_PACK32:
    case VK_FORMAT_A2R10G10B10_UINT_PACK32:
    case VK_FORMAT_R16_UINT:
    case VK_FORMAT_R16_SINT:
    case VK_FORMAT_R16G16_UINT:
    case VK_FORMAT_R16G16_SINT:
    case VK_FORMAT_R16G16B16A16_UINT:
    case VK_FORMAT_R16G16B16A16_SINT:
    case VK_FORMAT_R32_UINT:
    case VK_FORMAT_R32_SINT:
    case VK_FORMAT_R32G32_UINT:
    case VK_FORMAT_R32G32_SINT:
    case VK_FORMAT_R32G32B32A32_UINT:
    case VK_FORMAT_R32G32B32A32_SINT:
      return true;
    default:
      return false;
  }
}

/// Every device can resolve depth to its first sample; means are optional.
VkResolveModeFlagBits resolveModeOf(VkFormat format) {
  const bool color = (aspectsOf(format) & VK_IMAGE_ASPECT_COLOR_BIT) != 0;
  return color && !isInteger(format) ? VK_RESOLVE_MODE_AVERAGE_BIT : VK_RESOLVE_MODE_SAMPLE_ZERO_BIT;
}

VkImageViewType attachmentView(const Subresources& range) {
  return range.layerCount > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
}

/// Families of a transfer of ownership; between queues of one family nothing is transferred.
template <class Barrier>
void setFamilies(std::span<const QueueFacts> queues, uint32_t from, uint32_t to, Barrier& barrier) {
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  if (from == kNone || to == kNone || queues[from].family == queues[to].family) return;
  barrier.srcQueueFamilyIndex = queues[from].family;
  barrier.dstQueueFamilyIndex = queues[to].family;
}

}  // namespace

VkDependencyInfo StepRecorder::dependencyOf(const BarrierBatch& batch) {
  imageBarriers_.clear();
  bufferBarriers_.clear();
  const std::span<const QueueFacts> queues = frame_->backend.queues();
  for (const ImageBarrier& barrier : frame_->plan->imagesOf(batch)) {
    VkImageMemoryBarrier2& image = imageBarriers_.emplace_back();
    image.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    image.srcStageMask = barrier.from.stages;
    image.srcAccessMask = barrier.from.access;
    image.dstStageMask = barrier.to.stages;
    image.dstAccessMask = barrier.to.access;
    image.oldLayout = barrier.oldLayout;
    image.newLayout = barrier.newLayout;
    setFamilies(queues, barrier.fromQueue, barrier.toQueue, image);
    image.image = frame_->objects[barrier.resource].image;
    image.subresourceRange = {barrier.range.aspects, barrier.range.firstMip, barrier.range.mipCount,
                              barrier.range.firstLayer, barrier.range.layerCount};
  }
  for (const BufferBarrier& barrier : frame_->plan->buffersOf(batch)) {
    VkBufferMemoryBarrier2& buffer = bufferBarriers_.emplace_back();
    buffer.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2;
    buffer.srcStageMask = barrier.from.stages;
    buffer.srcAccessMask = barrier.from.access;
    buffer.dstStageMask = barrier.to.stages;
    buffer.dstAccessMask = barrier.to.access;
    setFamilies(queues, barrier.fromQueue, barrier.toQueue, buffer);
    buffer.buffer = frame_->objects[barrier.resource].buffer;
    buffer.size = VK_WHOLE_SIZE;
  }
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.imageMemoryBarrierCount = static_cast<uint32_t>(imageBarriers_.size());
  dependency.pImageMemoryBarriers = imageBarriers_.data();
  dependency.bufferMemoryBarrierCount = static_cast<uint32_t>(bufferBarriers_.size());
  dependency.pBufferMemoryBarriers = bufferBarriers_.data();
  return dependency;
}

void StepRecorder::recordBarriers(const BarrierBatch& batch) {
  if (!batch.empty()) frame_->backend.barrier(state_.commands, dependencyOf(batch));
}

void StepRecorder::recordWaits(const PlannedPass& planned) {
  for (uint32_t i = planned.waits.first; i < planned.waits.first + planned.waits.count; ++i) {
    frame_->backend.waitEvent(state_.commands, frame_->events[i].get(), dependencyOf(frame_->plan->events[i].barriers));
  }
  recordBarriers(planned.before);
}

void StepRecorder::recordSets(const PlannedPass& planned) {
  for (const uint32_t event : frame_->plan->setsOf(planned)) {
    frame_->backend.setEvent(state_.commands, frame_->events[event].get(),
                             dependencyOf(frame_->plan->events[event].barriers));
  }
}

void StepRecorder::stamp(uint32_t step, uint32_t end) {
  if (!frame_->isStamped(step)) return;
  // ALL_COMMANDS at both ends: everything before has finished, so passes that overlap are not counted twice.
  frame_->backend.writeTimestamp(state_.commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, frame_->timestamps,
                                 2 * step + end);
}

VkRenderingAttachmentInfo StepRecorder::attachmentInfo(const PlannedAttachment& attachment, const VkClearValue& clear) {
  const VkFormat format = frame_->declaration->resources[attachment.resource].image.format;
  VkRenderingAttachmentInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  info.imageView = frame_->viewOf(attachment.resource, attachment.range, attachmentView(attachment.range));
  info.imageLayout = attachment.layout;
  info.loadOp = attachment.load;
  info.storeOp = attachment.store;
  info.clearValue = clear;
  if (attachment.resolve == kNone) return info;
  const PlannedAttachment& target = frame_->plan->attachments[attachment.resolve];
  info.resolveMode = resolveModeOf(format);
  info.resolveImageView = frame_->viewOf(target.resource, target.range, attachmentView(target.range));
  info.resolveImageLayout = target.layout;
  return info;
}

void StepRecorder::beginRendering(const PlannedPass& planned) {
  const Declaration& declaration = *frame_->declaration;
  VkClearValue depthClear{};
  colorClears_.clear();
  for (const DeclaredAccess& access : declaration.accessesOfPass(planned.pass)) {
    if (access.role == AttachmentRole::color) colorClears_.push_back(access.clear);
    if (access.role == AttachmentRole::depth) depthClear = access.clear;
  }
  colors_.clear();
  state_.colorFormats.clear();
  state_.depthFormat = VK_FORMAT_UNDEFINED;
  state_.samples = VK_SAMPLE_COUNT_1_BIT;
  const auto note = [&](const PlannedAttachment& attachment) {
    const ImageDesc& desc = declaration.resources[attachment.resource].image;
    state_.samples = desc.samples;
    return desc.format;
  };
  for (const PlannedAttachment& attachment : frame_->plan->colorsOf(planned)) {
    state_.colorFormats.push_back(note(attachment));
    colors_.push_back(attachmentInfo(attachment, colorClears_[colors_.size()]));
  }
  VkRenderingInfo rendering{};
  rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  rendering.renderArea = {{0, 0}, planned.renderArea};
  rendering.layerCount = planned.renderLayers;
  rendering.colorAttachmentCount = static_cast<uint32_t>(colors_.size());
  rendering.pColorAttachments = colors_.data();
  VkRenderingAttachmentInfo depth;
  for (const PlannedAttachment& attachment : frame_->plan->depthOf(planned)) {
    state_.depthFormat = note(attachment);
    depth = attachmentInfo(attachment, depthClear);
    rendering.pDepthAttachment = &depth;
  }
  frame_->backend.beginRendering(state_.commands, rendering);
}

void StepRecorder::recordDispatch(const DeclaredDispatch& dispatch) {
  const Declaration& declaration = *frame_->declaration;
  state_.bindings.clear();
  for (const DispatchBinding& binding : dispatch.bindings) {
    const DeclaredAccess& access = declaration.accesses[binding.access];
    ResolvedBinding resolved{};
    if (declaration.resources[access.resource].isImage) {
      const bool sampling = access.usage == Usage::sampled;
      Subresources range = access.range;
      // A view that shaders sample has one aspect.
      if (sampling && (range.aspects & VK_IMAGE_ASPECT_DEPTH_BIT) != 0) range.aspects = VK_IMAGE_ASPECT_DEPTH_BIT;
      resolved.kind = sampling ? Binding::Kind::sampledImage : Binding::Kind::storageImage;
      resolved.view = frame_->viewOf(access.resource, range, binding.viewType);
      resolved.layout = access.layout;
      resolved.sampler = binding.sampler;
    } else {
      resolved.kind = access.usage == Usage::uniform ? Binding::Kind::uniformBuffer : Binding::Kind::storageBuffer;
      resolved.buffer = frame_->objects[access.resource].buffer;
    }
    state_.bindings.push_back(resolved);
  }
  const bool isIndirect = dispatch.indirect != kNone;
  frame_->backend.dispatch(state_.commands,
                           {.program = *dispatch.program,
                            .bindings = state_.bindings,
                            .pushConstants = dispatch.pushConstants,
                            .specialization = dispatch.specialization,
                            .groups = dispatch.groups,
                            .indirect = isIndirect ? frame_->objects[dispatch.indirect].buffer : VK_NULL_HANDLE,
                            .indirectOffset = dispatch.indirectOffset});
}

void StepRecorder::runRecording(uint32_t step) {
  const PlannedPass& planned = frame_->plan->passes[step];
  const DeclaredPass& pass = frame_->declared(planned);
  if (pass.dispatch != nullptr) return recordDispatch(*pass.dispatch);
  if (pass.recorder == nullptr) return;
  state_.planned = &planned;
  PassContext context(state_, planned.pass);
  pass.recorder(pass.recording, context);
}

void StepRecorder::noteRecording(uint32_t step, double startMs) {
  CapturedPass& pass = frame_->capture->passes[step];
  pass.recordStartMs = startMs;
  pass.recordMs = millisecondsSince(frame_->start) - startMs;
}

void StepRecorder::recordStep(uint32_t step) {
  const double startMs = millisecondsSince(frame_->start);
  namingPass(frame_->declared(frame_->plan->passes[step]).name, [&] { recordNamed(step); });
  noteRecording(step, startMs);
}

void StepRecorder::recordNamed(uint32_t step) {
  const Plan& plan = *frame_->plan;
  const PlannedPass& planned = plan.passes[step];
  const bool raster = frame_->declared(planned).kind == PassKind::raster;
  const bool isContinued = step + 1 < plan.passes.size() && plan.passes[step + 1].continuesRendering;
  frame_->backend.beginLabel(state_.commands, frame_->declared(planned).name);
  recordWaits(planned);
  stamp(step, 0);
  if (raster && !planned.continuesRendering) beginRendering(planned);
  runRecording(step);
  if (raster && !isContinued) frame_->backend.endRendering(state_.commands);
  stamp(step, 1);
  recordSets(planned);
  frame_->backend.endLabel(state_.commands);
}

void StepRecorder::recordHostWait(uint32_t step) {
  recordWaits(frame_->plan->passes[step]);
}

void StepRecorder::runHostPass(uint32_t step) {
  const double startMs = millisecondsSince(frame_->start);
  state_.commands = {};
  runRecording(step);
  noteRecording(step, startMs);
}

}  // namespace lensgraph::rendergraph
