// The words of the subcommands that measure and compare.
#include <memory>

#include "samples/lensgraph/arguments/options.h"

namespace lensgraph::cli {

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
  sub->add_flag("--complete", a->mustBeComplete, "A result that B lacks is a regression too");
  sub->add_flag("--json", a->json, "As JSON");
  return [a](const GlobalArguments&) { return runCompareBench(*a); };
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

}  // namespace lensgraph::cli
