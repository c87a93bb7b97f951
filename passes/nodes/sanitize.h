// The node that keeps what is not finite from leaving a technique.
#pragma once

#include <string>

#include "rendergraph/graph.h"

namespace lensgraph::passes {

/// Declares `prefix`.sanitize: texels of `color` (RGBA32F) that are not finite become opaque black, in place, and are
/// counted in FrameStatistics::replacedTexels of `statistics`. Both handles are advanced.
void declareSanitize(rendergraph::Graph& graph, const std::string& prefix, rendergraph::Image& color,
                     rendergraph::Buffer& statistics);

}  // namespace lensgraph::passes
