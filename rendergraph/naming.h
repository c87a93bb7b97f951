// Puts the name of a resource on the errors of a backend, which knows none.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "rendergraph/error.h"

namespace rendergraph {

/// Runs make(); a GraphError out of it that names no resource is given this name.
template <class Make>
auto namingResource(std::string_view name, Make&& make) {
  try {
    return make();
  } catch (const GraphError& error) {
    std::vector<GraphError::Problem> problems = error.problems();
    for (GraphError::Problem& problem : problems) {
      if (problem.resource.empty()) problem.resource = std::string(name);
    }
    throw GraphError(std::move(problems));
  }
}

}  // namespace rendergraph
