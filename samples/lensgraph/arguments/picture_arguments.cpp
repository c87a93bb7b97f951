// The words of the subcommands that make pictures and graphs.
#include <memory>
#include <vector>

#include "samples/lensgraph/arguments/options.h"

namespace lensgraph::cli {
namespace {

void addDepthMeaning(CLI::App& app, DepthArguments& depth) {
  app.add_option("--depth-kind", depth.kind,
                 "z: along the axis (default); ray: along each pixel's ray; disparity: 1/z, and normalized: z, both "
                 "between --depth-near and --depth-far")
      ->type_name("KIND")
      ->check(CLI::IsMember({"z", "ray", "disparity", "normalized"}));
  app.add_option("--depth-scale", depth.scale,
                 "Metres per unit of z and ray (default 1; PNG, which holds integers, needs it: .001 for millimetres)")
      ->type_name("S");
  app.add_option("--depth-near", depth.nearest, "Nearest depth in metres of disparity and normalized")->type_name("M");
  app.add_option("--depth-far", depth.farthest,
                 "Farthest depth in metres of disparity (may be infinity) and normalized")
      ->type_name("M");
  app.add_option("--depth-white", depth.white,
                 "Whether white (1, or the largest integer) is near or far (default: near for disparity, far for "
                 "normalized)")
      ->type_name("near|far")
      ->check(CLI::IsMember({"near", "far"}));
}

}  // namespace

Action addRender(CLI::App& app) {
  auto* sub = app.add_subcommand("render", "Render a shot file into a picture");
  auto a = std::make_shared<RenderArguments>();
  sub->add_option("shot", a->shot, "Shot file")->type_name("SHOT.json")->required();
  addTechnique(*sub, a->technique, false);
  addSize(*sub, a->size);
  addFaces(*sub, a->faces);
  addExposure(*sub, a->exposureEv);
  addInspection(*sub, a->inspection);
  sub->add_option("--depth-out", a->depthOut, "Write view depth in metres")->type_name("FILE.exr");
  sub->add_option("--checkpoint", a->checkpoint,
                  "Of raytraced: keep what is done in this file, and go on from it when it is there")
      ->type_name("FILE");
  sub->add_option("-o,--output", a->output, "Picture to write: .exr, .png or .hdr")->type_name("OUT");
  return [a](const GlobalArguments& global) {
    requireOutput("render", a->output, a->inspection);
    return runRender(*a, global);
  };
}

Action addApply(CLI::App& app) {
  auto* sub = app.add_subcommand("apply", "Blur a picture by its depth with a technique that works on images");
  auto a = std::make_shared<ApplyArguments>();
  sub->add_option("--color", a->color, "Linear colour; alpha, premultiplied, is kept")->type_name("C.exr")->required();
  sub->add_option("--color-layer", a->colorLayer, "Layer of an EXR to take as colour (default: found by its name)")
      ->type_name("NAME");
  sub->add_option("--depth", a->depth, "Depth, in metres along the axis unless said otherwise; may be the same file")
      ->type_name("Z.exr|png")
      ->required();
  sub->add_option("--depth-channel", a->depthChannel, "Channel to take as depth (default: found by its name)")
      ->type_name("NAME");
  addDepthMeaning(*sub, a->depthMeaning);
  sub->add_option("--fovy", a->fovyDeg, "Vertical field of view")->type_name("DEG")->required();
  auto* radius = sub->add_option("--aperture-radius", a->apertureRadius, "Lens radius in metres")->type_name("M");
  auto* focal = sub->add_option("--focal-length-mm", a->focalLengthMm, "Focal length")->type_name("F");
  auto* fStop = sub->add_option("--fstop", a->fStop, "f-number; 0 turns depth of field off")->type_name("N");
  radius->excludes(focal)->excludes(fStop);
  focal->needs(fStop);
  fStop->needs(focal);
  sub->add_option("--focus", a->focusDistance, "Focus distance in metres, or infinity")->type_name("D")->required();
  addTechnique(*sub, a->technique, true);
  addExposure(*sub, a->exposureEv);
  addInspection(*sub, a->inspection);
  sub->add_option("-o,--output", a->output, "Picture to write: .exr, .png or .hdr")->type_name("OUT");
  return [a](const GlobalArguments& global) {
    requireOutput("apply", a->output, a->inspection);
    return runApply(*a, global);
  };
}

Action addGraph(CLI::App& app) {
  auto* sub = app.add_subcommand("graph", "Write the render graph of a shot and a technique, compiled");
  auto a = std::make_shared<GraphArguments>();
  sub->add_option("shot", a->shot, "Shot file")->type_name("SHOT.json")->required();
  addTechnique(*sub, a->technique, false);
  addSize(*sub, a->size);
  addFaces(*sub, a->faces);
  sub->add_option("--dot", a->dot, "Write it for Graphviz; - is standard output")->type_name("FILE");
  sub->add_option("--json", a->json, "Write it as JSON; - is standard output")->type_name("FILE");
  return [a](const GlobalArguments& global) {
    if (!a->dot && !a->json) failUsage("graph", "nothing to write", "give --dot FILE or --json FILE");
    return runGraph(*a, global);
  };
}

Action addDemo(CLI::App& app) {
  auto* sub = app.add_subcommand("demo", "Render the sample scenes with every technique and write a page of them");
  auto a = std::make_shared<DemoArguments>();
  sub->add_option("-o,--output", a->output, "Folder to write")->type_name("DIR")->capture_default_str();
  sub->add_option("--scenes", a->scenes, "Folder of shot files instead of the project's own")->type_name("DIR");
  sub->add_option("--width", a->width, "Picture width in pixels")
      ->type_name("PX")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  sub->add_option("--reference-samples", a->referenceSamples, "Lens samples of the reference")
      ->type_name("N")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  return [a](const GlobalArguments& global) { return runDemo(*a, global); };
}

}  // namespace lensgraph::cli
