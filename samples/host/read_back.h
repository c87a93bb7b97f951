// Results of a graph on their way back to the host.
#pragma once

#include <cstddef>
#include <span>

#include "engine/image/image.h"
#include "rendergraph/graph.h"

namespace lensgraph::host {

/// Adds a copy of mip 0 of an image into a host-readable buffer (tightly packed rows) and exports that; read it with
/// Executor::mapped() after the execution. `name` names buffer and pass.
rendergraph::Buffer readBack(rendergraph::Graph& graph, rendergraph::Image image, const char* name);
/// The same for a buffer's whole content.
rendergraph::Buffer readBack(rendergraph::Graph& graph, rendergraph::Buffer from, const char* name);

/// Float samples as a picture. Precondition: as many bytes as the picture has.
engine::FloatImage imageFrom(std::span<const std::byte> bytes, VkExtent2D extent, uint32_t channels);
/// Of float samples.
double rootMeanSquare(std::span<const std::byte> bytes);

}  // namespace lensgraph::host
