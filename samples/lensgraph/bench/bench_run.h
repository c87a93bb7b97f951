// Measures what a benchmark asks for and writes it into its journal; what the journal already holds is not repeated.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/vulkan/device.h"
#include "samples/lensgraph/bench/bench_case.h"
#include "samples/lensgraph/bench/bench_config.h"
#include "samples/lensgraph/bench/case_run.h"
#include "samples/lensgraph/bench/journal.h"
#include "samples/lensgraph/bench/turns/other_program.h"

namespace lensgraph::cli {

/// Share of the work that is done, 0…1 from where this run began, and what is being done.
using BenchProgress = std::function<void(double share, const std::string& what)>;

/// Measures the cases one after another. In each: references and masks; then a picture of every variant with its quality,
/// memory and times by pass; then the turns, units and variants and programs taking one each before the next round.
/// Throws what rendering throws; the journal then holds what was measured before.
void measureCases(engine::Device& device, const BenchConfig& config, const std::vector<BenchCase>& cases,
                  std::vector<OtherProgram>& programs, const BenchRunOptions& options, Journal& journal,
                  const BenchProgress& progress);

}  // namespace lensgraph::cli
