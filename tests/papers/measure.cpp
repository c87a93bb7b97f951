// Rendering, timing and comparing, and the result file.
#include "measure.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "engine/error.h"
#include "engine/image/image_io.h"
#include "engine/metrics/metrics.h"
#include "engine/vulkan/device.h"

namespace lensgraph::papers {
namespace {

using nlohmann::ordered_json;
using passes::ParameterSet;

constexpr int kRuns = 1;

host::Rendering renderOnce(host::Renderer& renderer, const host::Shot& shot, const std::string& technique,
                           const ParameterSet& parameters) {
  host::RenderOptions options;
  options.technique = technique;
  options.parameters = parameters;
  return renderer.render(shot, options);
}

ordered_json toJson(const ParameterSet& parameters) {
  ordered_json json = ordered_json::object();
  for (const auto& [name, value] : parameters) {
    std::visit([&, &key = name](const auto& held) { json[key] = held; }, value);
  }
  return json;
}

/// Where the ray-traced picture of a shot is, if it has one.
std::filesystem::path rayTraced(const std::string& shotFile) {
  return std::filesystem::path(shotFile).parent_path() / "dof.exr";
}

}  // namespace

engine::FloatImage pictureOf(host::Renderer& renderer, const host::Shot& shot, const std::string& technique,
                             const ParameterSet& parameters) {
  return renderOnce(renderer, shot, technique, parameters).color;
}

engine::FloatImage referenceOf(host::Renderer& renderer, const host::Shot& shot, const std::string& file) {
  if (const auto truth = rayTraced(file); std::filesystem::exists(truth)) return engine::readImage(truth);
  return pictureOf(renderer, shot, "accumulation", {{"lensSamples", int64_t{1024}}, {"viewsPerFrame", int64_t{8}}});
}

ordered_json measure(host::Renderer& renderer, const host::Shot& shot, const std::string& technique,
                     const ParameterSet& parameters, const engine::FloatImage& reference) {
  const auto first = renderOnce(renderer, shot, technique, parameters);
  double least = 1e30;
  for (int run = 0; run < kRuns; ++run) {
    least = std::min(least, renderOnce(renderer, shot, technique, parameters).wallMs);
  }
  const auto metrics = engine::compareImages(first.color, reference);
  const double ssim = metrics.ssim.value_or(0.0);
  const auto json = toJson(parameters);
  std::printf("  %-20s %9.1f ms  SSIM %.4f  %6.2f dB  %s\n", technique.c_str(), least, ssim, metrics.psnr,
              json.dump().c_str());
  std::fflush(stdout);
  return {{"technique", technique}, {"parameters", json}, {"ms", least}, {"psnr", metrics.psnr}, {"ssim", ssim}};
}

int run(int argc, char** argv,
        ordered_json (*rowsOf)(host::Renderer& renderer, const host::Shot& shot, const std::string& file)) {
  if (argc < 4 || std::strcmp(argv[1], "-o") != 0) {
    std::fprintf(stderr, "usage: %s -o RESULT.json SHOT.json…\n", argv[0]);
    return 2;
  }
  try {
    engine::Device device;
    ordered_json scenes = ordered_json::array();
    for (int i = 3; i < argc; ++i) {
      host::Shot shot = host::readShot(argv[i]);
      // The ray tracer saw both faces of every surface.
      if (std::filesystem::exists(rayTraced(argv[i]))) shot.faces = engine::DrawnFaces::both;
      std::vector<std::string> warnings;
      host::Renderer renderer(device, shot, warnings);
      std::printf("%s\n", shot.name.c_str());
      scenes.push_back({{"scene", shot.name}, {"width", shot.width}, {"height", shot.height}});
      scenes.back()["rows"] = rowsOf(renderer, shot, argv[i]);
    }
    const ordered_json result = {
        {"device", device.description().name}, {"driver", device.description().driver}, {"scenes", std::move(scenes)}};
    std::ofstream(argv[2]) << result.dump(1) << "\n";
  } catch (const engine::Error& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 1;
  }
  return 0;
}

}  // namespace lensgraph::papers
