// Ranks the queues of the device for each preference, and follows every cell from queue family to queue family to see
// whether its content changes hands.
#include "rendergraph/compile/schedule/queues.h"

#include "rendergraph/compile/flow/cells.h"
#include "rendergraph/compile/schedule/cell_uses.h"
#include "rendergraph/compile/schedule/schedule.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

/// The queue for a preference: one that does not also do what it is meant to relieve, else any other able one.
uint32_t queueFor(QueuePreference preference, std::span<const QueueFacts> queues) {
  uint32_t best = 0;
  const auto rank = [&](const QueueFacts& queue) {
    switch (preference) {
      case QueuePreference::graphics:
        return 0;
      case QueuePreference::asyncCompute:
        return !queue.compute ? 0 : queue.graphics ? 1 : 2;
      case QueuePreference::transfer:
        return queue.graphics ? 1 : queue.compute ? 2 : 3;
    }
    return 0;
  };
  int bestRank = 0;
  for (uint32_t queue = 1; queue < queues.size(); ++queue) {
    if (rank(queues[queue]) <= bestRank) continue;
    bestRank = rank(queues[queue]);
    best = queue;
  }
  return best;
}

bool canRunOn(const DeclaredPass& pass, const QueueFacts& queue) {
  switch (pass.kind) {
    case PassKind::raster:
      return queue.graphics;
    case PassKind::compute:
      return queue.compute;
    case PassKind::transfer:
      return true;
    case PassKind::host:
      return false;  // Belongs to no queue; its barriers are on the first.
  }
  return false;
}

/// Whether, without any transfer of ownership, a family would use what another one owns. A family takes over what
/// nobody owns, and what it replaces: a buffer, or an image whose layout changes on the way.
bool contentChangesFamily(const DeclaredResource& resource, std::span<const CellUse> uses,
                          std::span<const QueueFacts> queues) {
  const uint32_t outside = resource.observable() ? queues[0].family : kNone;
  uint32_t owner = outside;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if ((uses[i].stages & VK_PIPELINE_STAGE_2_HOST_BIT) != 0) continue;  // The host owns nothing, and asks nobody.
    const bool sameLayout = resource.isImage && i > 0 && uses[i - 1].layout == uses[i].layout;
    const bool takesOver = owner == kNone || (uses[i].writes && !uses[i].needsContent && !sameLayout);
    if (takesOver) owner = queues[uses[i].queue].family;
    if (owner != queues[uses[i].queue].family) return true;
  }
  return outside != kNone && owner != outside;
}

}  // namespace

void assignQueues(const Declaration& declaration, std::span<const QueueFacts> queues, bool useQueues,
                  Schedule& schedule) {
  schedule.queue.assign(schedule.order.size(), 0);
  schedule.queues = static_cast<uint32_t>(queues.size());
  if (!useQueues || queues.size() < 2) return;
  const uint32_t byPreference[] = {0, queueFor(QueuePreference::asyncCompute, queues),
                                   queueFor(QueuePreference::transfer, queues)};
  for (uint32_t step = 0; step < schedule.steps(); ++step) {
    const DeclaredPass& pass = declaration.passes[schedule.order[step]];
    const uint32_t queue = byPreference[static_cast<std::size_t>(pass.queue)];
    if (queue == 0 || !canRunOn(pass, queues[queue])) continue;
    schedule.queue[step] = queue;
    schedule.severalQueues = true;
  }
}

std::vector<Sharing> sharingOf(const Declaration& declaration, const Cells& cells, const CellUses& cellUses,
                               const Schedule& schedule, std::span<const QueueFacts> queues) {
  std::vector<Sharing> result;
  if (!schedule.severalQueues) return result;
  result.assign(declaration.resources.size(), Sharing::none);
  for (uint32_t resource = 0; resource < declaration.resources.size(); ++resource) {
    const DeclaredResource& declared = declaration.resources[resource];
    bool severalFamilies = false, severalAtOnce = false, changesFamily = false;
    uint32_t family = declared.observable() ? queues[0].family : kNone;
    for (uint32_t cell : cells.of(resource)) {
      const std::span<const CellUse> uses = cellUses.of(cell);
      changesFamily = changesFamily || contentChangesFamily(declared, uses, queues);
      for (std::size_t first = 0; first < uses.size();) {
        const Epoch epoch = epochAt(uses, first);
        for (const CellUse& use : epoch.uses) {
          if (family == kNone) family = queues[use.queue].family;
          severalFamilies = severalFamilies || queues[use.queue].family != family;
          // The host is no queue that could own it in between.
          const bool host = (use.stages & VK_PIPELINE_STAGE_2_HOST_BIT) != 0;
          severalAtOnce = severalAtOnce || host || use.queue != epoch.uses.front().queue;
        }
        first += epoch.uses.size();
      }
    }
    if (!severalFamilies) continue;
    result[resource] = !severalAtOnce        ? Sharing::exclusive
                       : !changesFamily      ? Sharing::none
                       : declared.imported() ? Sharing::inTurns
                                             : Sharing::concurrent;
  }
  return result;
}

}  // namespace lensgraph::rendergraph
