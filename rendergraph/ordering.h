// The order in which living passes execute. Pure and deterministic.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/compiler.h"

namespace rendergraph {

struct Declaration;
struct Edge;

/// Living passes in execution order. `bytes`: memory of each resource of the graph, 0 for all others.
/// When some passes wait for each other the result lacks them.
std::vector<uint32_t> orderPasses(const Declaration& declaration, std::span<const uint8_t> alive,
                                  std::span<const Edge> edges, std::span<const VkDeviceSize> bytes, Order policy);

}  // namespace rendergraph
