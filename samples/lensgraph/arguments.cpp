// The command line's words. The only user of CLI11: each function below describes one subcommand and binds it
// to its function in subcommands.h.
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "engine/error.h"
#include "passes/parameters.h"
#include "samples/host/shot.h"
#include "samples/lensgraph/subcommands.h"
#include "samples/lensgraph/version.h"

namespace lensgraph::cli {
namespace {

[[noreturn]] void failUsage(const std::string& field, const std::string& reason, const std::string& remedy) {
  throw engine::Error({.file = "command line", .field = field, .reason = reason, .remedy = remedy});
}

PictureSize parseSize(const std::string& text) {
  const char* end = text.data() + text.size();
  PictureSize size;
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool hasX = width.ec == std::errc{} && width.ptr != end && (*width.ptr == 'x' || *width.ptr == 'X');
  const auto height = hasX ? std::from_chars(width.ptr + 1, end, size.height) : width;
  if (!hasX || height.ec != std::errc{} || height.ptr != end) {
    failUsage("--size", "\"" + text + "\" is no size", "write WIDTHxHEIGHT, such as 640x360");
  }
  const auto fits = [](int pixels) { return pixels >= 1 && pixels <= host::kMaxResolution; };
  if (!fits(size.width) || !fits(size.height)) {
    failUsage("--size", "is " + text + ", each side must be from 1 to " + std::to_string(host::kMaxResolution) + " px",
              "");
  }
  return size;
}

void requireFinite(const std::string& field, double value) {
  if (!std::isfinite(value)) failUsage(field, "is not a finite number", "");
}

CLI::Option* addSize(CLI::App& app, std::optional<PictureSize>& size) {
  return app
      .add_option_function<std::string>(
          "--size", [&size](const std::string& text) { size = parseSize(text); },
          "Picture size in pixels instead of the shot's")
      ->type_name("WxH");
}

void addFaces(CLI::App& app, std::optional<engine::DrawnFaces>& faces) {
  app.add_option_function<std::string>(
         "--faces",
         [&faces](const std::string& text) {
           faces = host::drawnFacesFrom(text);
           if (!faces) failUsage("--faces", "\"" + text + "\" is neither material nor both", "");
         },
         "Faces to draw instead of the shot's choice: material leaves out the back faces of single-sided materials")
      ->type_name("material|both");
}

void addExposure(CLI::App& app, std::optional<double>& exposure) {
  app.add_option_function<double>(
         "--exposure",
         [&exposure](double value) {
           requireFinite("--exposure", value);
           exposure = value;
         },
         "Brighten PNG output by this many stops before it is clamped and sRGB-encoded")
      ->type_name("EV");
}

void addTechnique(CLI::App& app, TechniqueArguments& technique, bool required) {
  app.add_option("--technique", technique.technique, "Technique to use (see lensgraph techniques)")
      ->type_name("NAME")
      ->required(required);
  app.add_option("--set", technique.settings, "Set one parameter of the technique; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--config", technique.config, "File {\"technique\": {\"name\": …, parameters…}}")
      ->type_name("FILE.json");
}

void addInspection(CLI::App& app, InspectionArguments& inspection) {
  app.add_option("--capture", inspection.capture,
                 "Write times, memory, device, parameters (see capture-view, capture-diff)")
      ->type_name("FILE.json");
  app.add_option("--trace", inspection.trace, "Write a timeline that Perfetto opens")->type_name("FILE.json");
  app.add_option("--capture-frames", inspection.frames, "Frames to measure after a first one that is not (default 5)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  app.add_option("--timing", inspection.timing,
                 "inline: timestamps in the frame; isolated: each pass by itself, right on every device. Default: "
                 "isolated on CPU devices, inline on others")
      ->type_name("MODE")
      ->check(CLI::IsMember({"inline", "isolated"}));
  app.add_option("--frames-timed", inspection.framesTimed,
                 "Time this many more whole frames after the picture, when all is warm (default: 1 with --json)")
      ->type_name("N")
      ->check(CLI::Range(0, 100000));
  app.add_flag("--json", inspection.json, "Print the report as JSON");
  app.add_option("--dump-image", inspection.dumps,
                 "Write an image inside the graph, as it is after the pass; may be repeated. list: say which there are")
      ->type_name("PASS/RESOURCE[MIP,LAYER]=FILE.exr|png")
      ->allow_extra_args(false);
}

/// `output` may be left out only where nothing but a list is asked for.
void requireOutput(const std::string& subcommand, const std::filesystem::path& output,
                   const InspectionArguments& inspection) {
  if (output.empty() && inspection.dumps != std::vector<std::string>{"list"}) {
    failUsage(subcommand, "--output is required", "see lensgraph " + subcommand + " --help");
  }
}

using Action = std::function<int(const GlobalArguments&)>;

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

Action addTechniques(CLI::App& app) {
  auto* sub = app.add_subcommand("techniques", "List techniques and their parameters");
  auto json = std::make_shared<bool>(false);
  sub->add_flag("--json", *json, "As JSON");
  return [json](const GlobalArguments&) { return runTechniques(*json); };
}

Action addCompare(CLI::App& app) {
  auto* sub = app.add_subcommand("compare", "Measure how far pictures are from their reference");
  auto a = std::make_shared<CompareArguments>();
  sub->add_option("pictures", a->pictures, "Pictures, and last the reference")
      ->type_name("PICTURE… REFERENCE")
      ->required()
      ->expected(2, CLI::detail::expected_max_vector_size);
  sub->add_option("--exposure", a->exposureEv, "Stops by which both are brightened before they are compared")
      ->type_name("EV");
  sub->add_option("--shot", a->shot,
                  "Shot whose lens and camera tell where depth of field fails: figures there as well")
      ->type_name("SHOT.json");
  sub->add_option("--depth", a->depth, "Depth of the shot through a pinhole, in metres (default: it is rendered)")
      ->type_name("DEPTH.exr")
      ->needs("--shot");
  sub->add_option("--maps", a->maps, "Folder for pictures of FLIP, of the difference and of the masks")
      ->type_name("DIR");
  sub->add_option("--page", a->page, "Write a page that shows pictures, FLIP, differences and masks")
      ->type_name("FILE.html");
  sub->add_flag("--json", a->json, "As JSON");
  return [a](const GlobalArguments& global) {
    requireFinite("--exposure", a->exposureEv);
    a->reference = a->pictures.back();
    a->pictures.pop_back();
    return runCompare(*a, global);
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

Action addCaptureView(CLI::App& app) {
  auto* sub = app.add_subcommand("capture-view", "Write a capture as a page: graph, times, lifetimes, memory");
  auto a = std::make_shared<CaptureViewArguments>();
  sub->add_option("capture", a->capture, "Capture (render --capture)")->type_name("FILE.json")->required();
  sub->add_option("-o,--output", a->output, "Page to write; - is standard output")->type_name("FILE.html")->required();
  return [a](const GlobalArguments&) { return runCaptureView(*a); };
}

Action addCaptureDiff(CLI::App& app) {
  auto* sub = app.add_subcommand("capture-diff", "Tell what changed from one capture to another");
  auto a = std::make_shared<CaptureDiffArguments>();
  sub->add_option("before", a->before, "Capture")->type_name("A.json")->required();
  sub->add_option("after", a->after, "Capture")->type_name("B.json")->required();
  sub->add_flag("--json", a->json, "As JSON");
  return [a](const GlobalArguments&) { return runCaptureDiff(*a); };
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

Action addBench(CLI::App& app) {
  auto* sub = app.add_subcommand(
      "bench", "Measure techniques, parameters, shots and sizes in turns; goes on from where it was interrupted");
  auto a = std::make_shared<BenchArguments>();
  sub->add_option("config", a->config, "Configuration file, or quick: every technique with its defaults")
      ->type_name("CONFIG.json|quick")
      ->required();
  sub->add_option("-o,--output", a->output, "Folder to write")->type_name("DIR")->required();
  sub->add_option("--shots", a->shots, "Shot file or folder of shots instead of the configuration's; may be repeated")
      ->type_name("PATH")
      ->allow_extra_args(false);
  sub->add_option("--program", a->programs, "Another build of lensgraph that takes turns; may be repeated")
      ->type_name("NAME=PATH")
      ->allow_extra_args(false);
  sub->add_option("--references", a->references,
                  "Folder in which rendered references are kept (default DIR/references)")
      ->type_name("DIR");
  sub->add_option("--repeats", a->repeats, "Turns of each variant instead of the configuration's")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  sub->add_option("--shard", a->shard, "Measure only this part of N, from 1 (see bench-merge)")->type_name("I/N");
  return [a](const GlobalArguments& global) { return runBench(*a, global); };
}

Action addBenchMerge(CLI::App& app) {
  auto* sub = app.add_subcommand("bench-merge", "Join the parts of a benchmark that were measured with --shard");
  auto a = std::make_shared<BenchMergeArguments>();
  sub->add_option("folders", a->folders, "Folders of all parts")->type_name("DIR")->required();
  sub->add_option("-o,--output", a->output, "Folder to write")->type_name("DIR")->required();
  return [a](const GlobalArguments&) { return runBenchMerge(*a); };
}

Action addCompareBench(CLI::App& app) {
  auto* sub = app.add_subcommand("compare-bench", "Hold two benchmarks together; exit code 1 on a regression");
  auto a = std::make_shared<CompareBenchArguments>();
  sub->add_option("before", a->before, "Folder of a benchmark, or its bench.json")->type_name("A")->required();
  sub->add_option("after", a->after, "Another one")->type_name("B")->required();
  sub->add_option("--unit", a->unit, "Compare times as multiples of this unit's, for benchmarks of two machines")
      ->type_name("UNIT")
      ->check(CLI::IsMember({"none", "pinhole", "copy", "accumulationView"}))
      ->capture_default_str();
  sub->add_option("--time-tolerance", a->timeTolerance, "Ratio of times beyond which B is slower")
      ->type_name("RATIO")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  sub->add_option("--psnr-tolerance", a->psnrTolerance, "Fall of PSNR beyond which B is worse")
      ->type_name("DB")
      ->check(CLI::Range(0.0, 1e3))
      ->capture_default_str();
  sub->add_option("--ssim-tolerance", a->ssimTolerance, "Fall of SSIM beyond which B is worse")
      ->type_name("D")
      ->check(CLI::Range(0.0, 2.0))
      ->capture_default_str();
  sub->add_flag("--json", a->json, "As JSON");
  return [a](const GlobalArguments&) { return runCompareBench(*a); };
}

Action addDevices(CLI::App& app) {
  auto* sub = app.add_subcommand("devices", "List the Vulkan devices of this machine");
  auto json = std::make_shared<bool>(false);
  sub->add_flag("--json", *json, "As JSON");
  return [json](const GlobalArguments&) { return runDevices(*json); };
}

/// The subcommand on the command line; null when there is none.
const CLI::App* chosenSubcommand(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? nullptr : chosen.front();
}

/// What a user may have meant by a word that is no subcommand, or no option of the chosen one.
std::string suggestion(const CLI::App& app, const std::string& word) {
  const auto* sub = chosenSubcommand(app);
  std::vector<std::string> names;
  if (word.starts_with("-")) {
    for (const auto* level : {&app, sub}) {
      if (level == nullptr) continue;
      for (const auto* option : level->get_options()) {
        for (const auto& name : option->get_lnames()) names.push_back("--" + name);
      }
    }
  } else if (sub == nullptr) {
    for (const auto* each : app.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(each->get_name());
  }
  const std::vector<std::string_view> views(names.begin(), names.end());
  const auto nearest = passes::nearestName(word, views);
  if (!nearest.empty()) return "did you mean " + std::string(nearest) + "?";
  return "see lensgraph " + (sub == nullptr ? "" : sub->get_name() + " ") + "--help";
}

[[noreturn]] void failParse(const CLI::App& app, const CLI::ParseError& error) {
  const auto* sub = chosenSubcommand(app);
  const auto unknown = app.remaining(true);
  if (!unknown.empty()) {
    const bool option = unknown.front().starts_with("-");
    const std::string kind = option ? "is no option" : sub == nullptr ? "is no subcommand" : "was not expected";
    failUsage(unknown.front(), kind, suggestion(app, unknown.front()));
  }
  failUsage(sub == nullptr ? "" : sub->get_name(), error.what(), suggestion(app, ""));
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app("Depth of field through a Vulkan render graph.", "lensgraph");
  app.set_version_flag("--version", [] { return programName(); });
  app.footer("Exit codes: 0 done, 1 failed at run time, 2 bad input or usage.");
  app.fallthrough();  // global options may stand after the subcommand
  GlobalArguments global;
  app.add_option("--device", global.device, "Vulkan device: index or part of its name (see lensgraph devices)")
      ->type_name("INDEX|NAME");
  app.add_flag("--validate", global.validation, "Turn on validation and synchronization validation");
  app.add_flag("-v,--verbose", global.verbose, "Say more on stderr");

  std::vector<std::pair<std::string, Action>> actions = {{"render", addRender(app)},
                                                         {"apply", addApply(app)},
                                                         {"techniques", addTechniques(app)},
                                                         {"compare", addCompare(app)},
                                                         {"graph", addGraph(app)},
                                                         {"demo", addDemo(app)},
                                                         {"bench", addBench(app)},
                                                         {"bench-merge", addBenchMerge(app)},
                                                         {"compare-bench", addCompareBench(app)},
                                                         {"capture-view", addCaptureView(app)},
                                                         {"capture-diff", addCaptureDiff(app)},
                                                         {"devices", addDevices(app)}};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    failParse(app, error);
  }
  const auto* sub = chosenSubcommand(app);
  if (sub == nullptr) failUsage("", "no subcommand given", "see lensgraph --help");
  if (global.verbose) spdlog::set_level(spdlog::level::debug);
  for (const auto& [name, action] : actions) {
    if (sub->get_name() == name) return action(global);
  }
  return 1;  // unreachable: every subcommand stands in the list
}

}  // namespace lensgraph::cli
