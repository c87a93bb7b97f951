// Dynamic storage allocation with known lifetimes: place items one by one, each into a gap left free by the placed
// items that are alive with it. The order of placement decides how good the result is, so several orders are tried
// (Pisarchyk & Lee 2020, "Efficient Memory Management for Deep Neural Net Inference": size, and duration × size),
// and then the items that stick out at the top are moved forward in the order until nothing improves.
#include <algorithm>
#include <functional>
#include <numeric>

#include "rendergraph/compile/memory/packing.h"
#include "rendergraph/compile/schedule/deterministic_random.h"

namespace lensgraph::rendergraph {

namespace {

using Ranking = std::vector<uint32_t>;

enum class Fit { lowest, tightest };

/// Items that are alive at the same time as each item.
class Conflicts {
 public:
  explicit Conflicts(std::span<const AliasItem> items) : starts_(items.size() + 1, 0) {
    std::vector<uint32_t> byStart(items.size());
    std::iota(byStart.begin(), byStart.end(), 0u);
    std::sort(byStart.begin(), byStart.end(),
              [&](uint32_t a, uint32_t b) { return std::pair(items[a].first, a) < std::pair(items[b].first, b); });
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    std::vector<uint32_t> active;
    for (uint32_t item : byStart) {
      std::erase_if(active, [&](uint32_t other) { return items[other].last < items[item].first; });
      for (uint32_t other : active) {
        pairs.emplace_back(item, other);
        pairs.emplace_back(other, item);
      }
      active.push_back(item);
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [item, other] : pairs) {
      ++starts_[item + 1];
      others_.push_back(other);
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  }
  std::span<const uint32_t> of(uint32_t item) const {
    return {others_.data() + starts_[item], others_.data() + starts_[item + 1]};
  }

 private:
  std::vector<uint32_t> starts_, others_;
};

class Packer {
 public:
  explicit Packer(std::span<const AliasItem> items) : items_(items), conflicts_(items) {}

  Packing pack(const Ranking& ranking, Fit fit) {
    Packing packing;
    packing.offsets.resize(items_.size());
    repack(ranking, 0, fit, kUnplaced, packing);
    return packing;
  }

  /// Places the items from `from` on in the ranking anew; those before keep their offsets. Gives up, with false, as
  /// soon as the block would exceed `limit`; the packing is of no use then.
  bool repack(const Ranking& ranking, std::size_t from, Fit fit, VkDeviceSize limit, Packing& packing) {
    packing.size = 0;
    for (std::size_t i = 0; i < from; ++i) {
      packing.size = std::max(packing.size, packing.offsets[ranking[i]] + items_[ranking[i]].size);
    }
    for (std::size_t i = from; i < ranking.size(); ++i) packing.offsets[ranking[i]] = kUnplaced;
    for (std::size_t i = from; i < ranking.size(); ++i) {
      const uint32_t item = ranking[i];
      packing.offsets[item] = offsetFor(item, packing.offsets, fit);
      packing.size = std::max(packing.size, packing.offsets[item] + items_[item].size);
      ++placements_;
      if (packing.size > limit) return false;
    }
    return true;
  }

  const Conflicts& conflicts() const { return conflicts_; }
  /// So far.
  uint64_t placements() const { return placements_; }

 private:
  static constexpr VkDeviceSize kUnplaced = ~VkDeviceSize{0};
  using Interval = std::pair<VkDeviceSize, VkDeviceSize>;

  VkDeviceSize offsetFor(uint32_t item, const std::vector<VkDeviceSize>& offsets, Fit fit) {
    const AliasItem& wanted = items_[item];
    gather(item, offsets);
    VkDeviceSize cursor = 0, best = kUnplaced, bestGap = kUnplaced;
    for (const auto& [begin, end] : taken_) {
      const VkDeviceSize offset = alignUp(cursor, wanted.alignment);
      if (offset + wanted.size <= begin) {
        if (fit == Fit::lowest) return offset;
        if (begin - cursor < bestGap) {
          bestGap = begin - cursor;
          best = offset;
        }
      }
      cursor = std::max(cursor, end);
    }
    return best != kUnplaced ? best : alignUp(cursor, wanted.alignment);
  }

  /// What the placed items alive with this one take, in rising order.
  void gather(uint32_t item, const std::vector<VkDeviceSize>& offsets) {
    constexpr std::size_t kFew = 24;  // Up to which inserting one by one is faster than sorting.
    taken_.clear();
    for (uint32_t other : conflicts_.of(item)) {
      if (offsets[other] == kUnplaced) continue;
      const Interval interval(offsets[other], offsets[other] + items_[other].size);
      taken_.push_back(interval);
      if (taken_.size() > kFew) continue;
      std::size_t place = taken_.size() - 1;
      for (; place > 0 && taken_[place - 1].first > interval.first; --place) taken_[place] = taken_[place - 1];
      taken_[place] = interval;
    }
    if (taken_.size() > kFew) std::sort(taken_.begin(), taken_.end());
  }

