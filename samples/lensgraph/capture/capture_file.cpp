// Captures as JSON: see capture_file.h.
#include "samples/lensgraph/capture/capture_file.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "passes/lens/physical_lens.h"
#include "samples/host/measures/quality.h"
#include "samples/host/measures/shot_files.h"
#include "samples/lensgraph/version.h"

namespace lensgraph::cli {

using nlohmann::json;

json toJson(const passes::ParameterValue& value) {
  return std::visit([](const auto& held) { return json(held); }, value);
}

json toJson(double value) {
  return host::jsonNumber(value);
}

json toJson(const engine::DeviceDescription& device) {
  return {{"name", device.name}, {"type", device.type}, {"driver", device.driver}};
}

json toJson(const rendergraph::Spread& spread) {
  if (spread.median < 0.0) return {};
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

json samplesJson(const std::vector<double>& samples) {
  json spread = toJson(rendergraph::spreadOf(samples));
  if (!spread.is_null()) spread["samples"] = samples;
  return spread;
}

json allParameters(const host::TechniqueChoice& choice) {
  json parameters = json::object();
  for (const auto& info : host::requireTechnique(choice.name, "", "").parameters) {
    const auto given = choice.parameters.find(info.name);
    parameters[std::string(info.name)] = toJson(given == choice.parameters.end() ? info.defaultValue : given->second);
  }
  return parameters;
}

json renderingJson(const engine::DeviceDescription& device, const CaptureInput& input,
                   const host::TechniqueChoice& choice, const host::Rendering& rendering) {
  const auto& statistics = rendering.statistics;
  return {
      {"program", {{"name", "lensgraph"}, {"version", kVersion}, {"commit", kCommit}}},
      {"device", toJson(device)},
      {"shot", input.source},
      {"inputHash", host::hashOfFiles(input.files)},
      {"resolution", {rendering.color.width, rendering.color.height}},
      {"lens",
       {{"apertureRadius", passes::apertureRadius(*input.lens)}, {"focusDistance", toJson(input.lens->focusDistance)}}},
      {"faces", input.faces ? json(host::nameOf(*input.faces)) : json()},
      {"technique", {{"name", choice.name}, {"parameters", allParameters(choice)}}},
      {"executions", rendering.executions},
      {"estimatedError", rendering.estimatedError < 0.0 ? json() : toJson(rendering.estimatedError)},
      {"statistics",
       {{"replacedTexels", statistics.replacedTexels},
        {"transparentNodes", statistics.transparentNodes},
        {"transparentDropped", statistics.transparentDropped},
        {"transparentUnsorted", statistics.transparentUnsorted},
        {"fragmentNodes", statistics.fragmentNodes},
        {"fragmentNodesDropped", statistics.fragmentNodesDropped},
        {"listFragments", statistics.listFragments},
        {"listFragmentsDropped", statistics.listFragmentsDropped},
        {"unsortedLists", statistics.unsortedLists},
        {"clampedCoc", statistics.clampedCoc}}},
  };
}

json captureJson(const engine::DeviceDescription& device, const CaptureInput& input,
                 const host::TechniqueChoice& choice, const host::Rendering& rendering,
                 const Measurement& measurement) {
  std::stringstream graph;
  rendergraph::writeJson(graph, measurement.series);
  json capture = renderingJson(device, input, choice, rendering);
  capture["format"] = kCaptureFormat;
  capture["formatVersion"] = kCaptureVersion;
  capture["gpuMs"] = toJson(rendergraph::spreadOf(measurement.gpuMs));
  capture["uninterrupted"] = toJson(rendergraph::spreadOf(measurement.uninterruptedMs));
  capture["wallMs"] = toJson(rendergraph::spreadOf(measurement.wallMs));
  capture["graph"] = json::parse(graph);
  return capture;
}

}  // namespace lensgraph::cli
