// The results of a benchmark as one document: bench.json, and the same as a table (bench.csv).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "samples/lensgraph/bench/journal.h"

namespace lensgraph::cli {

/// What such files say that they are, in their fields "format" and "formatVersion".
inline constexpr const char* kBenchFormat = "lensgraph bench";
inline constexpr int kBenchVersion = 1;

/// What holds for the whole benchmark: "name", "programs", "device", "host", "settings", "shard".
/// The document adds "date", and "shots": of each case its facts, units, accumulation's curve and results. Times are
/// medians with their spread over the rounds; ratios are the medians of the ratios within each round, of CPU time on CPU
/// devices and of device time on others. A variant without all its turns is left out.
nlohmann::ordered_json benchDocument(const nlohmann::ordered_json& facts, const Journal& journal);

/// One line for each result, with a heading.
std::string benchTable(const nlohmann::ordered_json& document);

}  // namespace lensgraph::cli
