// Random declarations that are right by construction: the same seed gives the same graph.
#pragma once

#include <cstdint>

#include "rendergraph/graph.h"

namespace lensgraph {

/// Fills a graph with about `passes` passes of all kinds over images with mips, layers and aspects, buffers, imports,
/// exports, persistent resources and histories. Passes prefer different queues; raster passes often repeat the
/// attachments of the one before. With `resolves`, some images have several samples and are resolved.
void declareRandom(rendergraph::Graph& graph, uint32_t seed, uint32_t passes, bool resolves = false);

}  // namespace lensgraph
