// From a shot to the ray tracer's view, and back to a rendering.
#include "samples/host/raytraced.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "engine/error.h"
#include "engine/process_usage.h"
#include "engine/raytracer/ray_tracer.h"
#include "samples/host/raytraced/raytraced_technique.h"
#include "samples/host/shot_scene.h"
#include "samples/host/warnings.h"

namespace lensgraph::host {

static_assert(kNothingHit == engine::kNoDepth);

namespace {

engine::RayTracedView viewOf(const engine::Scene& scene, const Shot& shot) {
  engine::RayTracedView view;
  view.camera = shotCamera(shot, scene);
  view.viewpoint = {.viewFromWorld = view.camera.viewFromWorld,
                    .metersPerUnit = shot.lens.metersPerUnit,
                    .lit = shot.shading == Shading::lit,
                    .faces = shot.faces};
  view.lens = rayLensOf(shot.lens);
  view.width = static_cast<uint32_t>(shot.width);
  view.height = static_cast<uint32_t>(shot.height);
  view.background = shot.background;
  return view;
}

std::vector<std::string> warningsOf(const engine::Scene& scene, bool hasEnvironment, const Shot& shot,
                                    const RaytracedParameters& parameters, uint32_t samples,
                                    const engine::FloatImage& color) {
  std::vector<std::string> warnings;
  const auto add = [&](const std::optional<std::string>& warning) {
    if (warning) warnings.push_back(*warning);
  };
  add(ignoredLensWarning(shot.lens, raytracedTechnique()));
  if (shot.faces == engine::DrawnFaces::material) add(backFacesWarning(color, shot.background, scene));
  if (shot.shading == Shading::lit) add(unlitSceneWarning(scene, hasEnvironment));
  if (samples > static_cast<uint32_t>(parameters.samples)) {
    add("the checkpoint holds " + std::to_string(samples) + " samples a pixel, and the picture has them all");
  }
  return warnings;
}

}  // namespace

bool isRaytraced(std::string_view technique) {
  return technique == raytracedTechnique().name;
}

Rendering renderRaytraced(const engine::Scene& scene, const std::optional<engine::Environment>& environment,
                          const Shot& shot, const RenderOptions& options) {
  const auto problems = passes::check(options.parameters, raytracedTechnique().parameters);
  if (!problems.empty()) {
    throw engine::Error({.file = {},
                         .field = "raytraced." + problems.front().parameter,
                         .reason = problems.front().reason,
                         .remedy = problems.front().remedy});
  }
  const RaytracedParameters parameters = raytracedParameters(options.parameters);
  engine::RayTracerOptions tracing;
  tracing.samples = static_cast<uint32_t>(parameters.samples);
  tracing.filter = parameters.pixelFilter;
  tracing.seed = static_cast<uint32_t>(parameters.seed);
  tracing.threads = static_cast<uint32_t>(parameters.threads);
  tracing.wantDepth = options.wantDepth;
  tracing.checkpoint = options.checkpoint;
  tracing.progress = options.progress;

  const double cpuMsBefore = engine::processCpuMs();
  const auto start = std::chrono::steady_clock::now();
  auto picture = engine::traceRays(scene, environment ? &*environment : nullptr, viewOf(scene, shot), tracing);
  Rendering rendering;
  rendering.wallMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  rendering.cpuMs = engine::processCpuMs() - cpuMsBefore;
  rendering.statistics.replacedTexels =
      static_cast<uint32_t>(std::min<uint64_t>(picture.replacedSamples, std::numeric_limits<uint32_t>::max()));
  rendering.warnings = warningsOf(scene, environment.has_value(), shot, parameters, picture.samples, picture.color);
  rendering.color = std::move(picture.color);
  rendering.depth = std::move(picture.depth);
  return rendering;
}

Rendering renderRaytraced(const Shot& shot, const RenderOptions& options, std::vector<std::string>& warnings) {
  const engine::Scene scene = loadShotScene(shot, warnings);
  return renderRaytraced(scene, loadShotEnvironment(shot), shot, options);
}

void failWithoutGraph(const std::string& field, const std::string& what) {
  throw engine::Error({.file = "command line",
                       .field = field,
                       .reason = "raytraced works on the CPU and has no render graph: there is " + what,
                       .remedy = "choose another technique (see lensgraph techniques)"});
}

}  // namespace lensgraph::host
