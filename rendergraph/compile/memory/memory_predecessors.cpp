// Sweeps over time with, for each heap, its byte ranges and their latest predecessors. With overlapping frames the sweep
// is done twice, and the second one starts from what the first one left.
#include "rendergraph/compile/memory/memory_predecessors.h"

#include <algorithm>

namespace lensgraph::rendergraph {

namespace {

/// One heap. Segments are contiguous and sorted; the last one reaches to infinity.
class HeapMap {
 public:
  /// Gives the bytes to the resource and calls before(predecessor) for everyone who had some of them.
  template <class Use>
  void occupy(const Placement& placement, bool replaces, Use&& before) {
    const std::size_t first = split(placement.offset);
    const std::size_t end = split(placement.offset + placement.size);
    for (std::size_t i = first; i < end; ++i) {
      Segment& segment = segments_[i];
      for (uint32_t node = segment.predecessors; node != kNone; node = nodes_[node].next)
        before(nodes_[node].predecessor);
      nodes_.push_back({{placement.resource, false}, replaces ? kNone : segment.predecessors});
      segment.predecessors = static_cast<uint32_t>(nodes_.size() - 1);
    }
    if (replaces)
      segments_.erase(segments_.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                      segments_.begin() + static_cast<std::ptrdiff_t>(end));
  }
  void beginNextFrame() {
    for (Node& node : nodes_) node.predecessor.frameBefore = true;
  }

 private:
  struct Segment {
    VkDeviceSize begin;
    uint32_t predecessors;  // Head of a list of nodes.
  };
  struct Node {
    MemoryPredecessor predecessor;
    uint32_t next;
  };

  /// Makes `at` the start of a segment. Lists of nodes may be shared: a node never changes its successor.
  std::size_t split(VkDeviceSize at) {
    const auto next =
        std::upper_bound(segments_.begin(), segments_.end(), at,
                         [](VkDeviceSize value, const Segment& segment) { return value < segment.begin; });
    const auto index = static_cast<std::size_t>(next - segments_.begin()) - 1;
    if (segments_[index].begin == at) return index;
    segments_.insert(next, Segment{at, segments_[index].predecessors});
    return index + 1;
  }

  std::vector<Segment> segments_{{0, kNone}};
  std::vector<Node> nodes_;
};

}  // namespace

MemoryPredecessors::MemoryPredecessors(std::span<const Placement> placements, std::size_t resources,
                                       std::span<const uint8_t> fullyUsed, bool overlappingFrames)
    : starts_(resources, 0), counts_(resources, 0) {
  // By first step, then by resource: placements are sorted by resource already, so counting keeps that.
  uint32_t steps = 0, heaps = 0;
  for (const Placement& placement : placements) {
    steps = std::max(steps, placement.firstStep + 1);
    heaps = std::max(heaps, placement.heap + 1);
  }
  std::vector<uint32_t> next(steps + 1, 0);
  for (const Placement& placement : placements) ++next[placement.firstStep + 1];
  for (uint32_t step = 0; step < steps; ++step) next[step + 1] += next[step];
  std::vector<uint32_t> byTime(placements.size());
  for (uint32_t i = 0; i < placements.size(); ++i) byTime[next[placements[i].firstStep]++] = i;

  std::vector<HeapMap> maps(heaps);
  all_.reserve(placements.size() * 2);
  for (int frame = overlappingFrames ? 0 : 1; frame < 2; ++frame) {
    for (uint32_t index : byTime) {
      const Placement& placement = placements[index];
      const auto start = static_cast<uint32_t>(all_.size());
      maps[placement.heap].occupy(placement, fullyUsed[placement.resource] != 0,
                                  [&](const MemoryPredecessor& predecessor) {
                                    if (std::find(all_.begin() + start, all_.end(), predecessor) == all_.end())
                                      all_.push_back(predecessor);
                                  });
      starts_[placement.resource] = start;
      counts_[placement.resource] = static_cast<uint32_t>(all_.size()) - start;
    }
    if (frame == 1) break;
    all_.clear();
    for (HeapMap& map : maps) map.beginNextFrame();
  }
}

}  // namespace lensgraph::rendergraph
