// The counters of a technique's shaders (shaders/shared/statistics.h).
#pragma once

#include <string>

#include "rendergraph/graph.h"

namespace lensgraph::passes {

/// A zeroed FrameStatistics buffer, by a fill pass named `prefix`.clear_statistics.
rendergraph::Buffer declareStatistics(rendergraph::Graph& graph, const std::string& prefix);

}  // namespace lensgraph::passes
