// See the header.
#include "plan_checker/plan_maker.h"

#include <algorithm>

#include "rendergraph/declare/declaration.h"

namespace lensgraph {

using namespace rendergraph;

PlanMaker& PlanMaker::submission(uint32_t queue, std::initializer_list<SubmissionWait> waits) {
  PlannedSubmission submission{.queue = queue};
  submission.steps.first = static_cast<uint32_t>(plan_.passes.size());
  submission.waits = {static_cast<uint32_t>(plan_.submissionWaits.size()), static_cast<uint32_t>(waits.size())};
  plan_.submissionWaits.insert(plan_.submissionWaits.end(), waits);
  plan_.submissions.push_back(submission);
  return *this;
}

PlanMaker& PlanMaker::step(uint32_t pass, const Images& images, const Buffers& buffers,
                           const std::vector<Event>& events) {
  PlannedPass planned{.pass = pass, .queue = plan_.submissions.back().queue, .before = batch(images, buffers)};
  planned.waits = {static_cast<uint32_t>(plan_.events.size()), static_cast<uint32_t>(events.size())};
  for (const Event& event : events) {
    plan_.events.push_back({.setAfter = event.setAfter,
                            .waitBefore = static_cast<uint32_t>(plan_.passes.size()),
                            .barriers = batch(event.images, event.buffers)});
  }
  addAttachments(planned);
  plan_.passes.push_back(planned);
  ++plan_.submissions.back().steps.count;
  return *this;
}

PlanMaker& PlanMaker::continues() {
  PlannedPass& planned = plan_.passes.back();
  planned.continuesRendering = true;
  for (const Run& run : {planned.colors, planned.depth}) {
    for (uint32_t i = run.first; i < run.first + run.count; ++i) {
      plan_.attachments[i].load = VK_ATTACHMENT_LOAD_OP_LOAD;
    }
  }
  return *this;
}

PlanMaker& PlanMaker::atEnd(const Images& images, const Buffers& buffers) {
  plan_.submissions.back().atEnd = batch(images, buffers);
  return *this;
}

PlanMaker& PlanMaker::concurrent(uint32_t resource) {
  concurrent_.push_back(resource);
  return *this;
}

BarrierBatch PlanMaker::batch(const Images& images, const Buffers& buffers) {
  BarrierBatch result{
      .images = {static_cast<uint32_t>(plan_.imageBarriers.size()), static_cast<uint32_t>(images.size())},
      .buffers = {static_cast<uint32_t>(plan_.bufferBarriers.size()), static_cast<uint32_t>(buffers.size())}};
  plan_.imageBarriers.insert(plan_.imageBarriers.end(), images.begin(), images.end());
  plan_.bufferBarriers.insert(plan_.bufferBarriers.end(), buffers.begin(), buffers.end());
  return result;
}

void PlanMaker::addAttachments(PlannedPass& planned) {
  const DeclaredPass& pass = declaration_.passes[planned.pass];
  if (pass.kind != PassKind::raster) return;
  planned.renderArea = pass.renderArea;
  planned.renderLayers = pass.renderLayers;
  const auto add = [&](AttachmentRole role, Run& run) {
    run.first = static_cast<uint32_t>(plan_.attachments.size());
    for (const DeclaredAccess& access : declaration_.accesses) {
      if (access.pass != planned.pass || access.role != role) continue;
      const VkAttachmentLoadOp load = access.load == LoadOp::clear  ? VK_ATTACHMENT_LOAD_OP_CLEAR
                                      : access.load == LoadOp::load ? VK_ATTACHMENT_LOAD_OP_LOAD
                                                                    : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
      const VkAttachmentStoreOp store = access.writes() ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_NONE;
      plan_.attachments.push_back(
          {.resource = access.resource, .range = access.range, .layout = access.layout, .load = load, .store = store});
    }
    run.count = static_cast<uint32_t>(plan_.attachments.size()) - run.first;
  };
  add(AttachmentRole::color, planned.colors);
  add(AttachmentRole::depth, planned.depth);
}

void PlanMaker::place() {
  const auto steps = static_cast<uint32_t>(plan_.passes.size());
  for (uint32_t i = 0; i < declaration_.resources.size(); ++i) {
    const DeclaredResource& resource = declaration_.resources[i];
    Placement placement{.resource = i,
                        .heap = static_cast<uint32_t>(plan_.heaps.size()),
                        .firstStep = steps,
                        .concurrent = std::count(concurrent_.begin(), concurrent_.end(), i) > 0};
    for (uint32_t step = 0; step < steps; ++step) {
      for (const DeclaredAccess& access : declaration_.accesses) {
        if (access.pass != plan_.passes[step].pass || access.resource != i) continue;
        placement.firstStep = std::min(placement.firstStep, step);
        placement.lastStep = resource.exported ? steps : step;
      }
    }
    if (placement.firstStep == steps || resource.imported()) continue;
    if (resource.persistent()) {
      const VkImageLayout rest = resource.isImage ? restStateOf(resource).layout : VK_IMAGE_LAYOUT_GENERAL;
      plan_.persistent.push_back({.resource = i, .restLayout = rest, .concurrent = placement.concurrent});
      continue;
    }
    const MemoryRequirements needed =
        resource.isImage ? device_.requirements(resource.image, 0) : device_.requirements(resource.buffer, 0);
    placement.size = needed.size;
    plan_.heaps.push_back({.size = needed.size,
                           .memoryTypeBits = needed.memoryTypeBits,
                           .memory = resource.isImage ? MemoryKind::device : resource.buffer.memory,
                           .dedicated = needed.dedicated});
    plan_.placements.push_back(placement);
  }
}

void PlanMaker::count() {
  plan_.memory = {};
  for (uint32_t step = 0; step <= plan_.passes.size(); ++step) {
    VkDeviceSize alive = 0;
    for (const Placement& placement : plan_.placements) {
      if (placement.firstStep <= step && step <= placement.lastStep) alive += placement.size;
    }
    plan_.memory.lowerBound = std::max(plan_.memory.lowerBound, alive);
  }
  for (const PlannedHeap& heap : plan_.heaps) plan_.memory.peakBytes += heap.size;
  plan_.memory.unaliasedBytes = plan_.memory.peakBytes;
  plan_.barrierBatches = static_cast<uint32_t>(plan_.events.size());
  for (const PlannedPass& pass : plan_.passes) plan_.barrierBatches += pass.before.empty() ? 0 : 1;
  for (const PlannedSubmission& submission : plan_.submissions)
    plan_.barrierBatches += submission.atEnd.empty() ? 0 : 1;
}

Plan PlanMaker::finish() {
  for (uint32_t step = 0; step < plan_.passes.size(); ++step) {
    plan_.passes[step].sets.first = static_cast<uint32_t>(plan_.eventSets.size());
    for (uint32_t event = 0; event < plan_.events.size(); ++event) {
      if (plan_.events[event].setAfter == step) plan_.eventSets.push_back(event);
    }
    plan_.passes[step].sets.count = static_cast<uint32_t>(plan_.eventSets.size()) - plan_.passes[step].sets.first;
  }
  place();
  count();
  return plan_;
}

}  // namespace lensgraph
