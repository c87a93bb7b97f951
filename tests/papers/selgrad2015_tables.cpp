// Tables 1 to 3 of Selgrad, Reintges, Penk, Wagner, Stamminger 2015: time of collecting, filtering and accumulating, by filter
// configuration a/b, and by truncation and length of lists.
//
//   selgrad2015_tables -o docs/results/selgrad2015_tables_llvmpipe.json SHOT.json…
//
// Pictures of 1280×720 and square blurs as in the paper, and the defaults beside them. Each pass is timed by itself; a row is the median of kRuns frames after a first.
#include <algorithm>
#include <cstdio>
#include <map>
#include <string_view>

#include "measure.h"

using namespace lensgraph;

namespace {

using nlohmann::ordered_json;
using passes::ParameterSet;

constexpr int kRuns = 5;

/// Which of the paper's three parts a pass belongs to; empty: none.
std::string_view partOf(std::string_view pass) {
  constexpr std::string_view kPrefix = "multilayer_filtering.";
  if (!pass.starts_with(kPrefix)) return "";
  pass.remove_prefix(kPrefix.size());
  for (const std::string_view name : {"clear_lists", "collect", "upload", "sort", "scan0", "compact"}) {
    if (pass.starts_with(name)) return "collect";
  }
  for (const std::string_view name : {"count", "scan", "mip", "stack"}) {
    if (pass.starts_with(name)) return "filter";
  }
  return pass.starts_with("shown") || pass.starts_with("accumulate") ? "accumulate" : "";
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

ordered_json rowOf(host::Renderer& renderer, const host::Shot& shot, const std::string& name, const ParameterSet& set) {
  std::map<std::string, std::vector<double>> parts;
  shared::FrameStatistics statistics{};
  for (int run = 0; run <= kRuns; ++run) {
    host::RenderOptions options;
    options.technique = "multilayer_filtering";
    options.parameters = set;
    options.execute.timing = rendergraph::Timing::isolated;
    const auto rendering = renderer.render(shot, options);
    if (run == 0) continue;  // Shaders are compiled in the first.
    statistics = rendering.statistics;
    std::map<std::string, double> frame;
    for (const auto& pass : rendering.capture.passes) {
      if (const auto part = partOf(pass.name); !part.empty()) frame[std::string(part)] += pass.gpuMs;
    }
    frame["sum"] = frame["collect"] + frame["filter"] + frame["accumulate"];
    for (const auto& [part, ms] : frame) parts[part].push_back(ms);
  }
  ordered_json row = {{"row", name}, {"width", shot.width}, {"height", shot.height}};
  for (const char* part : {"collect", "filter", "accumulate", "sum"}) row[part] = median(parts[part]);
  row["fragments"] = statistics.listFragments;
  std::printf("  %-28s collect %6.1f  filter %6.1f  accumulate %6.1f  sum %6.1f ms  %u fragments\n", name.c_str(),
              median(parts["collect"]), median(parts["filter"]), median(parts["accumulate"]), median(parts["sum"]),
              statistics.listFragments);
  std::fflush(stdout);
  return row;
}

ordered_json rowsOf(host::Renderer& renderer, const host::Shot& given, const std::string&) {
  host::Shot shot = given;
  shot.width = 1280, shot.height = 720;
  const auto steps = [](int64_t mip, int64_t stack) -> ParameterSet {
    return {{"mipSteps", mip}, {"stackSteps", stack}, {"kernel", std::string("box")}};
  };
  const auto lists = [&](bool truncated, int64_t length) {
    auto set = steps(1, 3);
    set["truncation"] = truncated;
    set["listLength"] = length;
    return set;
  };
  ordered_json rows = ordered_json::array();
  rows.push_back(rowOf(renderer, shot, "1/3", steps(1, 3)));
  rows.push_back(rowOf(renderer, shot, "2/2", steps(2, 2)));
  rows.push_back(rowOf(renderer, shot, "4/0", steps(4, 0)));
  rows.push_back(rowOf(renderer, shot, "full lists, n = 16", lists(false, 16)));
  rows.push_back(rowOf(renderer, shot, "full lists, n = 4", lists(false, 4)));
  rows.push_back(rowOf(renderer, shot, "truncated lists, n = 16", lists(true, 16)));
  rows.push_back(rowOf(renderer, shot, "truncated lists, n = 4", lists(true, 4)));
  rows.push_back(rowOf(renderer, shot, "defaults", {}));
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  return papers::run(argc, argv, rowsOf);
}
