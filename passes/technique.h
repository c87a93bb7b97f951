// What a technique is to a host that chooses among several: its name, its parameters, and the functions that check and
// declare it; and how such an entry is made from a technique's own typed functions.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "passes/dof_io.h"
#include "passes/parameters.h"
#include "rendergraph/graph.h"

namespace lensgraph::passes {

enum class TechniqueInput : uint8_t {
  image,  ///< Works on colour and depth of the pinhole view; usable on any RGBZ image.
  scene,  ///< Draws the scene through SceneDraw.
};

struct Technique {
  std::string_view name;    ///< As configuration names it, snake_case.
  std::string_view title;   ///< For people.
  std::string_view source;  ///< Paper.
  TechniqueInput input = TechniqueInput::image;
  std::vector<ParameterInfo> parameters;

  /// Problems that need the inputs to be seen (after check() of the set by itself). Pure.
  std::vector<Problem> (*validate)(const ParameterSet& parameters, const DofInputs& inputs) = nullptr;
  /// Declares the technique's nodes. Precondition: check() and validate() found nothing.
  DofOutputs (*declare)(rendergraph::Graph& graph, const DofInputs& inputs, const ParameterSet& parameters) = nullptr;
  /// Executions of the graph that make one finished picture, DofInputs::frame counting them; 1 for most.
  uint32_t (*frameCount)(const ParameterSet& parameters, const DofInputs& inputs) = nullptr;
};

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
