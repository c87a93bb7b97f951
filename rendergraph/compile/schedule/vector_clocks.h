// Vector clocks: for each member (a step, a submission, a queue), how far it knows each queue to have come.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lensgraph::rendergraph {

class VectorClocks {
 public:
  VectorClocks() = default;
  /// All clocks are 0: nothing is known.
  VectorClocks(std::size_t members, uint32_t queues) : queues_(queues), times_(members * queues, 0) {}

  uint32_t& of(std::size_t member, uint32_t queue) { return times_[member * queues_ + queue]; }
  uint32_t of(std::size_t member, uint32_t queue) const { return times_[member * queues_ + queue]; }
  /// The clocks of one member, by queue.
  std::span<const uint32_t> row(std::size_t member) const { return {times_.data() + member * queues_, queues_}; }

  /// The member learns what `earlier` knows: each clock becomes the later of the two.
  void include(std::size_t member, std::span<const uint32_t> earlier) {
    for (uint32_t queue = 0; queue < queues_; ++queue) of(member, queue) = std::max(of(member, queue), earlier[queue]);
  }

 private:
  uint32_t queues_ = 0;
  std::vector<uint32_t> times_;
};

}  // namespace lensgraph::rendergraph
