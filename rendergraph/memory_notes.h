// For people: with whom each resource shares memory, or why it does not. Pure.
#pragma once

#include <string>
#include <vector>

#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

struct Declaration;

/// One sentence for each resource of the declaration that the plan belongs to.
std::vector<std::string> memoryNotes(const Declaration& declaration, const Plan& plan);

}  // namespace lensgraph::rendergraph
