// When and where every living pass runs: the result of ordering, queue assignment and merging.
#pragma once

#include <cstdint>
#include <vector>

#include "rendergraph/compile/schedule/ordering.h"

namespace lensgraph::rendergraph {

struct Schedule {
  std::vector<uint32_t> order;  ///< Passes by step.
  std::vector<uint32_t> queue;  ///< By step: index among the device's queues.
  /// By step: first and last step of the rendering that it shares with its neighbours; the step itself alone.
  std::vector<uint32_t> unitFirst, unitLast;
  /// By step: memory changes hands between groups only; empty: between any two steps. Says nothing once the steps of
  /// several queues have been put together.
  std::vector<uint32_t> group;
  uint32_t queues = 1;         ///< Queues of the device that the plan may use.
  bool severalQueues = false;  ///< Whether some step is not on queue 0.

  uint32_t steps() const { return static_cast<uint32_t>(order.size()); }
  /// The time in which lifetimes are counted; one past the last step is a time of its own.
  uint32_t timeOf(uint32_t step) const { return severalQueues ? step : PassOrder::timeOf(step, group); }
};

}  // namespace lensgraph::rendergraph
