// Two conflicting uses of a cell on different queues need a semaphore between them. Which semaphores are needed is found
// with vector clocks: for every queue, the latest step of each other queue that it has waited for. A wait is left out when
// the queue has waited far enough already, be it through a third queue; then only its stages are added to that earlier
// wait. Which stages nothing relies on shows when the barriers are known (compile/sync/wait_minimizer.h).
#include "rendergraph/compile/schedule/submission_waits.h"

#include <algorithm>
#include <utility>

#include "rendergraph/compile/flow/cells.h"
#include "rendergraph/compile/flow/stage_masks.h"
#include "rendergraph/compile/schedule/cell_uses.h"
#include "rendergraph/compile/schedule/schedule.h"
#include "rendergraph/compile/schedule/vector_clocks.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

struct Dependency {
  uint32_t from = kNone;  // Step; kNone: what the host or the previous frame did, which ends with queue 0.
  uint32_t to = 0;        // Step.
  VkPipelineStageFlags2 stages = 0;
};

class Dependencies {
 public:
  Dependencies(const Declaration& declaration, const Schedule& schedule, bool overlappingFrames)
      : declaration_(declaration), schedule_(schedule), overlappingFrames_(overlappingFrames) {}

  void addCell(const DeclaredResource& resource, std::span<const CellUse> inGraph, bool oneOwner) {
    if (inGraph.empty()) return;
    uses_.assign(inGraph.begin(), inGraph.end());
    const VkImageLayout before = resource.persistent() ? restStateOf(resource).layout : resource.before.layout;
    if (const auto after = useAfterGraph(resource, inGraph, before, schedule_.steps(), overlappingFrames_))
      uses_.push_back(*after);
    const std::span<const CellUse> uses = uses_;
    Epoch previous;
    for (std::size_t first = 0; first < uses.size();) {
      const Epoch epoch = epochAt(uses, first, oneOwner);
      if (first == 0) {
        if (needsBefore(resource, epoch)) addFromBefore(epoch);
      } else {
        connect(previous, epoch);
      }
      previous = epoch;
      first += epoch.uses.size();
    }
  }

  /// Sorted by the step that waits, the latest cause first.
  std::vector<Dependency> sorted() && {
    std::sort(all_.begin(), all_.end(), [](const Dependency& a, const Dependency& b) {
      const uint32_t fromA = a.from + 1, fromB = b.from + 1;  // kNone becomes 0.
      return a.to != b.to ? a.to < b.to : fromA > fromB;
    });
    return std::move(all_);
  }

 private:
  bool isHost(uint32_t step) const { return declaration_.passes[schedule_.order[step]].kind == PassKind::host; }
  /// Whether the first use relies on what queue 0 did before. The host has waited unless frames overlap.
  bool needsBefore(const DeclaredResource& resource, const Epoch& epoch) const {
    if (overlappingFrames_) return true;
    if (resource.created()) return false;
    return epoch.needsContent() || (resource.imported() && resource.before.stages != 0);
  }
  void addFromBefore(const Epoch& epoch) {
    forFirstOnEachQueue(epoch, [&](const CellUse& use) {
      if (use.queue != 0) all_.push_back({kNone, use.step, semaphoreStages(partOf(epoch, use.queue).stages)});
    });
  }
  void connect(const Epoch& before, const Epoch& after) {
    forFirstOnEachQueue(after, [&](const CellUse& to) {
      const VkPipelineStageFlags2 stages = semaphoreStages(partOf(after, to.queue).stages);
      forLastOnEachQueue(before, [&](const CellUse& from) {
        // What the host wrote is visible to all that is submitted later.
        if (from.queue == to.queue || (from.writes && isHost(from.step))) return;
        all_.push_back({schedule_.unitLast[from.step], to.step, stages});
      });
      // The first of several readers on different queues changes the layout when several had it before.
      const CellUse& first = after.uses.front();
      if (to.queue != first.queue && before.layout() != after.layout() && before.onSeveralQueues()) {
        all_.push_back({schedule_.unitLast[first.step], to.step, stages});
      }
    });
  }
  template <class Use>
  static void forFirstOnEachQueue(const Epoch& epoch, Use&& use) {
    for (std::size_t i = 0; i < epoch.uses.size(); ++i) {
      const auto earlier = epoch.uses.first(i);
      const bool seen = std::any_of(earlier.begin(), earlier.end(),
                                    [&](const CellUse& other) { return other.queue == epoch.uses[i].queue; });
      if (!seen) use(epoch.uses[i]);
    }
  }
  template <class Use>
  static void forLastOnEachQueue(const Epoch& epoch, Use&& use) {
    for (std::size_t i = 0; i < epoch.uses.size(); ++i) {
      const auto later = epoch.uses.subspan(i + 1);
      const bool seen = std::any_of(later.begin(), later.end(),
                                    [&](const CellUse& other) { return other.queue == epoch.uses[i].queue; });
      if (!seen) use(epoch.uses[i]);
    }
  }

