// Writers of declaration and plan.
#include "rendergraph/dump.h"

#include <ostream>
#include <string>
#include <string_view>

#include "rendergraph/declare/declaration.h"
#include "rendergraph/declare/names.h"
#include "rendergraph/graph.h"
#include "rendergraph/inspect/json_text.h"
#include "rendergraph/inspect/vulkan_names.h"
#include "rendergraph/memory_notes.h"

namespace lensgraph::rendergraph {

namespace {

/// "mip 2", "mips 0-3 layer 1"; empty for the whole image.
std::string rangeText(const Subresources& range, const ImageDesc& desc) {
  const auto part = [](std::string_view word, uint32_t first, uint32_t count, uint32_t total) -> std::string {
    if (count == total) return {};
    std::string text = " " + std::string(word) + (count > 1 ? "s " : " ") + std::to_string(first);
    return count > 1 ? text + "-" + std::to_string(first + count - 1) : text;
  };
  std::string text = part("mip", range.firstMip, range.mipCount, desc.mips) +
                     part("layer", range.firstLayer, range.layerCount, desc.layers);
  if (range.aspects != aspectsOf(desc.format)) {
    text += (range.aspects & VK_IMAGE_ASPECT_DEPTH_BIT) != 0 ? " depth" : " stencil";
  }
  return text;
}

class Words {
 public:
  Words(const Declaration& declaration) : declaration_(declaration) {}
  std::string resource(uint32_t index) const { return std::string(declaration_.resources[index].name); }
  std::string pass(uint32_t index) const {
    return index == kNone ? "host" : std::string(declaration_.passes[index].name);
  }
  std::string range(uint32_t index, const Subresources& range) const {
    const DeclaredResource& resource = declaration_.resources[index];
    return resource.isImage ? rangeText(range, resource.image) : "";
  }
  std::string dependency(const AccessPoint& from, const AccessPoint& to) const {
    return stageNames(from.stages) + "/" + accessNames(from.access) + " -> " + stageNames(to.stages) + "/" +
           accessNames(to.access);
  }
  const Declaration& declaration() const { return declaration_; }

