// Packing for frames whose structure changes. Two schemes, chosen by how crowded the graph is:
//
// - Few neighbours in time: the largest first, each into the tightest gap between the placed items that are alive with
//   it (the rule of best_packing.cpp, with the conflicts in arrays of exactly the pairs that are looked at).
// - Many: the items of the most crowded step are stacked without a hole, and from there the steps are walked to the
//   end and to the start with a list of free gaps, tightest fit. The block is then as small as it can be where it
//   matters most, and an item costs the scan of a few gaps however many are alive with it.
#include <algorithm>
#include <numeric>
#include <utility>

#include "rendergraph/compile/memory/packing.h"

namespace lensgraph::rendergraph {

namespace {

/// Bytes that are free, or taken.
struct Interval {
  VkDeviceSize begin = 0, end = 0;
};
constexpr VkDeviceSize kEndless = ~VkDeviceSize{0} >> 1;

/// Items by the steps at which they begin and end to be alive.
class PackingOrder {
 public:
  explicit PackingOrder(std::span<const AliasItem> items) : items_(items) {
    for (const AliasItem& item : items) steps_ = std::max(steps_, item.last + 1);
    bornStarts_.assign(steps_ + 1, 0);
    diedStarts_.assign(steps_ + 1, 0);
    for (const AliasItem& item : items) {
      ++bornStarts_[item.first];
      ++diedStarts_[item.last];
    }
    std::partial_sum(bornStarts_.begin(), bornStarts_.end(), bornStarts_.begin());
    std::partial_sum(diedStarts_.begin(), diedStarts_.end(), diedStarts_.begin());
    born_.resize(items.size());
    died_.resize(items.size());
    for (auto index = static_cast<uint32_t>(items.size()); index-- > 0;) {
      born_[--bornStarts_[items[index].first]] = index;
      died_[--diedStarts_[items[index].last]] = index;
    }
    measure();
  }
  uint32_t steps() const { return steps_; }
  uint32_t peakStep() const { return peakStep_; }
  VkDeviceSize bound() const { return bound_; }
  uint64_t overlappingPairs() const { return pairs_; }
  std::span<const uint32_t> bornAt(uint32_t step) const {
    return {born_.data() + bornStarts_[step], born_.data() + bornStarts_[step + 1]};
  }
  std::span<const uint32_t> diedAt(uint32_t step) const {
    return {died_.data() + diedStarts_[step], died_.data() + diedStarts_[step + 1]};
  }

 private:
  void measure() {
    VkDeviceSize live = 0;
    uint64_t count = 0;
    for (uint32_t step = 0; step < steps_; ++step) {
      for (uint32_t item : bornAt(step)) {
        live += items_[item].size;
        pairs_ += count++;
      }
      if (live > bound_) {
        bound_ = live;
        peakStep_ = step;
      }
      for (uint32_t item : diedAt(step)) live -= items_[item].size;
      count -= diedAt(step).size();
    }
  }

  std::span<const AliasItem> items_;
  uint32_t steps_ = 0, peakStep_ = 0;
  VkDeviceSize bound_ = 0;
  uint64_t pairs_ = 0;
  std::vector<uint32_t> bornStarts_, born_, diedStarts_, died_;
};

/// Free bytes in rising order; the last gap never ends.
class FreeGaps {
 public:
  VkDeviceSize top() const { return top_; }

  void assign(const std::vector<Interval>& gaps) {
    gaps_ = gaps;
    top_ = std::max(top_, gaps.back().begin);
  }

  /// Takes the tightest gap.
  VkDeviceSize place(VkDeviceSize size, VkDeviceSize alignment) {
    std::size_t best = gaps_.size() - 1;
    VkDeviceSize tightest = kEndless;
    for (std::size_t i = 0; i + 1 < gaps_.size(); ++i) {
      const VkDeviceSize length = gaps_[i].end - gaps_[i].begin;
      if (length < tightest && alignUp(gaps_[i].begin, alignment) + size <= gaps_[i].end) {
        tightest = length;
        best = i;
      }
    }
    const Interval gap = gaps_[best];
    const VkDeviceSize offset = alignUp(gap.begin, alignment), end = offset + size;
    top_ = std::max(top_, end);
    const auto place = gaps_.begin() + static_cast<std::ptrdiff_t>(best);
    if (offset == gap.begin) {
      place->begin = end;
      if (end == gap.end) gaps_.erase(place);
    } else {
      place->end = offset;
      if (end < gap.end) gaps_.insert(place + 1, {end, gap.end});
    }
    return offset;
  }

