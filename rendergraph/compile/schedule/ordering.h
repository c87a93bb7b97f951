// The order in which living passes execute. Pure and deterministic.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/compile_options.h"

namespace lensgraph::rendergraph {

struct Declaration;
struct Edge;

struct PassOrder {
  std::vector<uint32_t> passes;  ///< Living ones in execution order. Lacks some when passes wait for each other.
  std::vector<uint32_t> groups;  ///< By step: passes of a group run without a barrier in between. Empty: one pass each.

  /// The time of a step in which lifetimes are counted: memory changes hands between groups only. One past the last
  /// step is a time of its own.
  uint32_t timeOf(uint32_t step) const { return timeOf(step, groups); }
  static uint32_t timeOf(uint32_t step, const std::vector<uint32_t>& groups) {
    if (groups.empty()) return step;
    return step < groups.size() ? groups[step] : groups.back() + 1;
  }
};

/// `alive`: by pass. `bytes`: memory of each resource of the graph, 0 for all others. Reads order and memoryBudget.
PassOrder orderPasses(const Declaration& declaration, std::span<const uint8_t> alive, std::span<const Edge> edges,
                      std::span<const VkDeviceSize> bytes, const CompileOptions& options);

}  // namespace lensgraph::rendergraph