 private:
  const Declaration& declaration_;
};

void writeBatch(std::ostream& out, const Words& words, const Plan& plan, const BarrierBatch& batch,
                std::string_view indent) {
  for (const ImageBarrier& barrier : plan.imagesOf(batch)) {
    out << indent << "barrier " << words.resource(barrier.resource) << words.range(barrier.resource, barrier.range)
        << ": " << words.dependency(barrier.from, barrier.to) << ", " << layoutName(barrier.oldLayout) << " -> "
        << layoutName(barrier.newLayout) << " (" << nameOf(barrier.reason) << ")\n";
  }
  for (const BufferBarrier& barrier : plan.buffersOf(batch)) {
    out << indent << "barrier " << words.resource(barrier.resource) << ": "
        << words.dependency(barrier.from, barrier.to) << " (" << nameOf(barrier.reason) << ")\n";
  }
}

void writeAttachment(std::ostream& out, const Words& words, const PlannedAttachment& attachment) {
  out << "  attachment " << words.resource(attachment.resource) << words.range(attachment.resource, attachment.range)
      << ": " << nameOf(attachment.load) << ", " << nameOf(attachment.store) << ", " << layoutName(attachment.layout)
      << "\n";
}

void writePoint(std::ostream& out, const Words& words, const AccessPoint& point) {
  out << "{\"pass\": " << jsonString(words.pass(point.pass)) << ", \"stages\": " << jsonString(stageNames(point.stages))
      << ", \"access\": " << jsonString(accessNames(point.access)) << "}";
}

template <class Barrier>
void writeBarrierJson(std::ostream& out, const Words& words, const Barrier& barrier) {
  out << "{\"resource\": " << barrier.resource << ", \"reason\": " << jsonString(nameOf(barrier.reason))
      << ", \"from\": ";
  writePoint(out, words, barrier.from);
  out << ", \"to\": ";
  writePoint(out, words, barrier.to);
}

void writeBatchJson(std::ostream& out, const Words& words, const Plan& plan, const BarrierBatch& batch) {
  out << "[";
  const char* separator = "";
  for (const ImageBarrier& barrier : plan.imagesOf(batch)) {
    out << separator;
    writeBarrierJson(out, words, barrier);
    const Subresources& range = barrier.range;
    out << ", \"mips\": [" << range.firstMip << ", " << range.mipCount << "], \"layers\": [" << range.firstLayer << ", "
        << range.layerCount << "], \"oldLayout\": " << jsonString(layoutName(barrier.oldLayout))
        << ", \"newLayout\": " << jsonString(layoutName(barrier.newLayout)) << "}";
    separator = ", ";
  }
  for (const BufferBarrier& barrier : plan.buffersOf(batch)) {
    out << separator;
    writeBarrierJson(out, words, barrier);
    out << "}";
    separator = ", ";
  }
  out << "]";
}

void writeResourcesJson(std::ostream& out, const Declaration& declaration, const Plan& plan) {
  const std::vector<std::string> notes = memoryNotes(declaration, plan);
  out << "  \"resources\": [";
  const char* separator = "\n";
  for (std::size_t i = 0; i < notes.size(); ++i) {
    const DeclaredResource& resource = declaration.resources[i];
    out << separator << "    {\"name\": " << jsonString(resource.name)
        << ", \"origin\": " << jsonString(nameOf(resource.origin))
        << ", \"exported\": " << (resource.exported ? "true" : "false") << ", \"memory\": " << jsonString(notes[i]);
    if (resource.isImage) {
      const ImageDesc& desc = resource.image;
      out << ", \"format\": " << static_cast<int>(desc.format) << ", \"width\": " << desc.width
          << ", \"height\": " << desc.height << ", \"layers\": " << desc.layers << ", \"mips\": " << desc.mips << "}";
    } else {
      out << ", \"bytes\": " << resource.buffer.size << "}";
    }
    separator = ",\n";
  }
  out << "\n  ],\n";
}

void writePassesJson(std::ostream& out, const Words& words, const Plan& plan) {
  const Declaration& declaration = words.declaration();
  out << "  \"passes\": [";
  const char* separator = "\n";
  for (const PlannedPass& planned : plan.passes) {
    const DeclaredPass& pass = declaration.passes[planned.pass];
    out << separator << "    {\"name\": " << jsonString(pass.name) << ", \"kind\": " << jsonString(nameOf(pass.kind))
        << ", \"queue\": " << planned.queue << ", \"accesses\": [";
    const char* comma = "";
    for (const DeclaredAccess& access : declaration.accessesOfPass(planned.pass)) {
      out << comma << "{\"resource\": " << access.resource << ", \"version\": " << access.version
          << ", \"mode\": " << jsonString(nameOf(access.mode)) << ", \"usage\": " << jsonString(nameOf(access.usage))
          << "}";
      comma = ", ";
    }
    out << "], \"barriers\": ";
    writeBatchJson(out, words, plan, planned.before);
    out << "}";
    separator = ",\n";
  }
  out << "\n  ],\n  \"after\": ";
  writeBatchJson(out, words, plan, plan.submissions.back().atEnd);
  out << ",\n  \"culled\": [";
  separator = "\n";
  for (const CulledPass& culled : plan.culled) {
    out << separator << "    {\"name\": " << jsonString(words.pass(culled.pass))
        << ", \"reason\": " << jsonString(culled.reason) << "}";
    separator = ",\n";
  }
  out << "\n  ],\n";
}

void writeMemoryJson(std::ostream& out, const Words& words, const Plan& plan) {
  out << "  \"placements\": [";
  const char* separator = "\n";
  for (const Placement& placement : plan.placements) {
    out << separator << "    {\"name\": " << jsonString(words.resource(placement.resource))
        << ", \"heap\": " << placement.heap << ", \"offset\": " << placement.offset << ", \"size\": " << placement.size
        << ", \"firstStep\": " << placement.firstStep << ", \"lastStep\": " << placement.lastStep << "}";
    separator = ",\n";
  }
  out << "\n  ],\n  \"memory\": {\"peakBytes\": " << plan.memory.peakBytes
      << ", \"unaliasedBytes\": " << plan.memory.unaliasedBytes << ", \"lowerBound\": " << plan.memory.lowerBound
      << "},\n  \"barrierBatches\": " << plan.barrierBatches << "\n";
}

void writeDotEdges(std::ostream& out, const Declaration& declaration, uint32_t pass) {
  for (const DeclaredAccess& access : declaration.accessesOfPass(pass)) {
    const std::string label = std::string(nameOf(access.usage));
    if (access.needsContent()) {
      out << "  r" << access.resource << " -> p" << pass << " [label=" << jsonString(label) << "];\n";
    }
    if (access.writes()) {
      out << "  p" << pass << " -> r" << access.resource << " [label=" << jsonString(label) << "];\n";
    }
  }
}

}  // namespace

void writeDot(std::ostream& out, const Graph& graph, const Plan& plan) {
  const Declaration& declaration = graph.declaration();
  out << "digraph rendergraph {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n";
  for (uint32_t index = 0; index < declaration.resources.size(); ++index) {
    const DeclaredResource& resource = declaration.resources[index];
    out << "  r" << index << " [shape=" << (resource.isImage ? "ellipse" : "hexagon")
        << ", label=" << jsonString(resource.name) << (resource.observable() ? ", peripheries=2" : "") << "];\n";
  }
  for (uint32_t step = 0; step < plan.passes.size(); ++step) {
    const uint32_t pass = plan.passes[step].pass;
    const std::string label = std::to_string(step) + ": " + std::string(declaration.passes[pass].name);
    out << "  p" << pass << " [shape=box, style=filled, fillcolor=lightgrey, label=" << jsonString(label) << "];\n";
    writeDotEdges(out, declaration, pass);
  }
  for (const CulledPass& culled : plan.culled) {
    out << "  p" << culled.pass
        << " [shape=box, style=dashed, label=" << jsonString(declaration.passes[culled.pass].name)
        << ", tooltip=" << jsonString(culled.reason) << "];\n";
    writeDotEdges(out, declaration, culled.pass);
  }
  out << "}\n";
}

void writeJson(std::ostream& out, const Graph& graph, const Plan& plan) {
  const Words words(graph.declaration());
  out << "{\n";
  writeResourcesJson(out, graph.declaration(), plan);
  writePassesJson(out, words, plan);
  writeMemoryJson(out, words, plan);
  out << "}\n";
}

void writeText(std::ostream& out, const Graph& graph, const Plan& plan) {
  const Declaration& declaration = graph.declaration();
  const Words words(declaration);
  for (uint32_t step = 0; step < plan.passes.size(); ++step) {
    const PlannedPass& planned = plan.passes[step];
    out << step << " " << nameOf(declaration.passes[planned.pass].kind) << " " << words.pass(planned.pass) << ":";
    const char* separator = " ";
    for (const DeclaredAccess& access : declaration.accessesOfPass(planned.pass)) {
      out << separator << nameOf(access.mode) << " " << words.resource(access.resource)
          << words.range(access.resource, access.range) << " v" << access.version << " as " << nameOf(access.usage);
      separator = ", ";
    }
    out << "\n";
    writeBatch(out, words, plan, planned.before, "  ");
    for (const PlannedAttachment& attachment : plan.colorsOf(planned)) writeAttachment(out, words, attachment);
    for (const PlannedAttachment& attachment : plan.depthOf(planned)) writeAttachment(out, words, attachment);
  }
  if (!plan.submissions.back().atEnd.empty()) {
    out << "after\n";
    writeBatch(out, words, plan, plan.submissions.back().atEnd, "  ");
  }
  for (const CulledPass& culled : plan.culled) {
    out << "culled " << words.pass(culled.pass) << ": " << culled.reason << "\n";
  }
  for (const Placement& placement : plan.placements) {
    out << "memory " << words.resource(placement.resource) << ": heap " << placement.heap << " +" << placement.offset
        << ", " << placement.size << " bytes, steps " << placement.firstStep << "-" << placement.lastStep << "\n";
  }
}

}  // namespace lensgraph::rendergraph
