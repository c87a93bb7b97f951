// One compute pass over the picture, in place.
#include "passes/nodes/sanitize.h"

#include "rendergraph/compute_pass.h"
#include "shaders/shared/sanitize.h"
#include "spirv/sanitize/sanitize_comp.h"

namespace lensgraph::passes {

namespace {
const rendergraph::ComputeProgram kSanitize{"sanitize", sanitize_sanitize_comp};
}

void declareSanitize(rendergraph::Graph& graph, const std::string& prefix, rendergraph::Image& color,
                     rendergraph::Buffer& statistics) {
  const auto& picture = graph.desc(color);
  compute(graph, prefix + ".sanitize", kSanitize)
      .modify(color)
      .modify(statistics)
      .groups(rendergraph::groupsFor({picture.width, picture.height}, shared::kSanitizeTile));
}

}  // namespace lensgraph::passes
