// What follows from a capture: who wrote what each read sees, and the bytes alive at each step.
#include "rendergraph/capture.h"

#include <algorithm>
#include <tuple>

#include "rendergraph/declare/subresources.h"

namespace lensgraph::rendergraph {

namespace {

/// A write whose content is still there, at least in part.
struct LiveWrite {
  uint32_t step = 0;
  Subresources range;
};

bool covers(const CapturedResource& resource, const Subresources& outer, const Subresources& inner) {
  return !resource.isImage || contains(outer, inner);
}

}  // namespace

std::vector<CapturedEdge> edgesOf(const Capture& capture) {
  std::vector<CapturedEdge> edges;
  std::vector<std::vector<LiveWrite>> writes(capture.resources.size());
  for (uint32_t step = 0; step < capture.passes.size(); ++step) {
    const std::vector<CapturedUse>& uses = capture.passes[step].uses;
    for (const CapturedUse& use : uses) {
      if (!use.reads) continue;
      for (const LiveWrite& write : writes[use.resource]) {
        if (!overlap(capture.resources[use.resource].isImage, write.range, use.range)) continue;
        edges.push_back({.from = write.step, .to = step, .resource = use.resource});
      }
    }
    // After the reads: what a pass reads is older than what it writes.
    for (const CapturedUse& use : uses) {
      if (!use.writes) continue;
      // A modify counts as well: it has read what it replaces, and hands it on.
      std::erase_if(writes[use.resource], [&](const LiveWrite& write) {
        return covers(capture.resources[use.resource], use.range, write.range);
      });
      writes[use.resource].push_back({.step = step, .range = use.range});
    }
  }
  // A pass may read one resource in several ways.
  const auto key = [](const CapturedEdge& edge) { return std::tuple(edge.to, edge.from, edge.resource); };
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

VkDeviceSize bytesAlive(const Capture& capture, uint32_t step) {
  VkDeviceSize bytes = 0;
  for (const CapturedResource& resource : capture.resources) {
    if (resource.heap == kNone) continue;
    if (resource.firstStep <= step && step <= resource.lastStep) bytes += resource.size;
  }
  return bytes;
}

}  // namespace lensgraph::rendergraph
