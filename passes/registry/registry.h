// All techniques by name. A new technique is one folder and one line in registry.cpp.
#pragma once

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

std::span<const Technique> techniques();
/// Null when there is none of that name.
const Technique* findTechnique(std::string_view name);
/// The most similar name, to suggest; empty when none is near.
std::string_view nearestTechniqueName(std::string_view name);

}  // namespace lensgraph::passes
