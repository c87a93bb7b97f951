// Judges plans by replaying them, whole and weakened; see the header for the model.
#include "plan_checker/plan_checker.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <sstream>
#include <utility>

#include "plan_checker/plan_replay.h"
#include "plan_checker/plan_structure.h"

namespace lensgraph::plan_checker {

using namespace rendergraph;

namespace {

using Weakening = std::pair<const char*, std::optional<ImageBarrier>>;

template <class Member>
void eachBit(std::vector<Weakening>& result, const ImageBarrier& barrier, const char* what, Member member) {
  ImageBarrier changed = barrier;
  for (uint64_t left = member(changed); left != 0; left &= left - 1) {
    changed = barrier;
    member(changed) &= ~(uint64_t{1} << std::countr_zero(left));
    result.emplace_back(what, changed);
  }
}

std::vector<Weakening> weakenings(const ImageBarrier& barrier, bool image) {
  std::vector<Weakening> result;
  result.emplace_back("without it", std::nullopt);
  eachBit(result, barrier, "without one source stage", [](ImageBarrier& b) -> uint64_t& { return b.from.stages; });
  eachBit(result, barrier, "without one source access", [](ImageBarrier& b) -> uint64_t& { return b.from.access; });
  eachBit(result, barrier, "without one target stage", [](ImageBarrier& b) -> uint64_t& { return b.to.stages; });
  eachBit(result, barrier, "without one target access", [](ImageBarrier& b) -> uint64_t& { return b.to.access; });
  if (!image) return result;
  ImageBarrier changed = barrier;
  if (barrier.range.mipCount > 1) {
    --changed.range.mipCount;
    result.emplace_back("without its last mip", changed);
  }
  changed = barrier;
  if (barrier.range.layerCount > 1) {
    --changed.range.layerCount;
    result.emplace_back("without its last layer", changed);
  }
  changed = barrier;
  changed.newLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
  result.emplace_back("with another new layout", changed);
  changed = barrier;
  if (barrier.oldLayout != VK_IMAGE_LAYOUT_UNDEFINED && barrier.oldLayout != barrier.newLayout) {
    std::swap(changed.oldLayout, changed.newLayout);
    result.emplace_back("with its layouts swapped", changed);
  }
  changed = barrier;
  changed.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  // Without a change of layout the content may be dropped or not; keeping it costs nothing.
  if (barrier.oldLayout != VK_IMAGE_LAYOUT_UNDEFINED && barrier.oldLayout != barrier.newLayout) {
    result.emplace_back("dropping the content", changed);
  }
  return result;
}

class Search {
 public:
  explicit Search(const Setting& setting) : setting_(setting), replay_(setting) { replay_.run(); }

  Superfluous run() {
    for (uint32_t i = 0; i < setting_.declaration.resources.size(); ++i) {
      weakenBarriers(i);
      weakenAttachments(i);
      if (replay_.of(i).concurrent()) attempt(i, {.exclusive = true}, "concurrent sharing", "without it");
    }
    weakenWaits();
    return std::move(result_);
  }

 private:
  void attempt(uint32_t resource, const Change& change, const std::string& of, const char* what) {
    ++result_.attempts;
    if (!replay_.holds(resource, change)) return;
    const std::string name(setting_.declaration.resources[resource].name);
    result_.findings.push_back(of + " of '" + name + "': nothing is missing " + what);
  }

  void weakenBarriers(uint32_t resource) {
    const bool image = setting_.declaration.resources[resource].isImage;
    const std::vector<Placed>& barriers = replay_.of(resource).barriers();
    for (uint32_t i = 0; i < barriers.size(); ++i) {
      for (const auto& [what, changed] : weakenings(barriers[i].barrier, image)) {
        const char* kind = barriers[i].setKey != 0 ? "event before step " : "barrier before step ";
        attempt(resource, {.placed = i, .barrier = changed ? &*changed : nullptr},
                kind + std::to_string(barriers[i].step), what);
      }
    }
  }

  void weakenAttachments(uint32_t resource) {
    for (const auto& [attachment, load] : replay_.of(resource).operations()) {
      attempt(resource, {.attachment = attachment, .load = load},
              (load ? "load operation " : "store operation ") + std::to_string(attachment), "with DONT_CARE");
    }
  }

