// Captures as JSON.
#include <ostream>
#include <string_view>

#include "rendergraph/capture_series.h"
#include "rendergraph/declare/names.h"
#include "rendergraph/inspect/json_text.h"

namespace lensgraph::rendergraph {

namespace {

/// A comma before every element but the first.
class Comma {
 public:
  friend std::ostream& operator<<(std::ostream& out, Comma& comma) {
    out << (comma.first_ ? "\n    " : ",\n    ");
    comma.first_ = false;
    return out;
  }

 private:
  bool first_ = true;
};

struct OrNull {
  uint32_t value;
};

std::ostream& operator<<(std::ostream& out, OrNull number) {
  if (number.value == kNone) return out << "null";
  return out << number.value;
}

std::ostream& operator<<(std::ostream& out, const Spread& spread) {
  if (spread.median < 0.0) return out << "null";
  return out << "{\"median\": " << spread.median << ", \"min\": " << spread.min << ", \"max\": " << spread.max << "}";
}

void writeUses(std::ostream& out, const CapturedPass& pass) {
  const char* separator = "";
  for (const CapturedUse& use : pass.uses) {
    out << separator << "{\"resource\": " << use.resource << ", \"usage\": " << jsonString(nameOf(use.usage))
        << ", \"reads\": " << (use.reads ? "true" : "false") << ", \"writes\": " << (use.writes ? "true" : "false")
        << "}";
    separator = ", ";
  }
}

void writePasses(std::ostream& out, const CaptureSeries& series) {
  Comma comma;
  for (uint32_t step = 0; step < series.structure().passes.size(); ++step) {
    const CapturedPass& pass = series.structure().passes[step];
    out << comma << "{\"name\": " << jsonString(pass.name) << ", \"kind\": " << jsonString(nameOf(pass.kind))
        << ", \"queue\": " << pass.queue << ", \"gpuMs\": " << series.gpuMs(step)
        << ", \"recordMs\": " << series.recordMs(step) << ", \"bytesRead\": " << pass.bytesRead
        << ", \"bytesWritten\": " << pass.bytesWritten << ", \"imageBarriers\": " << pass.imageBarriers
        << ", \"bufferBarriers\": " << pass.bufferBarriers << ", \"barrierBatches\": " << pass.barrierBatches
        << ", \"resolution\": [" << pass.resolution.width << ", " << pass.resolution.height << "], \"uses\": [";
    writeUses(out, pass);
    out << "]}";
  }
}

void writeResources(std::ostream& out, const Capture& capture) {
  Comma comma;
  for (const CapturedResource& resource : capture.resources) {
    out << comma << "{\"name\": " << jsonString(resource.name) << ", \"origin\": " << jsonString(resource.origin)
        << ", \"kind\": " << (resource.isImage ? "\"image\"" : "\"buffer\"");
    if (resource.isImage) {
      out << ", \"format\": " << static_cast<int>(resource.format) << ", \"extent\": [" << resource.width << ", "
          << resource.height << "], \"layers\": " << resource.layers << ", \"mips\": " << resource.mips;
    }
    out << ", \"contentBytes\": " << resource.contentBytes << ", \"heap\": " << OrNull{resource.heap};
    if (resource.heap != kNone) {
      out << ", \"offset\": " << resource.offset << ", \"size\": " << resource.size;
    }
    out << ", \"firstStep\": " << OrNull{resource.firstStep} << ", \"lastStep\": " << OrNull{resource.lastStep} << "}";
  }
}

void writeMemory(std::ostream& out, const Capture& capture) {
  out << "{\"peakBytes\": " << capture.memory.peakBytes << ", \"unaliasedBytes\": " << capture.memory.unaliasedBytes
      << ", \"lowerBound\": " << capture.memory.lowerBound << ", \"heaps\": [";
  const char* separator = "";
  for (const CapturedHeap& heap : capture.heaps) {
    out << separator << "{\"size\": " << heap.size << ", \"memory\": " << jsonString(nameOf(heap.memory)) << "}";
    separator = ", ";
  }
  out << "]}";
}

void writeLinks(std::ostream& out, const Capture& capture) {
  out << "  \"edges\": [";
  Comma comma;
  for (const CapturedEdge& edge : edgesOf(capture)) {
    out << comma << "{\"from\": " << edge.from << ", \"to\": " << edge.to << ", \"resource\": " << edge.resource << "}";
  }
  out << "\n  ],\n  \"culled\": [";
  comma = {};
  for (const CulledName& culled : capture.culled) {
    out << comma << "{\"name\": " << jsonString(culled.name) << ", \"reason\": " << jsonString(culled.reason) << "}";
  }
  out << "\n  ]\n";
}

}  // namespace

void writeJson(std::ostream& out, const CaptureSeries& series) {
  const Capture& capture = series.structure();
  out << "{\n  \"timing\": " << jsonString(capture.timing) << ",\n  \"frames\": " << series.frames()
      << ",\n  \"frameGpuMs\": " << series.frameGpuMs() << ",\n  \"passSumMs\": " << series.passSumMs()
      << ",\n  \"frameWallMs\": " << series.frameWallMs() << ",\n  \"plansReused\": " << series.plansReused()
      << ",\n  \"barrierBatches\": " << capture.barrierBatches
      << ",\n  \"barriersAtEnd\": {\"images\": " << capture.imageBarriersAtEnd
      << ", \"buffers\": " << capture.bufferBarriersAtEnd << "},\n  \"memory\": ";
  writeMemory(out, capture);
  out << ",\n  \"passes\": [";
  writePasses(out, series);
  out << "\n  ],\n  \"resources\": [";
  writeResources(out, capture);
  out << "\n  ],\n";
  writeLinks(out, capture);
  out << "}\n";
}

void writeJson(std::ostream& out, const Capture& capture) {
  CaptureSeries series;
  series.add(capture);
  writeJson(out, series);
}

}  // namespace lensgraph::rendergraph
