// Case after case: see bench_run.h.
#include "samples/lensgraph/bench/bench_run.h"

namespace lensgraph::cli {

void measureCases(engine::Device& device, const BenchConfig& config, const std::vector<BenchCase>& cases,
                  std::vector<OtherProgram>& programs, const BenchRunOptions& options, Journal& journal,
                  const BenchProgress& progress) {
  double all = 0.0;
  for (const auto& each : cases) all += CaseRun(device, config, each, programs, options, journal).remaining();
  double before = 0.0;
  for (const auto& each : cases) {
    CaseRun run(device, config, each, programs, options, journal);
    const double own = run.remaining();
    run.run([&](double done, const std::string& what) { progress((before + done) / all, what); });
    before += own;
  }
}

}  // namespace lensgraph::cli
