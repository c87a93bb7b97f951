// List scheduling: among the passes whose predecessors are done, a policy chooses the next. Ties go to the pass
// declared first, so equal declarations give equal orders.
#include "rendergraph/compile/schedule/ordering.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>

#include "rendergraph/compile/flow/dependencies.h"
#include "rendergraph/compile/schedule/barrier_groups.h"
#include "rendergraph/compile/schedule/live_bytes.h"
#include "rendergraph/compile/schedule/ready_passes.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

/// Smallest key first; with keys of zero this is the order of declaration.
std::vector<uint32_t> byPriority(std::span<const uint8_t> alive, std::span<const Edge> edges,
                                 const std::function<uint32_t(uint32_t)>& key) {
  const auto passes = static_cast<uint32_t>(alive.size());
  ReadyPasses ready(edges, passes);
  using Entry = std::pair<uint32_t, uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> candidates;
  for (uint32_t pass = 0; pass < passes; ++pass) {
    if (alive[pass] && ready.ready(pass)) candidates.push({key(pass), pass});
  }
  std::vector<uint32_t> order;
  order.reserve(passes);
  while (!candidates.empty()) {
    const uint32_t pass = candidates.top().second;
    candidates.pop();
    order.push_back(pass);
    ready.finish(pass, [&](uint32_t next) { candidates.push({key(next), next}); });
  }
  return order;
}

std::vector<uint32_t> declaredOrder(std::span<const uint8_t> alive, std::span<const Edge> edges) {
  const bool valid = std::all_of(edges.begin(), edges.end(), [](const Edge& edge) { return edge.from < edge.to; });
  // Accesses of several passes were declared in turns.
  if (!valid) return byPriority(alive, edges, [](uint32_t) { return 0u; });
  std::vector<uint32_t> order;
  order.reserve(alive.size());
  for (uint32_t pass = 0; pass < alive.size(); ++pass) {
    if (alive[pass]) order.push_back(pass);
  }
  return order;
}

/// Longest chain of predecessors of each pass. `order` is any valid order.
std::vector<uint32_t> levels(std::span<const uint32_t> order, std::span<const Edge> edges, uint32_t passes) {
  const Adjacency successors(edges, passes, Adjacency::By::from);
  std::vector<uint32_t> level(passes, 0);
  for (uint32_t pass : order) {
    for (const Edge& edge : successors.of(pass)) level[edge.to] = std::max(level[edge.to], level[pass] + 1);
  }
  return level;
}

/// The ready pass after which the fewest bytes are alive, then the one that needs fewest meanwhile.
class GreedyMemory {
 public:
  GreedyMemory(const MemoryUse& use, std::span<const uint8_t> alive, std::span<const Edge> edges)
      : use_(use),
        ready_(edges, static_cast<uint32_t>(alive.size())),
        bytes_(use, Direction::forward),
        done_(alive.size(), 0) {
    for (uint32_t pass = 0; pass < alive.size(); ++pass) {
      if (alive[pass] && ready_.ready(pass)) push(pass);
    }
  }

  std::vector<uint32_t> order() {
    std::vector<uint32_t> order;
    while (!candidates_.empty()) {
      const uint32_t pass = candidates_.top().pass;
      candidates_.pop();
      if (done_[pass]) continue;
      done_[pass] = 1;
      order.push_back(pass);
      run(pass);
      ready_.finish(pass, [&](uint32_t next) { push(next); });
    }
    return order;
  }

 private:
  struct Entry {
    int64_t after, during;  // Bytes alive more once the pass is done, and while it runs.
    uint32_t pass;
    auto operator<=>(const Entry&) const = default;
  };

  // What a pass costs only falls, when a resource of it comes alive or it becomes the last user. A pass is
  // pushed again whenever its cost falls; stale entries are skipped when popped (done_).
  void push(uint32_t pass) {
    const int64_t added = bytes_.added(pass);
    candidates_.push({added - bytes_.freed(pass), added, pass});
  }
  void run(uint32_t pass) {
    changed_.clear();
    for (uint32_t resource : use_.ofPass(pass)) {
      if (!bytes_.started(resource) || bytes_.usesLeft(resource) == 2) changed_.push_back(resource);
    }
    bytes_.begin(pass);
    bytes_.end(pass);
    for (uint32_t resource : changed_) {
      for (uint32_t user : use_.usersOf(resource)) {
        if (!done_[user] && ready_.ready(user)) push(user);
      }
    }
  }

  const MemoryUse& use_;
  ReadyPasses ready_;
  LiveBytes bytes_;
  std::vector<uint8_t> done_;
  std::vector<uint32_t> changed_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> candidates_;
};

PassOrder inGroups(const MemoryUse& use, std::span<const Edge> edges, std::span<const uint32_t> declared,
                   double budget) {
  constexpr double kMost = 1e18;  // More than any device has, and within int64_t.
  const std::vector<uint32_t> groupOf =
      groupPasses(use, edges, declared, static_cast<int64_t>(std::clamp(budget, 0.0, kMost)));
  PassOrder order{.passes = {declared.begin(), declared.end()}, .groups = {}};
  std::stable_sort(order.passes.begin(), order.passes.end(),
                   [&](uint32_t a, uint32_t b) { return groupOf[a] < groupOf[b]; });
  order.groups.reserve(declared.size());
  for (uint32_t pass : order.passes) order.groups.push_back(groupOf[pass]);
  return order;
}

/// The best of three: greedy choices can lose against an order that a person chose well, and so can a search.
std::vector<uint32_t> leastMemory(const MemoryUse& use, std::span<const uint8_t> alive, std::span<const Edge> edges,
                                  std::vector<uint32_t> declared) {
  std::vector<uint32_t> candidates[] = {std::move(declared), GreedyMemory(use, alive, edges).order(), {}};
  candidates[2] = inGroups(use, edges, candidates[0], 0.0).passes;
  std::vector<uint32_t>* best = &candidates[0];
  int64_t bestPeak = peakBytes(use, *best);
  for (std::vector<uint32_t>& candidate : std::span(candidates).subspan(1)) {
    const int64_t peak = peakBytes(use, candidate);
    if (peak >= bestPeak) continue;
    best = &candidate;
    bestPeak = peak;
  }
  return std::move(*best);
}

}  // namespace

PassOrder orderPasses(const Declaration& declaration, std::span<const uint8_t> alive, std::span<const Edge> edges,
                      std::span<const VkDeviceSize> bytes, const CompileOptions& options) {
  std::vector<uint32_t> declared = declaredOrder(alive, edges);
  if (declared.size() < static_cast<std::size_t>(std::count(alive.begin(), alive.end(), 1))) {
    return {.passes = std::move(declared), .groups = {}};
  }
  switch (options.order) {
    case Order::declared:
      break;
    case Order::leastMemory:
      return {.passes = leastMemory(MemoryUse(declaration, alive, bytes), alive, edges, std::move(declared)),
              .groups = {}};
    case Order::mostOverlap: {
      const std::vector<uint32_t> level = levels(declared, edges, static_cast<uint32_t>(alive.size()));
      return {.passes = byPriority(alive, edges, [&](uint32_t pass) { return level[pass]; }), .groups = {}};
    }
    case Order::fewestBatches: {
      const MemoryUse use(declaration, alive, bytes);
      return inGroups(use, edges, declared, options.memoryBudget * static_cast<double>(peakBytes(use, declared)));
    }
  }
  return {.passes = std::move(declared), .groups = {}};
}

}  // namespace lensgraph::rendergraph
