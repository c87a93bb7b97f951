// Made-up results of a benchmark, for tests of what is computed from them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "samples/lensgraph/bench/journal.h"
#include "samples/lensgraph/bench/results/bench_document.h"
#include "samples/lensgraph/bench/units.h"

namespace lensgraph::cli_test {

using nlohmann::ordered_json;

inline ordered_json benchFacts(const std::string& deviceType = "cpu") {
  return {{"name", "made up"},
          {"programs", {{{"name", "this"}, {"version", "lensgraph 1"}, {"commit", "abc"}}}},
          {"device", {{"name", "a device"}, {"type", deviceType}, {"driver", "a driver"}}},
          {"host", {{"processor", "a processor"}, {"cores", 2}}},
          {"settings", {{"repeats", 3}, {"exposureEv", 0.0}, {"referenceSamples", 1024}, {"config", "abc"}}},
          {"shard", "1/1"}};
}

/// A case "quad_64x36" whose accumulation reaches 20, 30 and 40 dB with 4, 8 and 16 views.
inline void addCase(cli::Journal& journal) {
  ordered_json curve;
  for (const auto& [samples, psnr] : {std::pair{4, 20.0}, {8, 30.0}, {16, 40.0}}) {
    curve.push_back({{"samples", samples}, {"psnr", psnr}, {"ssim", 1.0 - 0.4 / samples}, {"flip", 0.1}});
  }
  journal.add("case|quad_64x36",
              {{"id", "quad_64x36"},
               {"shot", "quad"},
               {"name", "A quad"},
               {"file", "quad.json"},
               {"sceneHash", "0123"},
               {"triangles", 2u},
               {"width", 64u},
               {"height", 36u},
               {"reference", {{"kind", "accumulation"}, {"samples", 1024}, {"picture", "reference.exr"}}},
               {"masks", {{"nearEdge", 0.1}}},
               {"accumulation", curve}});
}

/// Turns of these times; the device's are a tenth of the processor's, in reverse order.
inline void addTurns(cli::Journal& journal, const std::string& program, const std::string& name,
                     const std::vector<double>& cpuMs) {
  for (std::size_t round = 0; round < cpuMs.size(); ++round) {
    journal.add("turn|" + program + "|" + name + "|" + std::to_string(round),
                {{"case", "quad_64x36"},
                 {"id", name},
                 {"program", program},
                 {"round", round},
                 {"cpuMs", cpuMs[round]},
                 {"wallMs", cpuMs[round]},
                 {"gpuMs", cpuMs[cpuMs.size() - 1 - round] / 10.0}});
  }
}

inline void addVariant(cli::Journal& journal, const std::string& program, const std::string& name,
                       const ordered_json& psnr, const ordered_json& ssim) {
  journal.add("variant|" + program + "|" + name,
              {{"case", "quad_64x36"},
               {"id", name},
               {"program", program},
               {"technique", "two_pass_filter"},
               {"parameters", {{"leakage", 0.25}}},
               {"quality", {{"psnr", psnr}, {"ssim", ssim}, {"flip", 0.1}, {"relativeRmse", 0.2}, {"maxError", 0.3}}},
               {"memory", {{"graphBytes", 1000}}},
               {"picture", nullptr},
               {"passes", ordered_json::array()}});
}

/// Units of 10 ms (pinhole), 1 ms (copy) and 5 ms (a view), and one variant "two_pass_filter".
inline ordered_json benchResults(const std::filesystem::path& folder, const ordered_json& facts,
                                 const std::vector<double>& cpuMs, const ordered_json& psnr, const ordered_json& ssim) {
  cli::Journal journal(folder, {{"test", "a test"}});
  addCase(journal);
  addTurns(journal, "this", cli::kPinholeUnit, {10.0, 10.0, 20.0});
  addTurns(journal, "this", cli::kCopyUnit, {1.0, 1.0, 1.0});
  addTurns(journal, "this", cli::kViewUnit, {5.0, 5.0, 5.0});
  addVariant(journal, "this", "two_pass_filter", psnr, ssim);
  addTurns(journal, "this", "two_pass_filter", cpuMs);
  addVariant(journal, "old", "two_pass_filter", psnr, ssim);
  addTurns(journal, "old", "two_pass_filter", {60.0, 40.0, 40.0});
  addVariant(journal, "this", "unfinished", psnr, ssim);
  addTurns(journal, "this", "unfinished", {1.0});
  return cli::benchDocument(facts, journal);
}

}  // namespace lensgraph::cli_test
