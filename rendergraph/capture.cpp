// Counts what a plan moves, and writes captures as JSON.
#include "rendergraph/capture.h"

#include <ostream>

#include "rendergraph/capture_bytes.h"
#include "rendergraph/declaration.h"
#include "rendergraph/json_text.h"

namespace rendergraph {

namespace {

VkDeviceSize bytesOfAccess(const DeclaredResource& resource, const DeclaredAccess& access) {
  if (!resource.isImage) return resource.buffer.size;
  VkDeviceSize texels = 0;
  for (uint32_t level = access.range.firstMip; level < access.range.firstMip + access.range.mipCount; ++level) {
    const VkExtent2D extent = mipExtent(resource.image, level);
    texels += VkDeviceSize{extent.width} * extent.height;
  }
  return texels * access.range.layerCount * resource.image.samples * texelSize(resource.image.format);
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

CapturedPass countsOf(const Declaration& declaration, const PlannedPass& planned) {
  CapturedPass pass;
  pass.name = declaration.passes[planned.pass].name;
  pass.imageBarriers = static_cast<uint32_t>(planned.before.images.count);
  pass.bufferBarriers = static_cast<uint32_t>(planned.before.buffers.count);
  for (const DeclaredAccess& access : declaration.accessesOfPass(planned.pass)) {
    const DeclaredResource& resource = declaration.resources[access.resource];
    const VkDeviceSize bytes = bytesOfAccess(resource, access);
    if (access.needsContent() && !countedBefore(declaration, access, false)) pass.bytesRead += bytes;
    if (!access.writes()) continue;
    if (!countedBefore(declaration, access, true)) pass.bytesWritten += bytes;
    if (resource.isImage && pass.resolution.width == 0) {
      pass.resolution = mipExtent(resource.image, access.range.firstMip);
    }
  }
  return pass;
}

const char* nameOf(Timing timing) {
  switch (timing) {
    case Timing::none:
      return "none";
    case Timing::inlineTimestamps:
      return "inline";
    case Timing::isolated:
      return "isolated";
  }
  return "?";
}

}  // namespace

void beginCapture(Capture& capture, const Declaration& declaration, const Plan& plan, Timing timing) {
  capture.timing = nameOf(timing);
  capture.frameGpuMs = -1.0;
  capture.frameWallMs = 0.0;
  capture.memory = plan.memory;
  capture.passes.clear();
  for (const PlannedPass& planned : plan.passes) capture.passes.push_back(countsOf(declaration, planned));
}

void writeJson(std::ostream& out, const Capture& capture) {
  out << "{\n  \"timing\": " << jsonString(capture.timing) << ",\n  \"frameGpuMs\": " << capture.frameGpuMs
      << ",\n  \"frameWallMs\": " << capture.frameWallMs
      << ",\n  \"planReused\": " << (capture.planReused ? "true" : "false")
      << ",\n  \"memory\": {\"peakBytes\": " << capture.memory.peakBytes
      << ", \"unaliasedBytes\": " << capture.memory.unaliasedBytes << ", \"lowerBound\": " << capture.memory.lowerBound
      << "},\n  \"passes\": [";
  const char* separator = "\n";
  for (const CapturedPass& pass : capture.passes) {
    out << separator << "    {\"name\": " << jsonString(pass.name) << ", \"gpuMs\": " << pass.gpuMs
        << ", \"recordMs\": " << pass.recordMs << ", \"bytesRead\": " << pass.bytesRead
        << ", \"bytesWritten\": " << pass.bytesWritten << ", \"imageBarriers\": " << pass.imageBarriers
        << ", \"bufferBarriers\": " << pass.bufferBarriers << ", \"resolution\": [" << pass.resolution.width << ", "
        << pass.resolution.height << "]}";
    separator = ",\n";
  }
  out << "\n  ]\n}\n";
}

}  // namespace rendergraph