  std::span<const AliasItem> items_;
  Conflicts conflicts_;
  std::vector<Interval> taken_;
  uint64_t placements_ = 0;
};

/// Items sorted by falling key, ties by index.
Ranking rankedBy(std::span<const AliasItem> items, const std::function<double(const AliasItem&)>& key) {
  Ranking ranking(items.size());
  std::iota(ranking.begin(), ranking.end(), 0u);
  std::stable_sort(ranking.begin(), ranking.end(),
                   [&](uint32_t a, uint32_t b) { return key(items[a]) > key(items[b]); });
  return ranking;
}

/// Items of the steps with the largest live sums first, so that the crowded moments are packed while all is free.
Ranking rankedByCrowding(std::span<const AliasItem> items) {
  uint32_t steps = 0;
  for (const AliasItem& item : items) steps = std::max(steps, item.last + 1);
  std::vector<VkDeviceSize> live(steps, 0);
  for (const AliasItem& item : items) {
    for (uint32_t step = item.first; step <= item.last; ++step) live[step] += item.size;
  }
  return rankedBy(items, [&](const AliasItem& item) {
    const VkDeviceSize crowd = *std::max_element(live.begin() + item.first, live.begin() + item.last + 1);
    return static_cast<double>(crowd) * 1e3 + static_cast<double>(item.size) * 1e-6;
  });
}

/// Moves an item that reaches the top to an earlier place in the ranking, as long as the block does not grow.
class Improver {
 public:
  Improver(std::span<const AliasItem> items, Packer& packer, VkDeviceSize bound)
      : items_(items), packer_(packer), bound_(bound) {}

  /// `placements`: how many the search may cost.
  void improve(Ranking ranking, Fit fit, Packing& best, uint64_t placements) {
    Packing current = packer_.pack(ranking, fit);
    Packing packing = current;
    const uint64_t end = packer_.placements() + placements;
    while (packer_.placements() < end && best.size > bound_) {
      const Move move = promotion(ranking, topItem(current));
      apply(ranking, move);
      packing.offsets = current.offsets;
      if (packer_.repack(ranking, move.to, fit, current.size, packing)) {
        std::swap(current, packing);
        if (current.size < best.size) best = current;
      } else {
        undo(ranking, move);
      }
    }
  }

 private:
  uint32_t topItem(const Packing& packing) {
    top_.clear();
    for (uint32_t item = 0; item < items_.size(); ++item) {
      if (packing.offsets[item] + items_[item].size == packing.size) top_.push_back(item);
    }
    const uint32_t top = top_[random_.below(static_cast<uint32_t>(top_.size()))];
    // Half of the time the fault lies with a neighbour in time that sits in the wrong place.
    const auto others = packer_.conflicts().of(top);
    if (others.empty() || random_.below(2) == 0) return top;
    return others[random_.below(static_cast<uint32_t>(others.size()))];
  }

  struct Move {
    std::size_t from, to;  // Places in the ranking, the second not later.
  };
  Move promotion(const Ranking& ranking, uint32_t item) {
    const auto from = static_cast<std::size_t>(std::find(ranking.begin(), ranking.end(), item) - ranking.begin());
    return {from, random_.below(static_cast<uint32_t>(from) + 1)};
  }
  static auto at(Ranking& ranking, std::size_t place) { return ranking.begin() + static_cast<std::ptrdiff_t>(place); }
  static void apply(Ranking& ranking, const Move& move) {
    std::rotate(at(ranking, move.to), at(ranking, move.from), at(ranking, move.from) + 1);
  }
  static void undo(Ranking& ranking, const Move& move) {
    std::rotate(at(ranking, move.to), at(ranking, move.to) + 1, at(ranking, move.from) + 1);
  }

  std::span<const AliasItem> items_;
  Packer& packer_;
  VkDeviceSize bound_;
  DeterministicRandom random_;
  std::vector<uint32_t> top_;
};

// Placements that the search may cost in all: keeps it at some milliseconds however large the graph is. The plan
// cache pays for it once per structure.
constexpr uint64_t kSearchBudget = 150'000;

// Pairs of items alive together up to which they are listed: some tens of megabytes and milliseconds. Only graphs of
// thousands of resources that nearly all live throughout have more, and those leave little to share.
constexpr uint64_t kMostPairs = 4'000'000;

uint64_t overlappingPairs(std::span<const AliasItem> items) {
  uint32_t steps = 0;
  for (const AliasItem& item : items) steps = std::max(steps, item.last + 1);
  std::vector<uint32_t> born(steps, 0), dies(steps, 0);
  for (const AliasItem& item : items) {
    ++born[item.first];
    ++dies[item.last];
  }
  uint64_t live = 0, pairs = 0;
  for (uint32_t step = 0; step < steps; ++step) {
    for (uint32_t i = 0; i < born[step]; ++i) pairs += live++;
    live -= dies[step];
  }
  return pairs;
}

}  // namespace

Packing packBest(std::span<const AliasItem> items) {
  Packing best = packFast(items);
  const VkDeviceSize bound = largestLiveSum(items);
  if (best.size == bound || overlappingPairs(items) > kMostPairs) return best;
  Packer packer(items);
  const auto duration = [](const AliasItem& item) { return static_cast<double>(item.last - item.first + 1); };
  const auto size = [](const AliasItem& item) { return static_cast<double>(item.size); };
  const Ranking rankings[] = {
      rankedBy(items, size),
      rankedBy(items, [&](const AliasItem& item) { return size(item) * duration(item); }),
      rankedBy(items, duration),
      rankedBy(items, [](const AliasItem& item) { return -static_cast<double>(item.first); }),
      rankedByCrowding(items),
  };
  struct Start {
    VkDeviceSize size;
    const Ranking* ranking;
    Fit fit;
  };
  std::vector<Start> starts;
  for (const Ranking& ranking : rankings) {
    for (Fit fit : {Fit::tightest, Fit::lowest}) {
      Packing packing = packer.pack(ranking, fit);
      starts.push_back({packing.size, &ranking, fit});
      if (packing.size < best.size) best = std::move(packing);
      if (best.size == bound) return best;
    }
  }
  std::stable_sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.size < b.size; });
  Improver improver(items, packer, bound);
  for (std::size_t i = 0; i < 3; ++i) improver.improve(*starts[i].ranking, starts[i].fit, best, kSearchBudget / 3);
  return best;
}

}  // namespace lensgraph::rendergraph
