// The demo's page and table: see demo_page.h.
#include "samples/lensgraph/pages/demo_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "samples/lensgraph/error_map.h"
#include "samples/lensgraph/pages/page_template.h"

namespace lensgraph::cli {
namespace {

using nlohmann::json;

constexpr char kTemplate[] = {
#include "generated/demo_page.inc"
};

std::string fixed(double value, int digits) {
  if (std::isinf(value)) return value > 0.0 ? "∞" : "-∞";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string ssimText(const std::optional<double>& ssim) {
  return ssim ? fixed(*ssim, 4) : "–";
}

json resultJson(const DemoResult& result) {
  return {{"technique", result.technique},       {"title", result.title},           {"picture", result.picture},
          {"errorPicture", result.errorPicture}, {"gpuMs", fixed(result.gpuMs, 2)}, {"wallMs", fixed(result.wallMs, 2)},
          {"psnr", fixed(result.psnr, 2)},       {"ssim", ssimText(result.ssim)}};
}

json sceneJson(const DemoScene& scene) {
  json results = json::array();
  for (const auto& result : scene.results) results.push_back(resultJson(result));
  json choices = json::array({{{"label", "reference"}, {"file", scene.reference}}});
  for (const auto& result : scene.results) choices.push_back({{"label", result.technique}, {"file", result.picture}});
  // The slider opens on the first technique's picture against the reference.
  return {{"id", scene.id},
          {"sceneName", scene.name},
          {"reference", scene.reference},
          {"referenceWall", fixed(scene.referenceWallMs, 0)},
          {"left", scene.results.empty() ? scene.reference : scene.results.front().picture},
          {"width", scene.width},
          {"height", scene.height},
          {"choices", std::move(choices)},
          {"results", std::move(results)}};
}

/// Means over the scenes; those of PSNR leave out pictures that equal their reference.
json summaryJson(const DemoReport& report) {
  json rows = json::array();
  if (report.scenes.empty()) return rows;
  for (const auto& first : report.scenes.front().results) {
    double gpuMs = 0.0, wallMs = 0.0, psnr = 0.0, ssim = 0.0;
    int scenes = 0, finite = 0, withSsim = 0;
    for (const auto& scene : report.scenes) {
      for (const auto& result : scene.results) {
        if (result.technique != first.technique) continue;
        ++scenes;
        gpuMs += result.gpuMs;
        wallMs += result.wallMs;
        if (std::isfinite(result.psnr)) psnr += result.psnr, ++finite;
        if (result.ssim) ssim += *result.ssim, ++withSsim;
      }
    }
    rows.push_back({{"technique", first.technique},
                    {"title", first.title},
                    {"gpuMs", fixed(gpuMs / scenes, 2)},
                    {"wallMs", fixed(wallMs / scenes, 2)},
                    {"psnr", finite > 0 ? fixed(psnr / finite, 2) : "∞"},
                    {"ssim", withSsim > 0 ? fixed(ssim / withSsim, 4) : "–"}});
  }
  return rows;
}

}  // namespace

std::string demoPage(const DemoReport& report) {
  json scenes = json::array();
  for (const auto& scene : report.scenes) scenes.push_back(sceneJson(scene));
  return fillTemplate(kTemplate, {{"device", report.device},
                                  {"version", report.version},
                                  {"referenceSamples", report.referenceSamples},
                                  {"errorEnd", fixed(kErrorMapEnd, 2)},
                                  {"summary", summaryJson(report)},
                                  {"scenes", std::move(scenes)}});
}

std::string demoTable(const DemoReport& report) {
  std::size_t sceneWidth = 5, techniqueWidth = 9;
  for (const auto& scene : report.scenes) {
    sceneWidth = std::max(sceneWidth, scene.id.size());
    for (const auto& result : scene.results) techniqueWidth = std::max(techniqueWidth, result.technique.size());
  }
  std::string table;
  const auto addRow = [&](const std::string& scene, const std::string& technique, const std::string& gpu,
                          const std::string& wall, const std::string& psnr, const std::string& ssim) {
    char row[512];
    std::snprintf(row, sizeof row, "%-*s  %-*s  %10s  %10s  %8s  %7s\n", static_cast<int>(sceneWidth), scene.c_str(),
                  static_cast<int>(techniqueWidth), technique.c_str(), gpu.c_str(), wall.c_str(), psnr.c_str(),
                  ssim.c_str());
    table += row;
  };
  addRow("scene", "technique", "GPU ms", "wall ms", "PSNR dB", "SSIM");
  for (const auto& scene : report.scenes) {
    for (const auto& result : scene.results) {
      addRow(scene.id, result.technique, fixed(result.gpuMs, 2), fixed(result.wallMs, 2),
             std::isinf(result.psnr) ? "equal" : fixed(result.psnr, 2), result.ssim ? fixed(*result.ssim, 4) : "-");
    }
  }
  return table;
}

}  // namespace lensgraph::cli
