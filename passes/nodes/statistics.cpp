// One transfer pass that fills the counters with zeros.
#include "passes/nodes/statistics.h"

#include "shaders/shared/statistics.h"

namespace lensgraph::passes {

rendergraph::Buffer declareStatistics(rendergraph::Graph& graph, const std::string& prefix) {
  auto statistics = graph.createBuffer(prefix + ".statistics", {.size = sizeof(shared::FrameStatistics)});
  auto clear = graph.addPass(prefix + ".clear_statistics", rendergraph::PassKind::transfer);
  statistics = clear.write(statistics, rendergraph::Usage::transferDestination);
  clear.record([statistics](rendergraph::PassContext& context) { context.fillBuffer(statistics, 0); });
  return statistics;
}

}  // namespace lensgraph::passes
