// Two benchmarks held together, variant by variant: how times and quality changed from one to the other.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace lensgraph::cli {

/// Ratio of times, the later benchmark's over the earlier one's.
struct TimeRatio {
  double median = 0.0;                 ///< Of the medians.
  double lowest = 0.0, highest = 0.0;  ///< Of the fastest turn over the slowest, and the other way round.
};

struct ComparedResult {
  std::string shot;                  ///< "railings_640x360"
  std::string variant;               ///< "multiview_synthesis lensSamples=8"
  std::optional<TimeRatio> time;     ///< None where one of the benchmarks has no time.
  std::optional<double> psnrChange;  ///< dB, later less earlier; none unless both are finite numbers.
  std::optional<double> ssimChange;
  bool isSlower = false, isWorse = false;  ///< Beyond the tolerances.
};

struct BenchComparison {
  std::vector<ComparedResult> results;             ///< Of variants that both have, of the programs that wrote them.
  std::vector<std::string> onlyBefore, onlyAfter;  ///< "SHOT VARIANT" that the other has not.
  bool mustBeComplete = false;                     ///< As BenchTolerances say.
  bool hasRegression() const;
};

/// See CompareBenchArguments.
struct BenchTolerances {
  std::string unit = "none";
  double timeRatio = 1.1, psnr = 0.0, ssim = 0.0;
  bool mustBeComplete = false;  ///< Whether a variant that only the earlier benchmark has is a regression.
};

/// Times are processor time on CPU devices and device time on others, or multiples of the unit's. Throws engine::Error
/// that names the first field in which the benchmarks cannot be compared: the device, the settings of quality, a shot's
/// size, scene or reference; with unit "none" also the processors; or that they
/// have no result in common. `beforeName` and `afterName` are for messages.
BenchComparison compareBenches(const nlohmann::ordered_json& before, const nlohmann::ordered_json& after,
                               const BenchTolerances& tolerances, const std::string& beforeName,
                               const std::string& afterName);

}  // namespace lensgraph::cli
