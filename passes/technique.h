// A registry entry from a technique's own typed functions.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "passes/registry/registry.h"

namespace lensgraph::passes {

namespace detail {
template <class Parameters>
Parameters parametersOf(std::span<const Field<Parameters>>);
}  // namespace detail

/// What a user is told of a technique.
struct TechniqueTitle {
  std::string_view name, title, source;
};

/// `fields`: () → span<const Field<Parameters>>; `validate`: (Parameters, DofInputs) → problems;
/// `declare`: (Graph, DofInputs, Parameters) → DofOutputs; `frameCount`: (Parameters, DofInputs) → executions.
template <auto fields, auto validate, auto declare, auto frameCount>
Technique makeTechnique(const TechniqueTitle& title, TechniqueInput input) {
  using Parameters = decltype(detail::parametersOf(fields()));
  return {.name = title.name,
          .title = title.title,
          .source = title.source,
          .input = input,
          .parameters = describe<Parameters>(fields()),
          .validate = [](const ParameterSet& set,
                         const DofInputs& inputs) { return validate(fromSet<Parameters>(set, fields()), inputs); },
          .declare = [](rendergraph::Graph& graph, const DofInputs& inputs,
                        const ParameterSet& set) { return declare(graph, inputs, fromSet<Parameters>(set, fields())); },
          .frameCount = [](const ParameterSet& set, const DofInputs& inputs) -> uint32_t {
            return frameCount(fromSet<Parameters>(set, fields()), inputs);
          }};
}

}  // namespace lensgraph::passes
