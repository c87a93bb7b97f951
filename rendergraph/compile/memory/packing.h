// Packing of resources that are not alive at the same time into one block of memory. Pure: intervals and sizes in,
// offsets out. Items alive at the same time never overlap; equal input gives equal output.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <vector>

namespace lensgraph::rendergraph {

struct AliasItem {
  VkDeviceSize size = 0;         ///< Bytes, at least 1.
  VkDeviceSize alignment = 1;    ///< Bytes, a power of two.
  uint32_t first = 0, last = 0;  ///< Steps during which it is alive, inclusive. Memory grows with the largest.
};

struct Packing {
  std::vector<VkDeviceSize> offsets;  ///< By item.
  VkDeviceSize size = 0;              ///< Bytes of the block.
};

/// Some tens of nanoseconds an item; typically within a tenth of the lower bound. fast_packing.cpp tells how.
Packing packFast(std::span<const AliasItem> items);

/// Tries several heuristics, then improves the best of them by a search of bounded cost; stops as soon as the lower
/// bound is reached. Never larger than packFast(). Some milliseconds at most for graphs of up to a thousand passes.
Packing packBest(std::span<const AliasItem> items);

/// Every item has its own bytes.
Packing packSeparately(std::span<const AliasItem> items);

/// Largest sum of sizes alive at once: no packing can be smaller.
VkDeviceSize largestLiveSum(std::span<const AliasItem> items);

/// The next multiple of a power of two.
constexpr VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment) {
  return (value + alignment - 1) & ~(alignment - 1);
}

}  // namespace lensgraph::rendergraph
