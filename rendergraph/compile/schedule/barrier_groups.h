// Passes in groups without a barrier inside, as few groups as a memory budget allows. Pure and deterministic.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lensgraph::rendergraph {

class MemoryUse;
struct Edge;

/// Group of every pass of `order` (by pass; 0 for all others), counted from 0. Passes that wait for each other are in
/// different groups, the ready one in the later. What is used in a group is alive for the whole of it; `budget`
/// bounds the bytes alive in any group, exceeded by as little as can be found when no grouping fits.
/// `order`: any valid order.
std::vector<uint32_t> groupPasses(const MemoryUse& use, std::span<const Edge> edges, std::span<const uint32_t> order,
                                  int64_t budget);

}  // namespace lensgraph::rendergraph
