// List scheduling: among the passes whose predecessors are done, a policy chooses the next. Ties go to the pass
// declared first, so equal declarations give equal orders.
#include "rendergraph/ordering.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>

#include "rendergraph/declaration.h"
#include "rendergraph/dependencies.h"

namespace rendergraph {

namespace {

/// Distinct resources of every pass that cost memory.
class PassMemory {
 public:
  PassMemory(const Declaration& declaration, std::span<const uint8_t> alive, std::span<const VkDeviceSize> bytes)
      : bytes_(bytes), uses_(bytes.size(), 0), started_(bytes.size(), 0) {
    std::vector<uint32_t> lastSeen(bytes.size(), kNone);
    starts_.push_back(0);
    for (uint32_t pass = 0; pass < declaration.passes.size(); ++pass) {
      if (alive[pass]) {
        for (const DeclaredAccess& access : declaration.accessesOfPass(pass)) {
          if (bytes[access.resource] == 0 || lastSeen[access.resource] == pass) continue;
          lastSeen[access.resource] = pass;
          resources_.push_back(access.resource);
          ++uses_[access.resource];
        }
      }
      starts_.push_back(static_cast<uint32_t>(resources_.size()));
    }
    // What leaves the graph stays until the end.
    for (uint32_t resource = 0; resource < bytes.size(); ++resource) {
      if (declaration.resources[resource].exported) ++uses_[resource];
    }
  }

  struct Change {
    int64_t after = 0;   // Bytes alive more (or fewer) once the pass is done.
    int64_t during = 0;  // Bytes alive more while it runs.
    auto operator<=>(const Change&) const = default;
  };
  Change changeBy(uint32_t pass) const {
    Change change;
    for (uint32_t resource : of(pass)) {
      const auto size = static_cast<int64_t>(bytes_[resource]);
      if (!started_[resource]) change.during += size;
      if (uses_[resource] == 1) change.after -= size;
    }
    change.after += change.during;
    return change;
  }
  void run(uint32_t pass) {
    for (uint32_t resource : of(pass)) {
      started_[resource] = 1;
      --uses_[resource];
    }
  }

 private:
  std::span<const uint32_t> of(uint32_t pass) const {
    return {resources_.data() + starts_[pass], resources_.data() + starts_[pass + 1]};
  }
  std::span<const VkDeviceSize> bytes_;
  std::vector<uint32_t> uses_;  // Remaining.
  std::vector<uint8_t> started_;
  std::vector<uint32_t> starts_, resources_;
};

/// Predecessor counting shared by the policies.
class Waiting {
 public:
  Waiting(std::span<const Edge> edges, uint32_t passes)
      : successors_(edges, passes, Adjacency::By::from), open_(passes, 0) {
    for (const Edge& edge : edges) ++open_[edge.to];
  }
  bool ready(uint32_t pass) const { return open_[pass] == 0; }
  /// Calls use(pass) for every pass that becomes ready because this one is done.
  template <class Use>
  void finish(uint32_t pass, Use&& use) {
    for (const Edge& edge : successors_.of(pass)) {
      if (--open_[edge.to] == 0) use(edge.to);
    }
  }
  const Adjacency& successors() const { return successors_; }

 private:
  Adjacency successors_;
  std::vector<uint32_t> open_;
};

/// Smallest key first; with keys of zero this is the order of declaration.
std::vector<uint32_t> byPriority(std::span<const uint8_t> alive, std::span<const Edge> edges,
                                 const std::function<uint32_t(uint32_t)>& key) {
  const auto passes = static_cast<uint32_t>(alive.size());
  Waiting waiting(edges, passes);
  using Entry = std::pair<uint32_t, uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> ready;
  for (uint32_t pass = 0; pass < passes; ++pass) {
    if (alive[pass] && waiting.ready(pass)) ready.push({key(pass), pass});
  }
  std::vector<uint32_t> order;
  order.reserve(passes);
  while (!ready.empty()) {
    const uint32_t pass = ready.top().second;
    ready.pop();
    order.push_back(pass);
    waiting.finish(pass, [&](uint32_t next) { ready.push({key(next), next}); });
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

std::vector<uint32_t> greedyMemory(const Declaration& declaration, std::span<const uint8_t> alive,
                                   std::span<const Edge> edges, std::span<const VkDeviceSize> bytes) {
  const auto passes = static_cast<uint32_t>(alive.size());
  Waiting waiting(edges, passes);
  PassMemory memory(declaration, alive, bytes);
  std::vector<uint32_t> ready, order;
  for (uint32_t pass = 0; pass < passes; ++pass) {
    if (alive[pass] && waiting.ready(pass)) ready.push_back(pass);
  }
  while (!ready.empty()) {
    const auto best = std::min_element(ready.begin(), ready.end(), [&](uint32_t a, uint32_t b) {
      return std::tuple(memory.changeBy(a), a) < std::tuple(memory.changeBy(b), b);
    });
    const uint32_t pass = *best;
    ready.erase(best);
    memory.run(pass);
    order.push_back(pass);
    waiting.finish(pass, [&](uint32_t next) { ready.push_back(next); });
  }
  return order;
}

int64_t peakOf(const Declaration& declaration, std::span<const uint8_t> alive, std::span<const uint32_t> order,
               std::span<const VkDeviceSize> bytes) {
  PassMemory memory(declaration, alive, bytes);
  int64_t live = 0, peak = 0;
  for (uint32_t pass : order) {
    const PassMemory::Change change = memory.changeBy(pass);
    peak = std::max(peak, live + change.during);
    live += change.after;
    memory.run(pass);
  }
  return peak;
}

}  // namespace

std::vector<uint32_t> orderPasses(const Declaration& declaration, std::span<const uint8_t> alive,
                                  std::span<const Edge> edges, std::span<const VkDeviceSize> bytes, Order policy) {
  std::vector<uint32_t> declared = byPriority(alive, edges, [](uint32_t) { return 0u; });
  switch (policy) {
    case Order::declared:
      break;
    case Order::leastMemory: {
      // Greedy choices can lose against an order that a person chose well.
      std::vector<uint32_t> greedy = greedyMemory(declaration, alive, edges, bytes);
      if (peakOf(declaration, alive, greedy, bytes) < peakOf(declaration, alive, declared, bytes)) return greedy;
      break;
    }
    case Order::mostOverlap: {
      const std::vector<uint32_t> level = levels(declared, edges, static_cast<uint32_t>(alive.size()));
      return byPriority(alive, edges, [&](uint32_t pass) { return level[pass]; });
    }
  }
  return declared;
}

}  // namespace rendergraph
