// lensgraph compare-bench: what became faster, slower, better or worse from one benchmark to another.
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "samples/lensgraph/bench/results/bench_comparison.h"
#include "samples/lensgraph/bench/results/bench_file.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {
namespace {

using nlohmann::ordered_json;

const char* verdict(const ComparedResult& result) {
  if (result.isSlower && result.isWorse) return "slower and worse";
  return result.isSlower ? "slower" : result.isWorse ? "worse" : "";
}

template <class Value>
ordered_json orNull(const std::optional<Value>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

void printJson(const BenchComparison& comparison) {
  ordered_json results = ordered_json::array();
  for (const auto& result : comparison.results) {
    ordered_json time;
    if (result.time) {
      time = {{"median", result.time->median}, {"lowest", result.time->lowest}, {"highest", result.time->highest}};
    }
    results.push_back({{"shot", result.shot},
                       {"variant", result.variant},
                       {"timeRatio", std::move(time)},
                       {"psnrChange", orNull(result.psnrChange)},
                       {"ssimChange", orNull(result.ssimChange)},
                       {"slower", result.isSlower},
                       {"worse", result.isWorse}});
  }
  const ordered_json document = {{"regression", comparison.hasRegression()},
                                 {"results", std::move(results)},
                                 {"onlyBefore", comparison.onlyBefore},
                                 {"onlyAfter", comparison.onlyAfter}};
  std::cout << document.dump(2) << "\n";
}

void printWords(const BenchComparison& comparison) {
  std::printf("%-24s %-44s %20s %9s %9s\n", "shot", "variant", "time after/before", "PSNR dB", "SSIM");
  for (const auto& result : comparison.results) {
    std::printf("%-24s %-44s", result.shot.c_str(), result.variant.c_str());
    if (result.time) {
      std::printf(" %6.3f (%.3f…%.3f)", result.time->median, result.time->lowest, result.time->highest);
    } else {
      std::printf(" %20s", "-");
    }
    const auto print = [](const std::optional<double>& change, int digits) {
      if (change) {
        std::printf(" %+9.*f", digits, *change);
      } else {
        std::printf(" %9s", "-");
      }
    };
    print(result.psnrChange, 3);
    print(result.ssimChange, 5);
    std::printf("  %s\n", verdict(result));
  }
  for (const auto& name : comparison.onlyBefore) std::printf("only before: %s\n", name.c_str());
  for (const auto& name : comparison.onlyAfter) std::printf("only after: %s\n", name.c_str());
}

}  // namespace

int runCompareBench(const CompareBenchArguments& arguments) {
  const auto before = readBenchFile(arguments.before), after = readBenchFile(arguments.after);
  const auto comparison = compareBenches(before, after,
                                         {.unit = arguments.unit,
                                          .timeRatio = arguments.timeTolerance,
                                          .psnr = arguments.psnrTolerance,
                                          .ssim = arguments.ssimTolerance,
                                          .mustBeComplete = arguments.mustBeComplete},
                                         arguments.before.string(), arguments.after.string());
  if (arguments.json) {
    printJson(comparison);
  } else {
    printWords(comparison);
  }
  return comparison.hasRegression() ? 1 : 0;
}

}  // namespace lensgraph::cli