  void release(VkDeviceSize begin, VkDeviceSize end) {
    auto next = gaps_.begin();
    while (next->begin < begin) ++next;
    const bool joinsPrevious = next != gaps_.begin() && (next - 1)->end == begin;
    const bool joinsNext = next->begin == end;
    if (joinsPrevious && joinsNext) {
      (next - 1)->end = next->end;
      gaps_.erase(next);
    } else if (joinsPrevious) {
      (next - 1)->end = end;
    } else if (joinsNext) {
      next->begin = begin;
    } else {
      gaps_.insert(next, {begin, end});
    }
  }

 private:
  std::vector<Interval> gaps_;
  VkDeviceSize top_ = 0;
};

/// Stacks the most crowded step, then walks away from it in both directions.
class Outward {
 public:
  enum class Stack { oldestFirst, longestLivedFirst };

  Outward(std::span<const AliasItem> items, const PackingOrder& schedule) : items_(items), schedule_(schedule) {
    for (uint32_t step = 0; step <= schedule.peakStep(); ++step) {
      for (uint32_t item : schedule.bornAt(step)) {
        if (items[item].last >= schedule.peakStep()) crowd_.push_back(item);
      }
    }
  }

  Packing pack(Stack stack) {
    Packing packing;
    packing.offsets.resize(items_.size());
    gaps_ = {};
    stackCrowd(stack, packing.offsets);
    gaps_.assign(around_);
    for (uint32_t step = schedule_.peakStep() + 1; step < schedule_.steps(); ++step) {
      releaseAll(schedule_.diedAt(step - 1), packing.offsets);
      placeAll(schedule_.bornAt(step), packing.offsets);
    }
    gaps_.assign(around_);
    for (uint32_t step = schedule_.peakStep(); step-- > 0;) {
      releaseAll(schedule_.bornAt(step + 1), packing.offsets);
      placeAll(schedule_.diedAt(step), packing.offsets);
    }
    packing.size = gaps_.top();
    return packing;
  }

 private:
  void stackCrowd(Stack stack, std::vector<VkDeviceSize>& offsets) {
    // Items that leave the crowd together lie together, so that their bytes become one gap.
    std::sort(crowd_.begin(), crowd_.end(), [&](uint32_t a, uint32_t b) {
      const AliasItem &x = items_[a], &y = items_[b];
      const auto key = [&](const AliasItem& item) {
        return stack == Stack::oldestFirst ? int64_t{item.first} : -int64_t{item.last};
      };
      return std::pair(key(x), a) < std::pair(key(y), b);
    });
    around_.clear();
    VkDeviceSize end = 0;
    for (uint32_t item : crowd_) {
      offsets[item] = alignUp(end, items_[item].alignment);
      if (offsets[item] > end) around_.push_back({end, offsets[item]});
      end = offsets[item] + items_[item].size;
    }
    around_.push_back({end, kEndless});
  }

  void placeAll(std::span<const uint32_t> group, std::vector<VkDeviceSize>& offsets) {
    sorted_.assign(group.begin(), group.end());
    if (sorted_.size() > 1) {
      std::sort(sorted_.begin(), sorted_.end(),
                [&](uint32_t a, uint32_t b) { return std::pair(items_[b].size, a) < std::pair(items_[a].size, b); });
    }
    for (uint32_t item : sorted_) offsets[item] = gaps_.place(items_[item].size, items_[item].alignment);
  }

  void releaseAll(std::span<const uint32_t> group, const std::vector<VkDeviceSize>& offsets) {
    for (uint32_t item : group) gaps_.release(offsets[item], offsets[item] + items_[item].size);
  }

  std::span<const AliasItem> items_;
  const PackingOrder& schedule_;
  std::vector<uint32_t> crowd_, sorted_;
  std::vector<Interval> around_;
  FreeGaps gaps_;
};

/// Largest first. Items are renamed by their rank, so that a pair's later item is the one with the larger number.
class LargestFirst {
 public:
  LargestFirst(std::span<const AliasItem> items, const PackingOrder& schedule) : items_(items) {
    const auto count = static_cast<uint32_t>(items.size());
    ranking_.resize(count);
    std::iota(ranking_.begin(), ranking_.end(), 0u);
    std::sort(ranking_.begin(), ranking_.end(),
              [&](uint32_t a, uint32_t b) { return std::pair(items[b].size, a) < std::pair(items[a].size, b); });
    findConflicts(schedule);
  }

