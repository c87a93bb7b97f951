// Between two uses of a cell that must not touch, on different queues, stands a semaphore. Which of them are needed
// is found with vector clocks: for every queue, how far it knows each other queue to be. A wait is left out when the
// queue knows enough already, be it through a third queue; then only its stages are added to the wait that told it.
// Which of these nobody relies on shows when the barriers are known (wait_needs.h).
#include "rendergraph/compile/schedule/submissions.h"

#include <algorithm>
#include <numeric>

#include "rendergraph/compile/flow/cells.h"
#include "rendergraph/compile/flow/stage_masks.h"
#include "rendergraph/compile/schedule/cell_uses.h"
#include "rendergraph/compile/schedule/schedule.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

struct Dependency {
  uint32_t from = kNone;  // Step; kNone: what the host or the previous frame did, which ends with queue 0.
  uint32_t to = 0;        // Step.
  VkPipelineStageFlags2 stages = 0;
};

struct Wait {
  uint32_t from, to;
  VkPipelineStageFlags2 stages;
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
      if (to.queue != first.queue && before.layout() != after.layout() && onSeveralQueues(before)) {
        all_.push_back({schedule_.unitLast[first.step], to.step, stages});
      }
    });
  }
  static bool onSeveralQueues(const Epoch& epoch) {
    return std::any_of(epoch.uses.begin(), epoch.uses.end(),
                       [&](const CellUse& use) { return use.queue != epoch.uses.front().queue; });
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
        atStep_(static_cast<std::size_t>(schedule.steps()) * queues_, 0) {
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
      const uint32_t time = atStep_[static_cast<std::size_t>(dependency.from) * queues_ + other];
      if (other != queue && knownBy(queue, other).time < time) knownBy(queue, other) = {time, wait};
    }
  }
  void finish(uint32_t step) {
    const uint32_t queue = schedule_.queue[step];
    knownBy(queue, queue).time = timeOf(step);
    for (uint32_t other = 0; other < queues_; ++other) {
      atStep_[static_cast<std::size_t>(step) * queues_ + other] = knownBy(queue, other).time;
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
    for (Wait& wait : waits) {
      if (wait.to == schedule_.steps()) wait.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    }
  }

  std::vector<Wait> waits;

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
  std::vector<uint32_t> atStep_;
};