  const Declaration& declaration_;
  const Schedule& schedule_;
  bool overlappingFrames_;
  std::vector<Dependency> all_;
  std::vector<CellUse> uses_;  // Of the current cell.
};

/// Vector clocks. A time is a number of steps of a queue's future: step + 2, where 1 stands for kNone.
class Clocks {
 public:
  explicit Clocks(const Schedule& schedule)
      : schedule_(schedule),
        queues_(schedule.queues),
        known_(queues_ * queues_, Known{}),
        atStep_(schedule.steps(), queues_) {
    known_[0].time = timeOf(kNone);  // Queue 0 itself comes after it.
  }

  /// One past the last step stands for what follows the graph, on queue 0.
  void wait(const Dependency& dependency) {
    const uint32_t queue = dependency.to < schedule_.steps() ? schedule_.queue[dependency.to] : 0;
    const uint32_t source = dependency.from == kNone ? 0 : schedule_.queue[dependency.from];
    Known& known = knownBy(queue, source);
    if (known.time >= timeOf(dependency.from)) {
      waits[known.wait].stages |= dependency.stages;
      return;
    }
    const auto wait = static_cast<uint32_t>(waits.size());
    waits.push_back({dependency.from, dependency.to, dependency.stages});
    known = {timeOf(dependency.from), wait};
    if (dependency.from == kNone) return;
    for (uint32_t other = 0; other < queues_; ++other) {
      const uint32_t time = atStep_.of(dependency.from, other);
      if (other != queue && knownBy(queue, other).time < time) knownBy(queue, other) = {time, wait};
    }
  }
  void finish(uint32_t step) {
    const uint32_t queue = schedule_.queue[step];
    knownBy(queue, queue).time = timeOf(step);
    for (uint32_t other = 0; other < queues_; ++other) {
      atStep_.of(step, other) = knownBy(queue, other).time;
    }
  }

  /// Makes what follows the graph wait for every queue.
  void waitForAll() {
    std::vector<Dependency> last;
    for (uint32_t step = schedule_.steps(); step-- > 0;) {
      const uint32_t queue = schedule_.queue[step];
      const bool found =
          std::any_of(last.begin(), last.end(), [&](const Dependency& d) { return schedule_.queue[d.from] == queue; });
      if (queue != 0 && !found) last.push_back({step, schedule_.steps(), 0});
    }
    for (const Dependency& dependency : last) wait(dependency);
    for (StepWait& wait : waits) {
      if (wait.to == schedule_.steps()) wait.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    }
  }

  std::vector<StepWait> waits;

 private:
  struct Known {
    uint32_t time = 0;
    uint32_t wait = 0;  // That told it.
  };
  static uint32_t timeOf(uint32_t step) { return step == kNone ? 1 : step + 2; }
  Known& knownBy(uint32_t queue, uint32_t other) { return known_[queue * queues_ + other]; }

  const Schedule& schedule_;
  uint32_t queues_;
  std::vector<Known> known_;
  VectorClocks atStep_;  // What the queue of each step knew when the step was done.
};

std::vector<StepWait> fewestWaits(const Schedule& schedule, const std::vector<Dependency>& dependencies) {
  Clocks clocks(schedule);
  auto next = dependencies.begin();
  for (uint32_t step = 0; step < schedule.steps(); ++step) {
    for (; next != dependencies.end() && next->to == step; ++next) clocks.wait(*next);
    clocks.finish(step);
  }
  for (; next != dependencies.end(); ++next) clocks.wait(*next);
  clocks.waitForAll();
  return std::move(clocks.waits);
}

}  // namespace

std::vector<StepWait> findStepWaits(const Declaration& declaration, const Cells& cells, const CellUses& cellUses,
                                    std::span<const Sharing> sharing, bool overlappingFrames,
                                    const Schedule& schedule) {
  Dependencies dependencies(declaration, schedule, overlappingFrames);
  for (uint32_t resource = 0; resource < declaration.resources.size(); ++resource) {
    for (uint32_t cell : cells.of(resource)) {
      dependencies.addCell(declaration.resources[resource], cellUses.of(cell), hasOwner(sharing[resource]));
    }
  }
  return fewestWaits(schedule, std::move(dependencies).sorted());
}

}  // namespace lensgraph::rendergraph
