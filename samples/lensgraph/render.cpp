// lensgraph render: a shot file into a picture.
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/image_io.h"
#include "samples/lensgraph/capture_file.h"
#include "samples/lensgraph/commands.h"
#include "samples/lensgraph/output.h"
#include "samples/lensgraph/progress.h"
#include "samples/lensgraph/session.h"

namespace cli {
namespace {

void checkOutputs(const RenderArguments& arguments) {
  checkOutput(arguments.output, "--output", kPictureExtensions);
  if (arguments.capture) checkOutput(*arguments.capture, "--capture");
  if (arguments.depthOut) checkOutput(*arguments.depthOut, "--depth-out", kDepthExtensions);
  if (arguments.depthOut && *arguments.depthOut == arguments.output) {
    throw engine::Error({.file = arguments.output.string(),
                         .field = "--depth-out",
                         .reason = "is the same file as --output",
                         .remedy = "choose another"});
  }
  if (arguments.exposureEv) warnUnusedExposure(arguments.output);
}

void writeOutputs(const RenderArguments& arguments, const host::Shot& shot, const host::TechniqueChoice& choice,
                  const engine::DeviceDescription& device, const host::Rendering& rendering) {
  engine::writeImage(arguments.output, rendering.color, {.exposureEv = arguments.exposureEv.value_or(0.0)});
  if (arguments.depthOut) engine::writeImage(*arguments.depthOut, rendering.depth);
  if (!arguments.capture) return;
  CaptureInput input{arguments.shot.string(), {arguments.shot}, &shot.lens};
  for (const auto& part : shot.scene) input.files.push_back(part.path);
  writeTextFile(*arguments.capture, captureJson(device, input, choice, rendering).dump(2) + "\n");
}

}  // namespace

int runRender(const RenderArguments& arguments, const GlobalArguments& global) {
  host::Shot shot = host::readShot(arguments.shot);
  if (arguments.size) {
    shot.width = arguments.size->width;
    shot.height = arguments.size->height;
  }
  const auto choice = chooseTechnique({shot.technique, shot.parameters}, arguments.technique);
  checkOutputs(arguments);

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
  // Isolated passes are timed rightly on every device; a picture alone need not pay for that.
  options.execute.timing = arguments.capture ? rendergraph::Timing::isolated : rendergraph::Timing::inlineTimestamps;
  const host::Rendering rendering = renderer.render(shot, options);
  bar.wipe();

  writeOutputs(arguments, shot, choice, session.device().description(), rendering);
  printSummary(session.device().description(), choice, rendering);
  return session.finish();
}

}  // namespace cli
