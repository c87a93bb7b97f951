// List scheduling under a budget: a group takes, of the passes that wait for nothing in it, those with the longest way
// to go, as long as their bytes fit beside what is alive. Done from the start and from the end of time, since a
// graph that narrows is easier to pack from its narrow side. Then a search of bounded cost shifts the priorities of a
// few passes at a time and keeps what gets no worse.
//
// On graphs of parallel lanes this gives a schedule near the longest chain at the memory of the declared order: lanes
// advance at different times, so that their large textures do not meet.
#include "rendergraph/compile/schedule/barrier_groups.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "rendergraph/compile/schedule/deterministic_random.h"
#include "rendergraph/compile/schedule/live_bytes.h"
#include "rendergraph/compile/schedule/ready_passes.h"

namespace lensgraph::rendergraph {

namespace {

struct Grouping {
  std::vector<uint32_t> groupOf;  // By pass.
  uint32_t groups = 0;
  int64_t excess = 0;  // Bytes over the budget.
  int64_t peak = 0;
  uint64_t lateness = 0;  // Sum of the group numbers: tells apart what ends in the same group.
};

using Priorities = std::vector<int64_t>;
// One step along the longest chain, in units of priority; shifts of the search are fractions and small multiples.
constexpr int64_t kStep = 1024;

class GroupScheduler {
 public:
  GroupScheduler(const MemoryUse& use, std::span<const Edge> edges, std::span<const uint32_t> order, uint32_t passes,
                 Direction direction)
      : order_(order),
        passes_(passes),
        direction_(direction),
        ready_(edges, passes, direction == Direction::backward),
        bytes_(use, direction) {}

  /// The longest way to the end (or start), by pass.
  Priorities wayToGo() const {
    Priorities way(passes_, 0);
    const auto visit = [&](uint32_t pass) {
      ready_.forEachNext(pass, [&](uint32_t next) { way[pass] = std::max(way[pass], way[next] + kStep); });
    };
    if (direction_ == Direction::forward) {
      std::for_each(order_.rbegin(), order_.rend(), visit);
    } else {
      std::for_each(order_.begin(), order_.end(), visit);
    }
    return way;
  }

  Grouping run(const Priorities& priorities, int64_t budget) {
    Grouping result{.groupOf = std::vector<uint32_t>(passes_, 0)};
    ready_.reset();
    bytes_.reset();
    candidates_.clear();
    for (uint32_t pass : order_) {
      if (ready_.ready(pass)) candidates_.emplace_back(priorities[pass], ~pass);
    }
    std::make_heap(candidates_.begin(), candidates_.end());
    for (; !candidates_.empty(); ++result.groups) {
      fillGroup(budget);
      result.peak = std::max(result.peak, bytes_.live());
      for (uint32_t pass : members_) {
        result.groupOf[pass] = result.groups;
        result.lateness += result.groups;
        bytes_.end(pass);
        ready_.finish(pass, [&](uint32_t next) { push({priorities[next], ~next}); });
      }
    }
    result.excess = std::max<int64_t>(0, result.peak - budget);
    if (direction_ == Direction::backward) {
      for (uint32_t pass : order_) result.groupOf[pass] = result.groups - 1 - result.groupOf[pass];
    }
    return result;
  }

 private:
  // Priority, and the pass with its bits turned so that ties go to the one declared first.
  using Candidate = std::pair<int64_t, uint32_t>;
  // Candidates that are looked at in vain per group; keeps the cost linear when thousands are ready.
  static constexpr std::size_t kPatience = 64;

  void push(Candidate candidate) {
    candidates_.push_back(candidate);
    std::push_heap(candidates_.begin(), candidates_.end());
  }

  void fillGroup(int64_t budget) {
    members_.clear();
    passedOver_.clear();
    while (!candidates_.empty() && passedOver_.size() < kPatience) {
      std::pop_heap(candidates_.begin(), candidates_.end());
      const Candidate candidate = candidates_.back();
      candidates_.pop_back();
      const uint32_t pass = ~candidate.second;
      if (bytes_.live() + bytes_.added(pass) > budget) {
        passedOver_.push_back(candidate);
        continue;
      }
      bytes_.begin(pass);
      members_.push_back(pass);
    }
    if (members_.empty()) takeCheapest();
    for (const Candidate& candidate : passedOver_) push(candidate);
  }

  /// Nothing fits: one pass must go on all the same. What it frees helps the later groups only, hence the half.
  void takeCheapest() {
    const auto cost = [&](const Candidate& candidate) {
      return bytes_.added(~candidate.second) - bytes_.freed(~candidate.second) / 2;
    };
    auto cheapest = passedOver_.begin();
    for (auto candidate = cheapest; candidate != passedOver_.end(); ++candidate) {
      if (cost(*candidate) < cost(*cheapest)) cheapest = candidate;
    }
    const uint32_t pass = ~cheapest->second;
    passedOver_.erase(cheapest);
    bytes_.begin(pass);
    members_.push_back(pass);
  }

  std::span<const uint32_t> order_;
  uint32_t passes_;
  Direction direction_;
  ReadyPasses ready_;
  LiveBytes bytes_;
  std::vector<Candidate> candidates_, passedOver_;
  std::vector<uint32_t> members_;
};

// Passes that the search may schedule in all: some milliseconds, however large the graph is.
constexpr std::size_t kSearchBudget = 100'000;
constexpr std::size_t kAttemptsPerPass = 10;  // Enough for small graphs.

void improve(GroupScheduler& scheduler, std::span<const uint32_t> order, int64_t budget, Grouping& best) {
  const auto goal = [](const Grouping& grouping) {
    return std::tuple(grouping.excess, grouping.groups, grouping.peak);
  };
  const auto progress = [](const Grouping& grouping) {
    return std::tuple(grouping.excess, grouping.groups, grouping.lateness);
  };
  const auto keep = [&](const Grouping& grouping) {
    if (best.groups == 0 || goal(grouping) < goal(best)) best = grouping;
  };
  Priorities priorities = scheduler.wayToGo();
  const auto longestChain = static_cast<uint32_t>(*std::max_element(priorities.begin(), priorities.end()) / kStep + 1);
  Grouping current = scheduler.run(priorities, budget);
  keep(current);
  DeterministicRandom random;
  const std::size_t attempts = std::min(kSearchBudget / order.size(), kAttemptsPerPass * order.size()) / 2;
  for (std::size_t attempt = 0; attempt < attempts; ++attempt) {
    if (best.excess == 0 && best.groups == longestChain) return;
    Priorities changed = priorities;
    for (uint32_t shifts = 1 + random.below(3); shifts > 0; --shifts) {
      const uint32_t pass = order[random.below(static_cast<uint32_t>(order.size()))];
      changed[pass] += static_cast<int64_t>(random.below(6 * kStep)) - 3 * kStep;
    }
    Grouping grouping = scheduler.run(changed, budget);
    if (progress(grouping) > progress(current)) continue;
    priorities = std::move(changed);
    current = std::move(grouping);
    keep(current);
  }
}

}  // namespace

std::vector<uint32_t> groupPasses(const MemoryUse& use, std::span<const Edge> edges, std::span<const uint32_t> order,
                                  int64_t budget) {
  if (order.empty()) return {};
  const uint32_t passes = *std::max_element(order.begin(), order.end()) + 1;
  Grouping best;
  for (Direction direction : {Direction::forward, Direction::backward}) {
    GroupScheduler scheduler(use, edges, order, passes, direction);
    improve(scheduler, order, budget, best);
  }
  return std::move(best.groupOf);
}

}  // namespace lensgraph::rendergraph
