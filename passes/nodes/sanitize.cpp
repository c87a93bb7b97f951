// One compute pass over the picture, in place.
#include "passes/nodes/sanitize.h"

#include <array>

#include "rendergraph/program.h"
#include "shaders/shared/sanitize.h"
#include "spirv/sanitize/sanitize_comp.h"

namespace lensgraph::passes {

namespace {
const rendergraph::ComputeProgram kSanitize{"sanitize", sanitize_sanitize_comp};
}

void declareSanitize(rendergraph::Graph& graph, const std::string& prefix, rendergraph::Image& color,
                     rendergraph::Buffer& statistics) {
  auto pass = graph.addPass(prefix + ".sanitize", rendergraph::PassKind::compute);
  color = pass.modify(color, rendergraph::Usage::storage);
  statistics = pass.modify(statistics, rendergraph::Usage::storage);
  pass.record([color, statistics](rendergraph::PassContext& context) {
    const std::array bindings = {rendergraph::storage(color), rendergraph::storage(statistics)};
    context.dispatch({.program = kSanitize,
                      .bindings = bindings,
                      .groups = rendergraph::groupsFor(context.extent(color), shared::kSanitizeTile)});
  });
}

}  // namespace lensgraph::passes
