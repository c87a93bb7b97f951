// Reports in words and as JSON: see report.h.
#include "samples/lensgraph/capture/report.h"

#include <spdlog/spdlog.h>

#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "engine/process_usage.h"
#include "rendergraph/capture_series.h"
#include "samples/lensgraph/session.h"

namespace lensgraph::cli {
namespace {

using nlohmann::json;

/// The rendering's own warnings, and what its statistics tell.
std::vector<std::string> warningsOf(const host::Rendering& rendering) {
  std::vector<std::string> warnings;
  const auto& statistics = rendering.statistics;
  const auto add = [&](uint32_t count, const char* text) {
    if (count > 0) warnings.push_back(std::to_string(count) + text);
  };
  add(statistics.replacedTexels, " texels that were not finite were replaced by 0");
  warnings.insert(warnings.end(), rendering.warnings.begin(), rendering.warnings.end());
  add(statistics.transparentUnsorted, " pixels have too many alpha-blended layers: the nearest ones are missing there");
  add(statistics.transparentDropped, " transparent fragments found no room: the picture is incomplete");
  add(statistics.unsortedLists, " pixels have too many surfaces one behind another: some are missing there");
  return warnings;
}

json timesJson(const FrameTimes& times) {
  return {{"frames", times.cpuMs.size()},
          {"gpuMs", samplesJson(times.gpuMs)},
          {"wallMs", samplesJson(times.wallMs)},
          {"cpuMs", samplesJson(times.cpuMs)}};
}

void printJson(const Report& report, const std::vector<std::string>& warnings) {
  const host::Rendering& rendering = report.rendering;
  json document = renderingJson(report.device, report.input, report.choice, rendering);
  document["format"] = kReportFormat;
  document["formatVersion"] = kReportVersion;
  document["first"] = {{"gpuMs", rendering.gpuMs}, {"wallMs", rendering.wallMs}, {"cpuMs", rendering.cpuMs}};
  document["warm"] = timesJson(report.warm);
  document["memory"] = {{"graphBytes", rendering.graphBytes}, {"processBytes", engine::peakProcessBytes()}};
  document["warnings"] = warnings;
  document["notes"] = report.lines;
  std::cout << document.dump(2, ' ', false, json::error_handler_t::replace) << "\n";
}

void printTimes(const Report& report) {
  FrameTimes times = report.warm;
  const auto count = times.cpuMs.size();
  if (count == 0) times.add(report.rendering);
  const auto median = [](const std::vector<double>& samples) { return rendergraph::spreadOf(samples).median; };
  std::printf("time       ");
  if (report.rendering.executions > 0) std::printf("GPU %.2f ms, ", median(times.gpuMs));  // Else no device took part.
  std::printf("wall %.2f ms, CPU %.2f ms", median(times.wallMs), median(times.cpuMs));
  if (count > 0) std::printf(" (median of %zu warm frames)", count);
  std::printf("\n");
  constexpr double kBytesPerMegabyte = 1e6;
  std::printf("memory     graph %.1f MB, process %.0f MB\n",
              static_cast<double>(report.rendering.graphBytes) / kBytesPerMegabyte,
              static_cast<double>(engine::peakProcessBytes()) / kBytesPerMegabyte);
}

void printWords(const Report& report) {
  std::printf("device     %s\n", describe(report.device).c_str());
  std::printf("technique  %s\n", report.choice.name.c_str());
  for (const auto& parameter : host::requireTechnique(report.choice.name, "", "").parameters) {
    const auto given = report.choice.parameters.find(parameter.name);
    const auto& value = given == report.choice.parameters.end() ? parameter.defaultValue : given->second;
    std::printf("           %s = %s%s%s\n", std::string(parameter.name).c_str(), passes::toString(value).c_str(),
                parameter.unit.empty() ? "" : " ", std::string(parameter.unit).c_str());
  }
  const auto& color = report.rendering.color;
  std::printf("picture    %u x %u px\n", color.width, color.height);
  printTimes(report);
  const double estimate = report.rendering.estimatedError;
  if (estimate >= 0.0) std::printf("estimate   RMS error %.2g left\n", estimate);
  for (const auto& line : report.lines) std::printf("%s\n", line.c_str());
}

}  // namespace

void printReport(const Report& report, bool asJson) {
  const auto warnings = warningsOf(report.rendering);
  if (asJson) {
    printJson(report, warnings);
  } else {
    printWords(report);
  }
  Session::report(warnings);
}

}  // namespace lensgraph::cli
