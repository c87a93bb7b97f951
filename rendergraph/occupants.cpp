// Sweeps over time with, for each heap, a map from byte ranges to their latest occupants.
#include "rendergraph/occupants.h"

#include <algorithm>
#include <map>

namespace rendergraph {

namespace {

class HeapMap {
 public:
  /// Gives the bytes to `resource` and adds to `before` everyone who must have finished.
  void occupy(const Placement& placement, bool replaces, std::vector<uint32_t>& before) {
    const VkDeviceSize begin = placement.offset, end = placement.offset + placement.size;
    split(begin);
    split(end);
    if (segments_.empty()) return;
    for (auto segment = segments_.lower_bound(begin); segment != segments_.end() && segment->first < end; ++segment) {
      std::vector<uint32_t>& occupants = segment->second;
      before.insert(before.end(), occupants.begin(), occupants.end());
      if (replaces) occupants.clear();
      occupants.push_back(placement.resource);
    }
  }

 private:
  /// Makes `at` the start of a segment. Segments are contiguous; the last one reaches to infinity.
  void split(VkDeviceSize at) {
    if (segments_.empty()) segments_[0] = {};
    auto next = segments_.upper_bound(at);
    --next;
    if (next->first != at) segments_.emplace(at, next->second);
  }
  std::map<VkDeviceSize, std::vector<uint32_t>> segments_;
};

}  // namespace

std::vector<std::vector<uint32_t>> previousOccupants(std::span<const Placement> placements, std::size_t resources,
                                                     std::span<const uint8_t> fullyUsed) {
  std::vector<std::vector<uint32_t>> result(resources);
  std::vector<const Placement*> byTime;
  for (const Placement& placement : placements) byTime.push_back(&placement);
  std::sort(byTime.begin(), byTime.end(), [](const Placement* a, const Placement* b) {
    return std::pair(a->firstStep, a->resource) < std::pair(b->firstStep, b->resource);
  });
  std::map<uint32_t, HeapMap> heaps;
  for (const Placement* placement : byTime) {
    std::vector<uint32_t>& before = result[placement->resource];
    heaps[placement->heap].occupy(*placement, fullyUsed[placement->resource] != 0, before);
    std::sort(before.begin(), before.end());
    before.erase(std::unique(before.begin(), before.end()), before.end());
  }
  return result;
}

}  // namespace rendergraph