  /// The wait without each of its stages; ALL_COMMANDS counts as every stage of the queue.
  void weakenWaits() {
    const std::vector<Wait> waits = replay_.order().semaphores();
    for (std::size_t i = 0; i < waits.size(); ++i) {
      std::vector<Wait> without = waits;
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(i));
      tryWaits(waits[i], without, "without it");
      const bool all = (waits[i].stages & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) != 0;
      // The last submission stands for the end of the frame: it waits for everything, at whatever stage.
      if (all && waits[i].submission + 1 == setting_.plan.submissions.size()) continue;
      const uint32_t queue = replay_.order().queueOf(waits[i].submission);
      const VkPipelineStageFlags2 stages =
          all ? stageFlags(stagesOf(setting_.device.queues()[queue]) & kDeviceStages) : waits[i].stages;
      for (uint64_t left = stages; left != 0 && !std::has_single_bit(stages); left &= left - 1) {
        std::vector<Wait> changed = waits;
        changed[i].stages = stages & ~(uint64_t{1} << std::countr_zero(left));
        tryWaits(waits[i], changed, "without one stage");
      }
    }
  }

  void tryWaits(const Wait& wait, const std::vector<Wait>& changed, const char* what) {
    ++result_.attempts;
    if (!replay_.holds(changed, wait.submission)) return;
    std::ostringstream text;
    text << "wait of submission " << wait.submission << " for " << wait.target << ": nothing is missing " << what;
    result_.findings.push_back(text.str());
  }

  const Setting& setting_;
  PlanReplay replay_;
  Superfluous result_;
};

/// A place where barriers can stand.
struct Place {
  uint32_t key, submission;
};

/// By queue, in order. Before a step that continues a rendering there is none.
std::vector<std::vector<Place>> placesOf(const Setting& setting, const PlanOrder& order) {
  std::vector<std::vector<Place>> places(kMaxQueues);
  const Plan& plan = setting.plan;
  for (uint32_t i = 0; i < plan.submissions.size(); ++i) {
    const PlannedSubmission& submission = plan.submissions[i];
    for (uint32_t step = submission.steps.first; step < submission.steps.first + submission.steps.count; ++step) {
      if (!plan.passes[step].continuesRendering) places[submission.queue].push_back({order.keysOf(step).before, i});
    }
    places[submission.queue].push_back({order.keyAtEnd(i), i});
  }
  return places;
}

/// The fewest places that meet all the ranges (first and last index).
uint32_t fewestPlaces(std::vector<std::pair<uint32_t, uint32_t>> ranges) {
  std::sort(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  uint32_t count = 0;
  std::optional<uint32_t> last;
  for (const auto& [first, end] : ranges) {
    if (last && *last >= first) continue;
    last = end;
    ++count;
  }
  return count;
}

}  // namespace

std::vector<Finding> findMissing(const Setting& setting) {
  std::vector<Finding> findings = checkStructure(setting);
  if (!findings.empty()) return findings;
  findings = checkMemory(setting);
  if (!findings.empty()) return findings;
  return PlanReplay(setting).run();
}

Superfluous findSuperfluous(const Setting& setting) {
  return Search(setting).run();
}

uint32_t fewestBatches(const Setting& setting) {
  PlanReplay replay(setting);
  replay.run();
  const std::vector<std::vector<Place>> places = placesOf(setting, replay.order());
  std::vector<std::vector<std::pair<uint32_t, uint32_t>>> ranges(places.size());
  for (uint32_t resource = 0; resource < setting.declaration.resources.size(); ++resource) {
    ResourceReplay& one = replay.of(resource);
    for (uint32_t i = 0; i < one.barriers().size(); ++i) {
      const Placed original = one.barriers()[i];
      if (original.setKey != 0) continue;
      const std::vector<Place>& own = places[original.queue];
      const auto at = std::find_if(own.begin(), own.end(), [&](const Place& p) { return p.key == original.key; });
      const auto holdsAt = [&](const Place& place) {
        Placed moved = original;
        moved.key = place.key;
        moved.submission = place.submission;
        one.replaceBarrier(i, moved);
        return replay.holds(resource, {});
      };
      auto first = at, last = at;
      while (first != own.begin() && holdsAt(*(first - 1))) --first;
      while (last + 1 != own.end() && holdsAt(*(last + 1))) ++last;
      one.replaceBarrier(i, original);
      ranges[original.queue].emplace_back(first - own.begin(), last - own.begin());
    }
  }
  auto count = static_cast<uint32_t>(setting.plan.events.size());
  for (const auto& some : ranges) count += fewestPlaces(some);
  return count;
}

}  // namespace lensgraph::plan_checker
