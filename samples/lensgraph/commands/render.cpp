// lensgraph render: a shot file into a picture.
#include "engine/image/image_io.h"
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

}  // namespace

int runRender(const RenderArguments& arguments, const GlobalArguments& global) {
  host::Shot shot = host::readShot(arguments.shot);
  if (arguments.size) {
    shot.width = arguments.size->width;
    shot.height = arguments.size->height;
  }
  shot.faces = arguments.faces.value_or(shot.faces);
  const auto choice = chooseTechnique({shot.technique, shot.parameters}, arguments.technique);
  Inspection inspection(arguments.inspection);
  checkOutputs(arguments, inspection);

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

  CaptureInput input{arguments.shot.string(), {arguments.shot}, &shot.lens, shot.faces};
  for (const auto& part : shot.scene) input.files.push_back(part.path);
  writeOutputs(arguments, choice, device, rendering, inspection, input);
  printReport({device, input, choice, rendering, inspection.frameTimes(), {}}, arguments.inspection.json);
  return session.finish();
}

}  // namespace lensgraph::cli
