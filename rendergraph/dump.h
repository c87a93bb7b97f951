// A declaration and its plan in words: DOT for pictures, JSON for programs, text for tests' snapshots.
#pragma once

#include <iosfwd>

#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

class Graph;

void writeDot(std::ostream& out, const Graph& graph, const Plan& plan);
void writeJson(std::ostream& out, const Graph& graph, const Plan& plan);
/// One line a pass with reads, writes and barriers; deterministic, for snapshots.
void writeText(std::ostream& out, const Graph& graph, const Plan& plan);

}  // namespace lensgraph::rendergraph