std::vector<Wait> findWaits(const Schedule& schedule, const std::vector<Dependency>& dependencies) {
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

/// Cuts before steps that wait and after steps that are waited for, and at host passes on every queue.
class Cutter {
 public:
  Cutter(const Declaration& declaration, const Schedule& schedule, std::span<const Wait> waits)
      : declaration_(declaration), schedule_(schedule), waits_(waits), open_(schedule.queues, kNone) {
    signals_.assign(schedule.steps(), 0);
    for (const Wait& wait : waits) {
      if (wait.from != kNone) signals_[schedule.unitLast[wait.from]] = 1;
    }
  }

  Submissions run(std::vector<uint32_t>& stepsInOrder) {
    const bool several = schedule_.severalQueues;
    if (several) begin(0);
    std::size_t wait = 0;
    for (uint32_t step = 0; step < schedule_.steps(); ++step) {
      const uint32_t queue = schedule_.queue[step];
      const bool waits = wait < waits_.size() && waits_[wait].to == step;
      if (open_[queue] == kNone || waits) begin(queue);
      members_[open_[queue]].push_back(step);
      result_.of.resize(schedule_.steps());
      result_.of[step] = open_[queue];
      for (; wait < waits_.size() && waits_[wait].to == step; ++wait) addWait(open_[queue], waits_[wait]);
      const bool host = declaration_.passes[schedule_.order[step]].kind == PassKind::host;
      if (signals_[step]) open_[queue] = kNone;
      if (host) std::fill(open_.begin(), open_.end(), kNone);
    }
    if (several || open_[0] == kNone) begin(0);
    for (; wait < waits_.size(); ++wait) addWait(open_[0], waits_[wait]);
    collect(stepsInOrder);
    return std::move(result_);
  }

 private:
  void begin(uint32_t queue) {
    open_[queue] = static_cast<uint32_t>(result_.list.size());
    result_.list.push_back({.queue = queue});
    members_.emplace_back();
    waitsOf_.emplace_back();
    // The first submission is waited for by others, and is over at once.
    if (schedule_.severalQueues && result_.list.size() == 1) open_[queue] = kNone;
  }
  void addWait(uint32_t submission, const Wait& wait) {
    const uint32_t source = wait.from == kNone ? 0 : result_.of[wait.from];
    waitsOf_[submission].push_back({.submission = source, .stages = wait.stages});
  }
  void collect(std::vector<uint32_t>& stepsInOrder) {
    for (std::size_t i = 0; i < result_.list.size(); ++i) {
      PlannedSubmission& submission = result_.list[i];
      submission.steps = {static_cast<uint32_t>(stepsInOrder.size()), static_cast<uint32_t>(members_[i].size())};
      submission.waits = {static_cast<uint32_t>(result_.waits.size()), static_cast<uint32_t>(waitsOf_[i].size())};
      stepsInOrder.insert(stepsInOrder.end(), members_[i].begin(), members_[i].end());
      result_.waits.insert(result_.waits.end(), waitsOf_[i].begin(), waitsOf_[i].end());
    }
  }

  const Declaration& declaration_;
  const Schedule& schedule_;
  std::span<const Wait> waits_;
  std::vector<uint32_t> open_;
  std::vector<uint8_t> signals_;
  Submissions result_;
  std::vector<std::vector<uint32_t>> members_;        // Steps by submission.
  std::vector<std::vector<SubmissionWait>> waitsOf_;  // By submission.
};

/// Renumbers the steps.
void reorder(const std::vector<uint32_t>& stepsInOrder, Schedule& schedule, std::vector<uint32_t>& submissionOf) {
  Schedule old = schedule;
  const std::vector<uint32_t> oldSubmissions = submissionOf;
  std::vector<uint32_t> newStep(stepsInOrder.size());
  for (uint32_t step = 0; step < stepsInOrder.size(); ++step) newStep[stepsInOrder[step]] = step;
  for (uint32_t step = 0; step < stepsInOrder.size(); ++step) {
    const uint32_t from = stepsInOrder[step];
    schedule.order[step] = old.order[from];
    schedule.queue[step] = old.queue[from];
    schedule.unitFirst[step] = newStep[old.unitFirst[from]];
    schedule.unitLast[step] = newStep[old.unitLast[from]];
    submissionOf[step] = oldSubmissions[from];
  }
}

/// For each step and each other queue: how far that queue may come before it knows of the step.
void findConcurrent(const Schedule& schedule, Submissions& submissions) {
  const uint32_t queues = schedule.queues;
  const auto count = static_cast<uint32_t>(submissions.list.size());
  // Steps of each queue that a submission knows to be over when it begins: the number of the last one, plus one.
  std::vector<uint32_t> atBegin(static_cast<std::size_t>(count) * queues, 0), atEnd = atBegin;
  std::vector<uint32_t> now(static_cast<std::size_t>(queues) * queues, 0);
  const auto raise = [](uint32_t& value, uint32_t other) { value = std::max(value, other); };
  for (uint32_t i = 0; i < count; ++i) {
    const PlannedSubmission& submission = submissions.list[i];
    uint32_t* known = &now[submission.queue * queues];
    for (uint32_t w = 0; w < submission.waits.count; ++w) {
      const uint32_t source = submissions.waits[submission.waits.first + w].submission;
      for (uint32_t queue = 0; queue < queues; ++queue) raise(known[queue], atEnd[source * queues + queue]);
    }
    std::copy_n(known, queues, &atBegin[i * queues]);
    if (submission.steps.count > 0) known[submission.queue] = submission.steps.first + submission.steps.count;
    std::copy_n(known, queues, &atEnd[i * queues]);
  }
  // Backwards: the last step of each queue's submissions that do not know of the step yet.
  for (uint32_t step = 0; step < schedule.steps(); ++step) {
    uint32_t& last = submissions.lastConcurrent[step];
    for (uint32_t i = submissions.of[step] + 1; i < count; ++i) {
      const PlannedSubmission& other = submissions.list[i];
      if (other.steps.count == 0 || other.queue == schedule.queue[step]) continue;
      if (atBegin[i * queues + schedule.queue[step]] > step) continue;
      raise(last, other.steps.first + other.steps.count - 1);
    }
  }
}

}  // namespace

Submissions planSubmissions(const Declaration& declaration, const Cells& cells, const CellUses& cellUses,
                            std::span<const Sharing> sharing, bool overlappingFrames, Schedule& schedule) {
  std::vector<Wait> waits;
  if (schedule.severalQueues) {
    Dependencies dependencies(declaration, schedule, overlappingFrames);
    for (uint32_t resource = 0; resource < declaration.resources.size(); ++resource) {
      const uint32_t first = cells.firstOf(resource);
      for (uint32_t cell = first; cell < first + cells.countOf(resource); ++cell) {
        dependencies.addCell(declaration.resources[resource], cellUses.of(cell), hasOwner(sharing[resource]));
      }
    }
    waits = findWaits(schedule, std::move(dependencies).sorted());
  }
  std::vector<uint32_t> stepsInOrder;
  Submissions result = Cutter(declaration, schedule, waits).run(stepsInOrder);
  result.of.resize(schedule.steps());
  if (schedule.severalQueues) reorder(stepsInOrder, schedule, result.of);
  result.lastConcurrent.resize(schedule.steps());
  std::iota(result.lastConcurrent.begin(), result.lastConcurrent.end(), 0u);
  if (schedule.severalQueues) findConcurrent(schedule, result);
  return result;
}

}  // namespace lensgraph::rendergraph
