// What tests of compile() on small graphs share: a size, a state, a compute pass, the names of a plan's passes.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/graph.h"

namespace lensgraph::small_graphs {

using namespace rendergraph;

inline const ImageDesc kDesc{.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 64, .height = 64};
inline const AccessState kSampled{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                  VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};

inline Plan planOf(const Graph& graph, CompileOptions options = {}) {
  return compile(graph.declaration(), options, NominalDevice());
}

/// Names of the living passes in execution order.
inline std::vector<std::string> names(const Graph& graph, const Plan& plan) {
  std::vector<std::string> result;
  for (const PlannedPass& pass : plan.passes) result.emplace_back(graph.declaration().passes[pass.pass].name);
  return result;
}

/// A compute pass that samples some images and writes one.
inline Image step(Graph& graph, const char* name, std::initializer_list<Image> inputs, Image output) {
  Pass pass = graph.addPass(name, PassKind::compute);
  for (const Image& input : inputs) pass.sample(input);
  return pass.write(output, Usage::storage);
}

}  // namespace lensgraph::small_graphs
