// Time per pass of each step of a frame, through Google Benchmark.
#pragma once

#include <nlohmann/json.hpp>

namespace lensgraph::bench {

/// To be called before benchmark::RunSpecifiedBenchmarks(). Names are STEP/WORKLOAD/PASSES.
void registerSpeed();

/// Runs what --benchmark_filter names and prints it; one object per benchmark, with the least and the median of its
/// repetitions in CPU nanoseconds per pass, since other programs share the machine.
nlohmann::ordered_json runSpeed();

}  // namespace lensgraph::bench
