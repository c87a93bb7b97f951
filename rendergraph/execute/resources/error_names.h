// Puts the names of resource and pass on the errors of a backend, which knows none.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "rendergraph/error.h"

namespace lensgraph::rendergraph {

/// Runs work(); a GraphError out of it whose `part` is empty is given this name.
template <class Work>
decltype(auto) naming(std::string GraphError::Problem::*part, std::string_view name, Work&& work) {
  try {
    return work();
  } catch (const GraphError& error) {
    std::vector<GraphError::Problem> problems = error.problems();
    for (GraphError::Problem& problem : problems) {
      if ((problem.*part).empty()) problem.*part = std::string(name);
    }
    throw GraphError(std::move(problems));
  }
}

template <class Work>
decltype(auto) namingResource(std::string_view name, Work&& work) {
  return naming(&GraphError::Problem::resource, name, work);
}

template <class Work>
decltype(auto) namingPass(std::string_view name, Work&& work) {
  return naming(&GraphError::Problem::pass, name, work);
}

}  // namespace lensgraph::rendergraph