  Packing pack() {
    Packing packing;
    packing.offsets.resize(items_.size());
    placed_.resize(items_.size());
    taken_.resize(items_.size());
    for (uint32_t rank = 0; rank < ranking_.size(); ++rank) {
      const AliasItem& item = items_[ranking_[rank]];
      const VkDeviceSize offset = tightestGap(item, gather(rank));
      placed_[rank] = {offset, offset + item.size};
      packing.offsets[ranking_[rank]] = offset;
      packing.size = std::max(packing.size, offset + item.size);
    }
    return packing;
  }

 private:
  struct Pair {
    uint32_t later, earlier;  // Ranks.
  };

  void findConflicts(const PackingOrder& schedule) {
    const auto count = static_cast<uint32_t>(items_.size());
    std::vector<uint32_t> rankOf(count), positions(count), active;
    for (uint32_t rank = 0; rank < count; ++rank) rankOf[ranking_[rank]] = rank;
    std::vector<Pair> pairs;
    pairs.reserve(schedule.overlappingPairs());
    starts_.assign(count + 2, 0);
    for (uint32_t step = 0; step < schedule.steps(); ++step) {
      for (uint32_t item : schedule.bornAt(step)) {
        const uint32_t rank = rankOf[item];
        for (uint32_t other : active) {
          pairs.push_back({std::max(rank, other), std::min(rank, other)});
          ++starts_[pairs.back().later + 2];
        }
        positions[rank] = static_cast<uint32_t>(active.size());
        active.push_back(rank);
      }
      for (uint32_t item : schedule.diedAt(step)) {
        const uint32_t place = positions[rankOf[item]];
        active[place] = active.back();
        positions[active[place]] = place;
        active.pop_back();
      }
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    earlier_.resize(pairs.size());
    for (const Pair& pair : pairs) earlier_[starts_[pair.later + 1]++] = pair.earlier;
  }

  /// What the earlier ones alive with it take, in rising order.
  std::span<const Interval> gather(uint32_t rank) {
    std::size_t count = 0;
    for (uint32_t i = starts_[rank]; i < starts_[rank + 1]; ++i) {
      const Interval interval = placed_[earlier_[i]];
      std::size_t place = count++;
      for (; place > 0 && taken_[place - 1].begin > interval.begin; --place) taken_[place] = taken_[place - 1];
      taken_[place] = interval;
    }
    return {taken_.data(), count};
  }

  static VkDeviceSize tightestGap(const AliasItem& item, std::span<const Interval> taken) {
    VkDeviceSize end = 0, best = kEndless, tightest = kEndless;
    for (const Interval& interval : taken) {
      const VkDeviceSize offset = alignUp(end, item.alignment);
      if (offset + item.size <= interval.begin && interval.begin - end < tightest) {
        tightest = interval.begin - end;
        best = offset;
      }
      end = std::max(end, interval.end);
    }
    return best != kEndless ? best : alignUp(end, item.alignment);
  }

  std::span<const AliasItem> items_;
  std::vector<uint32_t> ranking_;  // Items, largest first.
  std::vector<uint32_t> starts_, earlier_;
  std::vector<Interval> placed_, taken_;  // By rank; scratch.
};

// Neighbours in time per item up to which looking at all of them is as cheap as walking with a list of gaps.
constexpr uint64_t kFewNeighbours = 4;

Packing smaller(Packing a, Packing b) {
  return b.size < a.size ? std::move(b) : std::move(a);
}

Packing packShared(std::span<const AliasItem> items) {
  const PackingOrder schedule(items);
  if (schedule.overlappingPairs() <= kFewNeighbours * items.size()) return LargestFirst(items, schedule).pack();
  Outward outward(items, schedule);
  Packing packing = outward.pack(Outward::Stack::oldestFirst);
  if (packing.size == schedule.bound()) return packing;
  return smaller(std::move(packing), outward.pack(Outward::Stack::longestLivedFirst));
}

}  // namespace

Packing packFast(std::span<const AliasItem> items) {
  if (items.empty()) return {};
  // Of a few items with unlike alignments the order of declaration may waste least.
  return smaller(packShared(items), packSeparately(items));
}

}  // namespace lensgraph::rendergraph
