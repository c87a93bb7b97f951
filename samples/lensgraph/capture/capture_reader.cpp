// Checking of capture files: see capture_reader.h.
#include "samples/lensgraph/capture/capture_reader.h"

#include <limits>

#include "samples/host/json_reader.h"
#include "samples/lensgraph/capture/capture_file.h"

namespace lensgraph::cli {
namespace {

using host::JsonNode;

constexpr const char* kRemedy = "write it anew with lensgraph render --capture";
constexpr int64_t kMost = std::numeric_limits<int64_t>::max();

uint64_t countAt(const JsonNode& node, std::string_view name) {
  return static_cast<uint64_t>(node.at(name, kRemedy).integer(0, kMost));
}

std::string textAt(const JsonNode& node, std::string_view name) {
  return node.at(name, kRemedy).text();
}

MeasuredTime timeAt(const JsonNode& node, std::string_view name) {
  const JsonNode time = node.at(name, kRemedy);
  if (time.json().is_null()) return std::nullopt;
  const auto part = [&](const char* which) { return time.at(which, kRemedy).number(0.0, 1e12); };
  return rendergraph::Spread{.median = part("median"), .min = part("min"), .max = part("max")};
}

/// Checks that a field is null or an index below `count`.
void checkIndex(const JsonNode& node, std::string_view name, std::size_t count, bool mayBeNull) {
  const JsonNode index = node.at(name, kRemedy);
  if (mayBeNull && index.json().is_null()) return;
  if (count == 0) index.fail("there is nothing that it could be the index of", kRemedy);
  index.integer(0, static_cast<int64_t>(count) - 1);
}

PassFacts readPass(const JsonNode& node, std::size_t resources) {
  PassFacts pass;
  pass.name = textAt(node, "name");
  pass.gpuMs = timeAt(node, "gpuMs");
  pass.recordMs = timeAt(node, "recordMs");
  pass.bytesRead = countAt(node, "bytesRead");
  pass.bytesWritten = countAt(node, "bytesWritten");
  pass.imageBarriers = countAt(node, "imageBarriers");
  pass.bufferBarriers = countAt(node, "bufferBarriers");
  const auto extent = node.at("resolution", kRemedy).elements(2, "width and height");
  pass.width = static_cast<uint64_t>(extent[0].integer(0, kMost));
  pass.height = static_cast<uint64_t>(extent[1].integer(0, kMost));
  textAt(node, "kind");
  countAt(node, "queue");
  countAt(node, "barrierBatches");
  for (const JsonNode& use : node.at("uses", kRemedy).elements()) {
    checkIndex(use, "resource", resources, false);
    textAt(use, "usage");
  }
  return pass;
}

void checkResource(const JsonNode& node, std::size_t heaps, std::size_t steps) {
  for (const char* name : {"name", "origin", "kind"}) textAt(node, name);
  countAt(node, "contentBytes");
  checkIndex(node, "heap", heaps, true);
  if (!node.at("heap", kRemedy).json().is_null()) {
    countAt(node, "offset");
    countAt(node, "size");
  }
  // The step after the last stands for what is seen after the frame.
  checkIndex(node, "firstStep", steps + 1, true);
  checkIndex(node, "lastStep", steps + 1, true);
}

void readGraph(const JsonNode& graph, CaptureFacts& facts) {
  facts.timing = textAt(graph, "timing");
  facts.frames = countAt(graph, "frames");
  facts.frameGpuMs = timeAt(graph, "frameGpuMs");
  timeAt(graph, "passSumMs");
  facts.frameWallMs = timeAt(graph, "frameWallMs");
  facts.barrierBatches = countAt(graph, "barrierBatches");
  const JsonNode memory = graph.at("memory", kRemedy);
  facts.peakBytes = countAt(memory, "peakBytes");
  facts.unaliasedBytes = countAt(memory, "unaliasedBytes");
  facts.lowerBound = countAt(memory, "lowerBound");
  const auto heaps = memory.at("heaps", kRemedy).elements();
  for (const JsonNode& heap : heaps) {
    countAt(heap, "size");
    textAt(heap, "memory");
  }
  const auto resources = graph.at("resources", kRemedy).elements();
  const auto passes = graph.at("passes", kRemedy).elements();
  for (const JsonNode& pass : passes) facts.passes.push_back(readPass(pass, resources.size()));
  for (const JsonNode& resource : resources) checkResource(resource, heaps.size(), passes.size());
  for (const JsonNode& edge : graph.at("edges", kRemedy).elements()) {
    checkIndex(edge, "from", passes.size(), false);
    checkIndex(edge, "to", passes.size(), false);
    checkIndex(edge, "resource", resources.size(), false);
  }
  for (const JsonNode& culled : graph.at("culled", kRemedy).elements()) {
    textAt(culled, "name");
    textAt(culled, "reason");
  }
}

/// What must be equal for two captures' times to be of the same thing.
void readConditions(const JsonNode& root, CaptureFacts& facts) {
  const JsonNode device = root.at("device", kRemedy), program = root.at("program", kRemedy);
  facts.conditions["device"] = textAt(device, "name");
  facts.conditions["driver"] = textAt(device, "driver");
  facts.conditions["version"] = textAt(program, "version");
  facts.conditions["commit"] = textAt(program, "commit");
  facts.conditions["shot"] = textAt(root, "shot");
  facts.conditions["input hash"] = textAt(root, "inputHash");
  const auto extent = root.at("resolution", kRemedy).elements(2, "width and height");
  facts.conditions["resolution"] =
      std::to_string(extent[0].integer(1, kMost)) + " x " + std::to_string(extent[1].integer(1, kMost)) + " px";
  const JsonNode lens = root.at("lens", kRemedy);
  lens.at("apertureRadius", kRemedy).number(0.0, std::numeric_limits<double>::max());
  facts.conditions["lens"] = lens.json().dump();
  if (!lens.at("focusDistance", kRemedy).isString()) lens.at("focusDistance", kRemedy).number();
  textAt(device, "type");
  // Captures of pictures have none, nor have those of versions that drew both faces always.
  const auto faces = root.find("faces");
  if (faces && faces->isString()) facts.conditions["faces"] = faces->text();
  const JsonNode technique = root.at("technique", kRemedy);
  facts.conditions["technique"] = textAt(technique, "name");
  for (const auto& [name, value] : technique.at("parameters", kRemedy).fields()) {
    facts.conditions["parameter " + name] = value.json().dump();
  }
  facts.conditions["timing"] = facts.timing;
  countAt(root, "executions");
  timeAt(root, "gpuMs");
  timeAt(root, "wallMs");
  timeAt(root, "uninterrupted");
}

}  // namespace

CaptureFacts readCapture(const std::filesystem::path& file) {
  CaptureFacts facts;
  facts.file = file.string();
  facts.document = host::readJsonFile(file);
  const JsonNode root(facts.document, file);
  const auto& json = facts.document;
  if (!json.is_object() || json.value("format", nlohmann::json()) != kCaptureFormat) {
    root.fail("is no capture", "lensgraph render --capture writes them");
  }
  if (root.at("formatVersion", kRemedy).integer(0, kMost) != kCaptureVersion) {
    root.at("formatVersion", kRemedy)
        .fail("this program reads version " + std::to_string(kCaptureVersion) + " alone", kRemedy);
  }
  readGraph(root.at("graph", kRemedy), facts);
  readConditions(root, facts);
  return facts;
}

}  // namespace lensgraph::cli
