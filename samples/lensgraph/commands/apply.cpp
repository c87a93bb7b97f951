// lensgraph apply: a technique on a picture and its depth, wherever they come from.
#include <limits>

#include "engine/error.h"
#include "engine/image/image_io.h"
#include "samples/lensgraph/capture/inspection.h"
#include "samples/lensgraph/capture/report.h"
#include "samples/lensgraph/commands/applied_pictures.h"
#include "samples/lensgraph/output.h"
#include "samples/lensgraph/progress.h"
#include "samples/lensgraph/session.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {
namespace {

[[noreturn]] void failUsage(const std::string& field, const std::string& reason, const std::string& remedy) {
  throw engine::Error({.file = "command line", .field = field, .reason = reason, .remedy = remedy});
}

/// The option that sets a member of passes::Lens.
std::string optionOf(const std::string& lensField) {
  if (lensField == "focalLengthMm") return "--focal-length-mm";
  if (lensField == "fStop") return "--fstop";
  if (lensField == "focusDistance") return "--focus";
  return lensField;
}

passes::Lens lensOf(const ApplyArguments& arguments) {
  passes::Lens lens;
  lens.focusDistance = arguments.focusDistance;
  if (arguments.apertureRadius) {
    lens.apertureRadius = *arguments.apertureRadius;
    if (!(lens.apertureRadius >= 0.0 && lens.apertureRadius <= std::numeric_limits<float>::max())) {
      failUsage("--aperture-radius", "must be 0 or more metres", "0 turns depth of field off");
    }
  } else if (arguments.focalLengthMm && arguments.fStop) {
    lens.focalLengthMm = *arguments.focalLengthMm;
    lens.fStop = *arguments.fStop;
  } else {
    failUsage("apply", "no aperture given", "give --aperture-radius, or --focal-length-mm and --fstop");
  }
  const auto problems = passes::validate(lens);
  if (!problems.empty()) {
    failUsage(optionOf(problems.front().field), problems.front().reason, problems.front().remedy);
  }
  return lens;
}

void checkTechnique(const host::TechniqueChoice& choice) {
  if (host::requireTechnique(choice.name, "command line", "--technique").input == passes::TechniqueInput::image) return;
  std::string usable;
  for (const auto& technique : passes::techniques()) {
    if (technique.input != passes::TechniqueInput::image) continue;
    usable += (usable.empty() ? "" : ", ") + std::string(technique.name);
  }
  failUsage("--technique", choice.name + " draws the scene and cannot work on a picture", "those that can: " + usable);
}

}  // namespace

int runApply(const ApplyArguments& arguments, const GlobalArguments& global) {
  const auto choice = chooseTechnique({arguments.technique.technique, {}}, arguments.technique);
  checkTechnique(choice);
  if (!(arguments.fovyDeg > 0.0 && arguments.fovyDeg < 180.0)) {
    failUsage("--fovy", "must be above 0 and below 180 degrees", "");
  }
  const passes::Lens lens = lensOf(arguments);
  checkDepthArguments(arguments.depthMeaning);
  Inspection inspection(arguments.inspection);
  if (!arguments.output.empty()) checkOutput(arguments.output, "--output", kPictureExtensions);
  std::vector<OutputFile> files = inspection.outputs();
  files.push_back({arguments.output, "--output"});
  requireDistinct(files);
  if (arguments.exposureEv && !arguments.output.empty()) warnUnusedExposure(arguments.output);
  const AppliedPictures pictures = readAppliedPictures(arguments);

  Session session(global);
  host::Renderer renderer(session.device());
  ProgressBar bar("filtering");
  host::RenderOptions options{.technique = choice.name,
                              .parameters = choice.parameters,
                              .execute = {},
                              .wantDepth = false,
                              .progress = [&](uint32_t done, uint32_t total) { bar.update(done, total); }};
  const auto& device = session.device().description();
  const auto rendering = inspection.render(device, options, [&](const host::RenderOptions& now) {
    return renderer.apply(pictures.color, pictures.depth, arguments.fovyDeg, lens, now);
  });
  bar.wipe();
  if (inspection.imageDumps().listsOnly()) {
    inspection.imageDumps().printList();
    return session.finish();
  }

  writePicture(arguments.output, rendering.color, arguments.exposureEv);
  const CaptureInput input{arguments.color.string(), {arguments.color, arguments.depth}, &lens};
  inspection.write(device, input, choice, rendering);
  printReport({device, input, choice, rendering, inspection.frameTimes(), pictures.summary}, arguments.inspection.json);
  return session.finish();
}

}  // namespace lensgraph::cli
