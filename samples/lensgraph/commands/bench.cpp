// lensgraph bench: techniques × parameters × shots × sizes, measured in turns, as JSON, a table and a page.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "engine/error.h"
#include "samples/host/measures/shot_files.h"
#include "samples/lensgraph/bench/bench_case.h"
#include "samples/lensgraph/bench/bench_config.h"
#include "samples/lensgraph/bench/bench_run.h"
#include "samples/lensgraph/bench/journal.h"
#include "samples/lensgraph/bench/names.h"
#include "samples/lensgraph/bench/results/bench_document.h"
#include "samples/lensgraph/bench/turns/other_program.h"
#include "samples/lensgraph/capture/capture_file.h"
#include "samples/lensgraph/commands/bench_output.h"
#include "samples/lensgraph/output.h"
#include "samples/lensgraph/progress.h"
#include "samples/lensgraph/session.h"
#include "samples/lensgraph/subcommands.h"
#include "samples/lensgraph/version.h"

namespace lensgraph::cli {
namespace {

using nlohmann::ordered_json;
using std::filesystem::path;

constexpr const char* kQuick = "quick";

BenchConfig configOf(const BenchArguments& arguments) {
  BenchConfig config;
  if (arguments.config == kQuick) {
    const std::vector<path> own = {LENSGRAPH_SAMPLE_SCENES};
    config = quickBench(findShots(arguments.shots.empty() ? own : arguments.shots));
  } else {
    config = readBenchConfig(arguments.config, findShots(arguments.shots));
  }
  if (arguments.repeats) config.repeats = *arguments.repeats;
  return config;
}

/// As the system names it; empty where it does not.
std::string processorName() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("model name")) return line.substr(std::min(line.find(": ") + 2, line.size()));
  }
  return {};
}

ordered_json programsJson(const std::vector<OtherProgram>& programs) {
  ordered_json all = {{{"name", "this"}, {"version", std::string("lensgraph ") + kVersion}, {"commit", kCommit}}};
  for (const auto& program : programs) {
    all.push_back({{"name", program.name()}, {"version", program.version()}, {"commit", program.commit()}});
  }
  return all;
}

/// What holds for the whole benchmark; see benchDocument().
ordered_json factsOf(const BenchConfig& config, const ordered_json& identity, const engine::DeviceDescription& device,
                     const Shard& shard, const std::vector<OtherProgram>& programs) {
  return {{"name", config.name},
          {"programs", programsJson(programs)},
          {"device", toJson(device)},
          {"host", {{"processor", processorName()}, {"cores", std::thread::hardware_concurrency()}}},
          {"settings",
           {{"repeats", config.repeats},
            {"exposureEv", config.exposureEv},
            {"referenceSamples", config.referenceSamples},
            {"config", host::hashOfText(identity.dump())}}},
          {"shard", nameOf(shard)}};
}

/// The first line of the folder's journal: what must not change between two runs into it.
ordered_json journalHead(const ordered_json& facts, const ordered_json& identity) {
  ordered_json programs = ordered_json::array();
  for (const auto& program : facts["programs"]) {
    programs.push_back(program["name"].get<std::string>() + " " + program["commit"].get<std::string>());
  }
  ordered_json head = {{"format", "lensgraph bench journal"},
                       {"commit", kCommit},
                       {"programs", programs.dump()},
                       {"device", facts["device"]["name"]},
                       {"driver", facts["device"]["driver"]},
                       {"processor", facts["host"]["processor"]},
                       {"shard", facts["shard"]}};
  head.update(identity);
  return head;
}

Shard shardOf(const std::string& text) {
  if (text.empty()) return {};
  if (const auto shard = shardFrom(text)) return *shard;
  throw engine::Error({.file = "command line",
                       .field = "--shard",
                       .reason = "\"" + text + "\" is no part of a whole",
                       .remedy = "write I/N with I from 1 to N, such as 3/8"});
}

void checkPrograms(const std::vector<OtherProgram>& programs) {
  for (std::size_t i = 0; i < programs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (fileNameOf(programs[i].name()) != fileNameOf(programs[j].name())) continue;  // They name pictures.
      throw engine::Error({.file = "command line",
                           .field = "--program " + programs[i].name(),
                           .reason = "is given twice",
                           .remedy = "give each program a name of its own"});
    }
  }
}

}  // namespace

int runBench(const BenchArguments& arguments, const GlobalArguments& global) {
  const Shard shard = shardOf(arguments.shard);
  const BenchConfig config = configOf(arguments);
  const auto cases = casesOf(config, shard);
  const ordered_json identity = identityOf(config);
  std::vector<OtherProgram> programs;
  for (const auto& text : arguments.programs) programs.emplace_back(text);
  checkPrograms(programs);
  const path folder = std::filesystem::absolute(arguments.output);
  makeOutputFolder(folder, "--output", "bench.json");
  const path references = std::filesystem::absolute(arguments.references.value_or(folder / "references"));
  makeOutputFolder(references, "--references", "reference");

  Session session(global);
  const auto facts = factsOf(config, identity, session.device().description(), shard, programs);
  Journal journal(folder, journalHead(facts, identity));
  const BenchRunOptions options{.folder = folder, .references = references, .device = global.device};
  {
    ProgressBar bar(config.name);
    constexpr double kSteps = 10'000.0;
    measureCases(session.device(), config, cases, programs, options, journal,
                 [&](double share, const std::string& what) {
                   bar.label(what);
                   bar.update(static_cast<uint32_t>(share * kSteps), static_cast<uint32_t>(kSteps));
                 });
  }
  writeBench(benchDocument(facts, journal), folder);
  return session.finish();
}

}  // namespace lensgraph::cli
