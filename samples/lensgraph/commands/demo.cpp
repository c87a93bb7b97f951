// lensgraph demo: the sample scenes with every technique, measured against accumulation, as files and a page.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>

#include "engine/error.h"
#include "engine/image/image_io.h"
#include "engine/metrics/metrics.h"
#include "samples/lensgraph/error_map.h"
#include "samples/lensgraph/output.h"
#include "samples/lensgraph/pages/demo_page.h"
#include "samples/lensgraph/progress.h"
#include "samples/lensgraph/session.h"
#include "samples/lensgraph/subcommands.h"
#include "samples/lensgraph/version.h"

namespace lensgraph::cli {
namespace {

using std::filesystem::path;

/// Runs of one technique on one scene, of which the median counts, unless one alone takes longer than
/// kLongRunMs.
constexpr int kRuns = 3;
constexpr double kLongRunMs = 500.0;

/// Lens samples of the accumulation that is measured like any other technique: few, for the reference has the
/// many.
constexpr int64_t kQuickSamples = 32;

std::vector<path> shotsIn(const path& folder) {
  std::error_code code;
  if (!std::filesystem::is_directory(folder, code)) {
    throw engine::Error(
        {.file = folder.string(), .field = "--scenes", .reason = "no such folder", .remedy = "check the path"});
  }
  std::vector<path> shots;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") shots.push_back(entry.path());
  }
  if (shots.empty()) {
    throw engine::Error(
        {.file = folder.string(), .field = "--scenes", .reason = "holds no shot files (*.json)", .remedy = {}});
  }
  std::sort(shots.begin(), shots.end());
  return shots;
}

/// Same shape, other width.
void scaleTo(host::Shot& shot, int width) {
  const double scale = static_cast<double>(width) / shot.width;
  shot.height = std::clamp(static_cast<int>(shot.height * scale + 0.5), 1, host::kMaxResolution);
  shot.width = width;
}

host::Rendering renderOnce(host::Renderer& renderer, const host::Shot& shot, const std::string& technique,
                           const passes::ParameterSet& parameters) {
  host::RenderOptions options{
      .technique = technique, .parameters = parameters, .execute = {}, .wantDepth = false, .progress = {}};
  options.execute.timing = rendergraph::Timing::inlineTimestamps;
  return renderer.render(shot, options);
}

/// The run of median wall time.
host::Rendering measure(host::Renderer& renderer, const host::Shot& shot, const std::string& technique,
                        const passes::ParameterSet& parameters) {
  std::vector<host::Rendering> runs;
  do {
    runs.push_back(renderOnce(renderer, shot, technique, parameters));
  } while (runs.size() < kRuns && runs.front().wallMs < kLongRunMs);
  std::sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.wallMs < b.wallMs; });
  return std::move(runs[(runs.size() - 1) / 2]);
}

/// Parameters of a technique in the demo: the shot's where it has some for it, defaults otherwise.
passes::ParameterSet parametersOf(const std::string& technique, const host::Shot& shot) {
  if (technique == "accumulation") return {{"lensSamples", kQuickSamples}};
  return technique == shot.technique ? shot.parameters : passes::ParameterSet{};
}

/// Counts the demo's steps on the progress bar: one per picture.
class Steps {
 public:
  explicit Steps(std::size_t total) : total_(static_cast<uint32_t>(total)) {}
  void begin(const std::string& what) {
    bar_.label(what);
    bar_.update(done_, total_);
  }
  void end() { bar_.update(++done_, total_); }

 private:
  ProgressBar bar_{"demo"};
  uint32_t done_ = 0, total_;
};

DemoScene renderScene(Session& session, const path& file, const DemoArguments& arguments, Steps& steps) {
  host::Shot shot = host::readShot(file);
  scaleTo(shot, arguments.width);
  std::vector<std::string> warnings;
  host::Renderer renderer(session.device(), shot, warnings);
  Session::report(warnings);

  const std::string id = file.stem().string();
  DemoScene scene{.id = id, .name = shot.name, .reference = id + "/reference.png", .results = {}};
  scene.width = shot.width;
  scene.height = shot.height;
  makeOutputFolder(arguments.output / id, "--output", "index.html");

  steps.begin(id + " reference");
  const passes::ParameterSet referenceParameters = {{"lensSamples", int64_t{arguments.referenceSamples}},
                                                    {"pixelJitter", true}};
  const auto reference = renderOnce(renderer, shot, "accumulation", referenceParameters);
  scene.referenceWallMs = reference.wallMs;
  engine::writeImage(arguments.output / scene.reference, reference.color);
  steps.end();

  for (const auto& technique : passes::techniques()) {
    const std::string name(technique.name);
    steps.begin(id + " " + name);
    const auto rendering = measure(renderer, shot, name, parametersOf(name, shot));
    const auto metrics = engine::compareImages(rendering.color, reference.color);
    const bool quick = name == "accumulation";
    DemoResult result{.technique = quick ? name + ", " + std::to_string(kQuickSamples) + " samples" : name,
                      .title = std::string(technique.title),
                      .picture = id + "/" + name + ".png",
                      .errorPicture = id + "/" + name + "_error.png",
                      .gpuMs = rendering.gpuMs,
                      .wallMs = rendering.wallMs,
                      .psnr = metrics.psnr,
                      .ssim = metrics.ssim};
    engine::writeImage(arguments.output / result.picture, rendering.color);
    engine::writeImage(arguments.output / result.errorPicture, errorMap(rendering.color, reference.color));
    scene.results.push_back(std::move(result));
    steps.end();
  }
  return scene;
}

}  // namespace

int runDemo(const DemoArguments& arguments, const GlobalArguments& global) {
  const auto start = std::chrono::steady_clock::now();
  const auto shots = shotsIn(arguments.scenes.value_or(LENSGRAPH_SAMPLE_SCENES));
  makeOutputFolder(arguments.output, "--output", "index.html");
  Session session(global);
  const std::string device = describe(session.device().description());
  std::cout << "device  " << device << "\n" << std::flush;

  DemoReport report{
      .device = device, .version = programName(), .referenceSamples = arguments.referenceSamples, .scenes = {}};
  {
    Steps steps(shots.size() * (1 + passes::techniques().size()));
    for (const auto& shot : shots) report.scenes.push_back(renderScene(session, shot, arguments, steps));
  }
  const path page = arguments.output / "index.html";
  writeTextFile(page, demoPage(report));

  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::cout << "\n" << demoTable(report) << "\npage    " << page.string() << "\n";
  std::printf("took    %.0f s; reference: accumulation, %d lens samples\n", seconds, arguments.referenceSamples);
  return session.finish();
}

}  // namespace lensgraph::cli
