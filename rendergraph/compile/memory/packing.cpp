// The two ends between which every packing lies.
#include "rendergraph/compile/memory/packing.h"

#include <algorithm>

namespace lensgraph::rendergraph {

VkDeviceSize largestLiveSum(std::span<const AliasItem> items) {
  uint32_t steps = 0;
  for (const AliasItem& item : items) steps = std::max(steps, item.last + 1);
  std::vector<VkDeviceSize> born(steps, 0), dies(steps, 0);
  for (const AliasItem& item : items) {
    born[item.first] += item.size;
    dies[item.last] += item.size;
  }
  VkDeviceSize live = 0, largest = 0;
  for (uint32_t step = 0; step < steps; ++step) {
    live += born[step];
    largest = std::max(largest, live);
    live -= dies[step];
  }
  return largest;
}

Packing packSeparately(std::span<const AliasItem> items) {
  Packing packing;
  packing.offsets.reserve(items.size());
  for (const AliasItem& item : items) {
    packing.offsets.push_back(alignUp(packing.size, item.alignment));
    packing.size = packing.offsets.back() + item.size;
  }
  return packing;
}

}  // namespace lensgraph::rendergraph
