// What can only be wrong about a declaration as a whole, or about a device. Pure.
#pragma once

#include <vector>

#include "rendergraph/device_facts.h"
#include "rendergraph/error.h"

namespace lensgraph::rendergraph {

struct Declaration;
class Cells;

/// The problems noted by the declaration calls, followed by those found here, in order of declaration.
std::vector<GraphError::Problem> findProblems(const Declaration& declaration, const Cells& cells,
                                              const DeviceFacts& device);

}  // namespace lensgraph::rendergraph
