// What follows from declaration and plan: bytes, barriers, lifetimes, memory.
#include "rendergraph/inspect/capture_builder.h"

#include <algorithm>

#include "rendergraph/capture.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/declare/names.h"
#include "rendergraph/declare/subresources.h"

namespace lensgraph::rendergraph {

namespace {

VkDeviceSize bytesOfRange(const DeclaredResource& resource, const Subresources& range) {
  if (!resource.isImage) return resource.buffer.size;
  VkDeviceSize texels = 0;
  for (uint32_t level = range.firstMip; level < range.firstMip + range.mipCount; ++level) {
    const VkExtent2D extent = mipExtent(resource.image, level);
    texels += VkDeviceSize{extent.width} * extent.height;
  }
  return texels * range.layerCount * resource.image.samples * texelSize(resource.image.format);
}

/// Whether an earlier access of the pass has counted the same range already.
bool countedBefore(const Declaration& declaration, const DeclaredAccess& access, bool writing) {
  for (const DeclaredAccess& other : declaration.accessesOfPass(access.pass)) {
    if (&other == &access) return false;
    if (other.resource != access.resource || !(writing ? other.writes() : other.needsContent())) continue;
    if (contains(other.range, access.range)) return true;
  }
  return false;
}

void countBarriers(CapturedPass& pass, const Plan& plan, const PlannedPass& planned) {
  const auto add = [&](const BarrierBatch& batch) {
    pass.imageBarriers += batch.images.count;
    pass.bufferBarriers += batch.buffers.count;
    pass.barrierBatches += !batch.empty();
  };
  pass.imageBarriers = pass.bufferBarriers = pass.barrierBatches = 0;
  add(planned.before);
  for (const PlannedEvent& event : plan.waitsOf(planned)) add(event.barriers);
}

void countPass(CapturedPass& pass, const Declaration& declaration, const Plan& plan, const PlannedPass& planned) {
  const DeclaredPass& declared = declaration.passes[planned.pass];
  pass.name.assign(declared.name);
  pass.kind = declared.kind;
  pass.queue = planned.queue;
  pass.gpuMs = pass.gpuStartMs = -1.0;
  pass.recordMs = pass.recordStartMs = 0.0;
  pass.bytesRead = pass.bytesWritten = 0;
  countBarriers(pass, plan, planned);
  pass.resolution = {0, 0};
  pass.uses.clear();
  for (const DeclaredAccess& access : declaration.accessesOfPass(planned.pass)) {
    const DeclaredResource& resource = declaration.resources[access.resource];
    const VkDeviceSize bytes = bytesOfRange(resource, access.range);
    pass.uses.push_back({.resource = access.resource,
                         .usage = access.usage,
                         .range = access.range,
                         .reads = access.needsContent(),
                         .writes = access.writes()});
    if (access.needsContent() && !countedBefore(declaration, access, false)) pass.bytesRead += bytes;
    if (!access.writes()) continue;
    if (!countedBefore(declaration, access, true)) pass.bytesWritten += bytes;
    if (resource.isImage && pass.resolution.width == 0) {
      pass.resolution = mipExtent(resource.image, access.range.firstMip);
    }
  }
}

void describeResource(CapturedResource& out, const DeclaredResource& resource) {
  std::string name = std::move(out.name);  // Keeps its memory.
  name.assign(resource.name);
  out = {};
  out.name = std::move(name);
  out.origin = nameOf(resource.origin);
  out.isImage = resource.isImage;
  if (resource.isImage) {
    out.format = resource.image.format;
    out.width = resource.image.width;
    out.height = resource.image.height;
    out.layers = resource.image.layers;
    out.mips = resource.image.mips;
  }
  out.contentBytes = bytesOfRange(resource, resolved({}, resource.image));
}

/// Steps of what the graph has not placed: from its first to its last use.
void widenLifetime(CapturedResource& resource, uint32_t step) {
  if (resource.firstStep == kNone) resource.firstStep = step;
  resource.lastStep = step;
}

void describeMemory(Capture& capture, const Declaration& declaration, const Plan& plan) {
  capture.resources.resize(declaration.resources.size());
  for (std::size_t i = 0; i < capture.resources.size(); ++i) {
    describeResource(capture.resources[i], declaration.resources[i]);
  }
  for (uint32_t step = 0; step < plan.passes.size(); ++step) {
    for (const CapturedUse& use : capture.passes[step].uses) widenLifetime(capture.resources[use.resource], step);
  }
  for (const Placement& placement : plan.placements) {
    CapturedResource& resource = capture.resources[placement.resource];
    resource.heap = placement.heap;
    resource.offset = placement.offset;
    resource.size = placement.size;
    resource.firstStep = placement.firstStep;
    resource.lastStep = placement.lastStep;
  }
  for (std::size_t i = 0; i < capture.resources.size(); ++i) {
    CapturedResource& resource = capture.resources[i];
    const bool used = resource.firstStep != kNone;
    if (used && declaration.resources[i].observable()) resource.lastStep = static_cast<uint32_t>(plan.passes.size());
  }
  capture.heaps.clear();
  for (const PlannedHeap& heap : plan.heaps) capture.heaps.push_back({.size = heap.size, .memory = heap.memory});
}

}  // namespace

void beginCapture(Capture& capture, const Declaration& declaration, const Plan& plan, Timing timing) {
  capture.timing.assign(nameOf(timing));
  capture.frameGpuMs = -1.0;
  capture.frameWallMs = 0.0;
  capture.memory = plan.memory;
  capture.barrierBatches = plan.barrierBatches;
  capture.imageBarriersAtEnd = capture.bufferBarriersAtEnd = 0;
  for (const PlannedSubmission& submission : plan.submissions) {
    capture.imageBarriersAtEnd += submission.atEnd.images.count;
    capture.bufferBarriersAtEnd += submission.atEnd.buffers.count;
  }
  capture.passes.resize(plan.passes.size());
  for (std::size_t i = 0; i < plan.passes.size(); ++i) countPass(capture.passes[i], declaration, plan, plan.passes[i]);
  describeMemory(capture, declaration, plan);
  capture.culled.resize(plan.culled.size());
  for (std::size_t i = 0; i < plan.culled.size(); ++i) {
    capture.culled[i].name.assign(declaration.passes[plan.culled[i].pass].name);
    capture.culled[i].reason.assign(plan.culled[i].reason);
  }
}

}  // namespace lensgraph::rendergraph
