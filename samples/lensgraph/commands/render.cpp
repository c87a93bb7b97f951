// lensgraph render: a shot file into a picture.
#include "engine/error.h"
#include "engine/image/image_io.h"
#include "engine/raytracer/ray_tracer.h"
#include "samples/host/measures/shot_files.h"
#include "samples/host/raytraced.h"
#include "samples/host/shot_scene.h"
#include "samples/lensgraph/capture/capture_file.h"
#include "samples/lensgraph/capture/inspection.h"
#include "samples/lensgraph/capture/report.h"
#include "samples/lensgraph/output.h"
#include "samples/lensgraph/progress.h"
#include "samples/lensgraph/session.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {
namespace {

void checkOutputs(const RenderArguments& arguments, const Inspection& inspection) {
  if (!arguments.output.empty()) checkOutput(arguments.output, "--output", kPictureExtensions);
  if (arguments.depthOut) checkOutput(*arguments.depthOut, "--depth-out", kDepthExtensions);
  std::vector<OutputFile> files = inspection.outputs();
  files.push_back({arguments.output, "--output"});
  if (arguments.depthOut) files.push_back({*arguments.depthOut, "--depth-out"});
  if (arguments.checkpoint) files.push_back({*arguments.checkpoint, "--checkpoint"});
  requireDistinct(files);
  if (arguments.exposureEv && !arguments.output.empty()) warnUnusedExposure(arguments.output);
}

void writeOutputs(const RenderArguments& arguments, const host::TechniqueChoice& choice,
                  const engine::DeviceDescription& device, const host::Rendering& rendering,
                  const Inspection& inspection, const CaptureInput& input) {
  writePicture(arguments.output, rendering.color, arguments.exposureEv);
  if (arguments.depthOut) engine::writeImage(*arguments.depthOut, rendering.depth);
  inspection.write(device, input, choice, rendering);
}

[[noreturn]] void failCheckpoint(const std::string& reason, const std::string& remedy) {
  throw engine::Error({.file = "command line", .field = "--checkpoint", .reason = reason, .remedy = remedy});
}

/// Options that this technique has no use for are errors rather than files that never appear.
void checkTechniqueOptions(const RenderArguments& arguments, const host::TechniqueChoice& choice) {
  if (!host::isRaytraced(choice.name)) {
    if (arguments.checkpoint) failCheckpoint(choice.name + " keeps no state", "only raytraced does");
    return;
  }
  const InspectionArguments& inspection = arguments.inspection;
  if (inspection.capture) host::failWithoutGraph("--capture", "nothing to capture");
  if (inspection.trace) host::failWithoutGraph("--trace", "nothing to trace");
  if (!inspection.dumps.empty()) host::failWithoutGraph("--dump-image", "no image inside it");
  if (!arguments.checkpoint) return;
  if (arguments.checkpoint->empty()) failCheckpoint("is empty", "name a file");
  checkOutput(*arguments.checkpoint, "--checkpoint");
}

CaptureInput inputOf(const RenderArguments& arguments, const host::Shot& shot) {
  return {arguments.shot.string(), host::filesOf(shot), &shot.lens, shot.faces};
}

/// Without a Vulkan device.
int renderOnCpu(const RenderArguments& arguments, const host::Shot& shot, const host::TechniqueChoice& choice) {
  ProgressBar bar("ray tracing");
  host::RenderOptions options{.technique = choice.name,
                              .parameters = choice.parameters,
                              .execute = {},
                              .wantDepth = arguments.depthOut.has_value(),
                              .progress = [&](uint32_t done, uint32_t total) { bar.update(done, total); },
                              .checkpoint = arguments.checkpoint.value_or("")};
  std::vector<std::string> warnings;
  const engine::Scene scene = host::loadShotScene(shot, warnings);
  const auto environment = host::loadShotEnvironment(shot);
  const host::Rendering rendering = host::renderRaytraced(scene, environment, shot, options);
  options.checkpoint.clear();  // Times are of whole pictures.
  FrameTimes times;
  for (int frame = 0; frame < arguments.inspection.framesTimed.value_or(0); ++frame) {
    times.add(host::renderRaytraced(scene, environment, shot, options));
  }
  bar.wipe();
  Session::report(warnings);
  writePicture(arguments.output, rendering.color, arguments.exposureEv);
  if (arguments.depthOut) engine::writeImage(*arguments.depthOut, rendering.depth);
  const engine::DeviceDescription device{
      .name = "CPU", .type = "cpu", .driver = engine::rayTracingLibrary(), .missing = {}};
  const CaptureInput input = inputOf(arguments, shot);
  printReport({device, input, choice, rendering, times, {}}, arguments.inspection.json);
  return 0;
}

}  // namespace

int runRender(const RenderArguments& arguments, const GlobalArguments& global) {
  host::Shot shot = host::readShot(arguments.shot);
  if (arguments.size) {
    shot.width = arguments.size->width;
    shot.height = arguments.size->height;
  }
  shot.faces = arguments.faces.value_or(shot.faces);
  const auto choice = chooseTechnique({shot.technique, shot.parameters}, arguments.technique);
  checkTechniqueOptions(arguments, choice);
  Inspection inspection(arguments.inspection);
  checkOutputs(arguments, inspection);
  if (host::isRaytraced(choice.name)) return renderOnCpu(arguments, shot, choice);

  Session session(global);
  std::vector<std::string> warnings;
  host::Renderer renderer(session.device(), shot, warnings);
  Session::report(warnings);

  ProgressBar bar("rendering");
  host::RenderOptions options{.technique = choice.name,
                              .parameters = choice.parameters,
                              .execute = {},
                              .wantDepth = arguments.depthOut.has_value(),
                              .progress = [&](uint32_t done, uint32_t total) { bar.update(done, total); }};
  const auto& device = session.device().description();
  const host::Rendering rendering =
      inspection.render(device, options, [&](const host::RenderOptions& now) { return renderer.render(shot, now); });
  bar.wipe();
  if (inspection.imageDumps().listsOnly()) {
    inspection.imageDumps().printList();
    return session.finish();
  }

  const CaptureInput input = inputOf(arguments, shot);
  writeOutputs(arguments, choice, device, rendering, inspection, input);
  printReport({device, input, choice, rendering, inspection.frameTimes(), {}}, arguments.inspection.json);
  return session.finish();
}

}  // namespace lensgraph::cli
