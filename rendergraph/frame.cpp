// One execution, pass by pass: barriers, rendering, recording, submissions, timestamps.
#include "rendergraph/frame.h"

#include <algorithm>
#include <string>

namespace rendergraph {

void Frame::open() {
  if (commands_ != VK_NULL_HANDLE) return;
  commands_ = state_.backend.beginCommands();
  stamped_.clear();
  if (opened_) return;
  opened_ = true;
  state_.retained.recordStart(commands_);
}

double Frame::submit() {
  if (commands_ == VK_NULL_HANDLE) return 0.0;
  const VkCommandBuffer commands = std::exchange(commands_, VK_NULL_HANDLE);
  submitted_ = true;  // Even when it fails: nobody knows how far the device came.
  const double submitMs = millisecondsSince(start_);
  state_.backend.submitAndWait(commands);
  const double wallMs = millisecondsSince(start_) - submitMs;
  readStamps(submitMs);
  return wallMs;
}

void Frame::stamp(uint32_t step) {
  if (timing_ != Timing::inlineTimestamps) return;
  const bool second = !stamped_.empty() && stamped_.back() == step;
  const auto slot = static_cast<uint32_t>(second ? 2 * stamped_.size() - 1 : 2 * stamped_.size());
  if (!second && slot + 1 >= state_.backend.maxTimestamps()) return;  // Later passes stay unmeasured.
  // ALL_COMMANDS at both ends: everything before has finished, so passes that overlap are not counted twice.
  state_.backend.writeTimestamp(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, slot);
  if (!second) stamped_.push_back(step);
}

void Frame::readStamps(double submitMs) {
  if (stamped_.empty()) return;
  std::vector<double> times(stamped_.size() * 2);
  state_.backend.readTimestamps(times);
  for (std::size_t i = 0; i < stamped_.size(); ++i) {
    CapturedPass& pass = state_.capture.passes[stamped_[i]];
    pass.gpuMs = (times[2 * i + 1] - times[2 * i]) * 1e-6;
    pass.gpuStartMs = submitMs + (times[2 * i] - times.front()) * 1e-6;  // The device's clock has its own origin.
  }
  state_.capture.frameGpuMs = std::max(0.0, state_.capture.frameGpuMs) + (times.back() - times.front()) * 1e-6;
  stamped_.clear();
}

void Frame::recordBarriers(const BarrierBatch& batch) {
  if (batch.empty()) return;
  imageBarriers_.clear();
  bufferBarriers_.clear();
  for (const ImageBarrier& barrier : state_.current->plan.imagesOf(batch)) {
    VkImageMemoryBarrier2 image{};
    image.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    image.srcStageMask = barrier.from.stages;
    image.srcAccessMask = barrier.from.access;
    image.dstStageMask = barrier.to.stages;
    image.dstAccessMask = barrier.to.access;
    image.oldLayout = barrier.oldLayout;
    image.newLayout = barrier.newLayout;
    image.srcQueueFamilyIndex = image.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    image.image = state_.bound[barrier.resource].image;
    image.subresourceRange = {barrier.range.aspects, barrier.range.firstMip, barrier.range.mipCount,
                              barrier.range.firstLayer, barrier.range.layerCount};
    imageBarriers_.push_back(image);
  }
  for (const BufferBarrier& barrier : state_.current->plan.buffersOf(batch)) {
    VkBufferMemoryBarrier2 buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2;
    buffer.srcStageMask = barrier.from.stages;
    buffer.srcAccessMask = barrier.from.access;
    buffer.dstStageMask = barrier.to.stages;
    buffer.dstAccessMask = barrier.to.access;
    buffer.srcQueueFamilyIndex = buffer.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    buffer.buffer = state_.bound[barrier.resource].buffer;
    buffer.size = VK_WHOLE_SIZE;
    bufferBarriers_.push_back(buffer);
  }
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.imageMemoryBarrierCount = static_cast<uint32_t>(imageBarriers_.size());
  dependency.pImageMemoryBarriers = imageBarriers_.data();
  dependency.bufferMemoryBarrierCount = static_cast<uint32_t>(bufferBarriers_.size());
  dependency.pBufferMemoryBarriers = bufferBarriers_.data();
  state_.backend.barrier(commands_, dependency);
}

void Frame::beginRendering(const PlannedPass& planned) {
  const Declaration& declaration = *state_.declaration;
  std::vector<VkClearValue> colorClears, depthClears;
  for (const DeclaredAccess& access : declaration.accessesOfPass(planned.pass)) {
    if (access.role == AttachmentRole::color) colorClears.push_back(access.clear);
    if (access.role == AttachmentRole::depth) depthClears.push_back(access.clear);
  }
  const auto infoOf = [&](const PlannedAttachment& attachment, const VkClearValue& clear) {
    VkRenderingAttachmentInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    info.imageView =
        state_.viewOf(attachment.resource, attachment.range,
                      attachment.range.layerCount > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D);
    info.imageLayout = attachment.layout;
    info.loadOp = attachment.load;
    info.storeOp = attachment.store;
    info.clearValue = clear;
    return info;
  };
  std::vector<VkRenderingAttachmentInfo> colors;
  const std::span<const PlannedAttachment> plannedColors = state_.current->plan.colorsOf(planned);
  for (std::size_t i = 0; i < plannedColors.size(); ++i) {
    colors.push_back(infoOf(plannedColors[i], colorClears[i]));
    state_.colorFormats.push_back(declaration.resources[plannedColors[i].resource].image.format);
  }
  VkRenderingInfo rendering{};
  rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  rendering.renderArea = {{0, 0}, planned.renderArea};
  rendering.layerCount = planned.renderLayers;
  rendering.colorAttachmentCount = static_cast<uint32_t>(colors.size());
  rendering.pColorAttachments = colors.data();
  VkRenderingAttachmentInfo depth;
  for (const PlannedAttachment& attachment : state_.current->plan.depthOf(planned)) {
    depth = infoOf(attachment, depthClears.front());
    state_.depthFormat = declaration.resources[attachment.resource].image.format;
    rendering.pDepthAttachment = &depth;
  }
  state_.backend.beginRendering(commands_, rendering);
}

void Frame::runRecording(const PlannedPass& planned) {
  const DeclaredPass& pass = state_.declaration->passes[planned.pass];
  if (pass.recorder == nullptr) return;
  PassContext context(executor_, planned.pass, commands_);
  pass.recorder(pass.recording, context);
}

void Frame::noteRecording(uint32_t step, double startMs) {
  CapturedPass& pass = state_.capture.passes[step];
  pass.recordStartMs = startMs;
  pass.recordMs = millisecondsSince(start_) - startMs;
  recordedMs_ += pass.recordMs;
}

void Frame::recordPass(uint32_t step) {
  const double startMs = millisecondsSince(start_);
  const PlannedPass& planned = state_.current->plan.passes[step];
  const DeclaredPass& pass = state_.declaration->passes[planned.pass];
  state_.planned = &planned;
  state_.colorFormats.clear();
  state_.depthFormat = VK_FORMAT_UNDEFINED;
  state_.backend.beginLabel(commands_, pass.name);
  recordBarriers(planned.before);
  stamp(step);
  if (pass.kind == PassKind::raster) beginRendering(planned);
  runRecording(planned);
  if (pass.kind == PassKind::raster) state_.backend.endRendering(commands_);
  stamp(step);
  state_.backend.endLabel(commands_);
  state_.planned = nullptr;
  noteRecording(step, startMs);
}

void Frame::recordHostPass(uint32_t step) {
  const PlannedPass& planned = state_.current->plan.passes[step];
  if (!planned.before.empty()) {
    open();
    recordBarriers(planned.before);
  }
  submit();
  const double startMs = millisecondsSince(start_);
  state_.planned = &planned;
  runRecording(planned);
  state_.planned = nullptr;
  noteRecording(step, startMs);
}

void Frame::execute() {
  const Plan& plan = state_.current->plan;
  const double beganMs = millisecondsSince(start_);
  if (timing_ == Timing::isolated) {
    open();
    submit();  // The zeroing of persistent content belongs to no pass.
  }
  for (uint32_t step = 0; step < plan.passes.size(); ++step) {
    if (state_.declaration->passes[plan.passes[step].pass].kind == PassKind::host) {
      recordHostPass(step);
      continue;
    }
    open();
    recordPass(step);
    if (timing_ != Timing::isolated) continue;
    CapturedPass& pass = state_.capture.passes[step];
    pass.gpuStartMs = millisecondsSince(start_);
    pass.gpuMs = submit();
  }
  open();
  recordBarriers(plan.submissions.back().atEnd);
  submit();
  // A clock of its own, so that the passes' times can be held against it.
  if (timing_ == Timing::isolated) state_.capture.frameGpuMs = millisecondsSince(start_) - beganMs - recordedMs_;
}

void Frame::record(VkCommandBuffer commands) {
  const Plan& plan = state_.current->plan;
  for (const PlannedPass& planned : plan.passes) {
    const DeclaredPass& pass = state_.declaration->passes[planned.pass];
    if (pass.kind != PassKind::host) continue;
    throw GraphError({state_.declaration->problem(Misuse::undeclaredAccess, planned.pass, kNone,
                                                  "a host pass cannot run inside the host's own submission",
                                                  "use execute(), or do its work before or after", pass.where)});
  }
  commands_ = commands;
  state_.retained.recordStart(commands_);
  for (uint32_t step = 0; step < plan.passes.size(); ++step) recordPass(step);
  recordBarriers(plan.submissions.back().atEnd);
}

}  // namespace rendergraph
