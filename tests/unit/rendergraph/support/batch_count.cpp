// Interval stabbing: every barrier has a window of places, and the fewest batches are the fewest points that hit all windows.
#include "support/batch_count.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace lensgraph {

using namespace rendergraph;

namespace {

/// Places where one barrier may stand: before steps `first` to `last`; the number of steps is the end of the plan.
struct Window {
  uint32_t first, last;
};

struct Use {
  uint32_t step;
  bool writes;
  Usage usage;
};

std::vector<std::vector<Use>> usesByResource(const Declaration& declaration, const Plan& plan) {
  std::vector<std::vector<Use>> uses(declaration.resources.size());
  for (uint32_t step = 0; step < plan.passes.size(); ++step) {
    for (const DeclaredAccess& access : declaration.accessesOfPass(plan.passes[step].pass)) {
      uses[access.resource].push_back({step, access.writes(), access.usage});
    }
  }
  return uses;
}

/// The step after the last use of whatever had any byte of this placement before.
uint32_t freeSince(const Plan& plan, const Placement& placement) {
  uint32_t since = 0;
  for (const Placement& other : plan.placements) {
    const bool shares = other.heap == placement.heap && other.offset < placement.offset + placement.size &&
                        placement.offset < other.offset + other.size;
    if (shares && other.lastStep < placement.firstStep) since = std::max(since, other.lastStep + 1);
  }
  return since;
}

}  // namespace

uint32_t fewestBatches(const Declaration& declaration, const Plan& plan) {
  const auto uses = usesByResource(declaration, plan);
  const auto end = static_cast<uint32_t>(plan.passes.size());
  std::vector<Window> windows;
  for (const Placement& placement : plan.placements) {
    windows.push_back({freeSince(plan, placement), placement.firstStep});
  }
  for (uint32_t resource = 0; resource < uses.size(); ++resource) {
    const std::vector<Use>& own = uses[resource];
    for (std::size_t i = 1; i < own.size(); ++i) {
      const bool sameReads = !own[i].writes && !own[i - 1].writes && own[i].usage == own[i - 1].usage;
      if (own[i].step != own[i - 1].step && !sameReads) windows.push_back({own[i - 1].step + 1, own[i].step});
    }
    if (!own.empty() && declaration.resources[resource].exported) windows.push_back({own.back().step + 1, end});
  }
  // Windows by their ends; each that holds no batch yet gets one at its end.
  std::sort(windows.begin(), windows.end(), [](const Window& a, const Window& b) { return a.last < b.last; });
  uint32_t batches = 0, latest = 0;
  for (const Window& window : windows) {
    if (batches > 0 && latest >= window.first) continue;
    latest = window.last;
    ++batches;
  }
  return batches;
}

}  // namespace lensgraph
