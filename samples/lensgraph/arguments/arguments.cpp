// The command line: its subcommands, global options, and what is said of words that are none.
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <vector>

#include "engine/error.h"
#include "passes/parameters.h"
#include "samples/lensgraph/arguments/options.h"
#include "samples/lensgraph/subcommands.h"
#include "samples/lensgraph/version.h"

namespace lensgraph::cli {
namespace {

Action addTechniques(CLI::App& app) {
  auto* sub = app.add_subcommand("techniques", "List techniques and their parameters");
  auto json = std::make_shared<bool>(false);
  sub->add_flag("--json", *json, "As JSON");
  return [json](const GlobalArguments&) { return runTechniques(*json); };
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
