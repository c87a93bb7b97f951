// A wait stage is removable if every need it satisfies is satisfied by another stage too. Each is looked at once: what is needed now is needed all the
// more when others are gone.
#include "rendergraph/compile/sync/wait_minimizer.h"

#include <algorithm>
#include <utility>

#include "rendergraph/compile/flow/stage_masks.h"

namespace lensgraph::rendergraph {

namespace {

VkPipelineStageFlags2 flagOf(const WaitStage& stage) {
  return VkPipelineStageFlags2{1} << stage.stage;
}

bool has(const Plan& plan, const WaitStage& stage) {
  return (plan.submissionWaits[stage.wait].stages & flagOf(stage)) != 0;
}

void eraseWaitsWithoutStages(Plan& plan) {
  uint32_t kept = 0;
  for (PlannedSubmission& submission : plan.submissions) {
    const uint32_t first = kept;
    for (uint32_t wait = submission.waits.first; wait < submission.waits.first + submission.waits.count; ++wait) {
      if (plan.submissionWaits[wait].stages != 0) plan.submissionWaits[kept++] = plan.submissionWaits[wait];
    }
    submission.waits = {first, kept - first};
  }
  plan.submissionWaits.resize(kept);
}

}  // namespace

void WaitMinimizer::needOneOf(SubmissionOrder::Moment moment, std::vector<WaitStage>& stages) {
  std::sort(stages.begin(), stages.end());
  const auto end =
      std::unique(stages.begin(), stages.end(), [](const WaitStage& a, const WaitStage& b) { return a.sameAs(b); });
  // A use with several accesses asks for the same several times.
  if (!needs_.empty() && needs_.back().moment == moment &&
      std::equal(stages.begin(), end, stages_.begin() + needs_.back().first, stages_.end())) {
    return;
  }
  const auto first = static_cast<uint32_t>(stages_.size());
  stages_.insert(stages_.end(), stages.begin(), end);
  needs_.push_back({moment, first, static_cast<uint32_t>(stages_.size())});
}

void WaitMinimizer::needOrder(SubmissionOrder::Moment moment, SubmissionOrder::Moment later) {
  ordered_.push_back({moment, later});
}

void WaitMinimizer::minimize(SubmissionOrder& order, Plan& plan) const {
  takeStages(plan, LastStage::mayGo);
  takeWaits(order, plan);
  // The waits that are left have a stage in any case, which may serve for those of others.
  takeStages(plan, LastStage::stays);
  eraseWaitsWithoutStages(plan);
}

void WaitMinimizer::takeStages(Plan& plan, LastStage last) const {
  struct Service {
    WaitStage by;
    uint32_t need;
  };
  std::vector<Service> services;
  services.reserve(stages_.size());
  std::vector<uint32_t> choices(needs_.size(), 0);
  for (uint32_t need = 0; need < needs_.size(); ++need) {
    for (uint32_t i = needs_[need].first; i < needs_[need].end; ++i) {
      if (!has(plan, stages_[i])) continue;
      services.push_back({stages_[i], need});
      ++choices[need];
    }
  }
  std::sort(services.begin(), services.end(), [](const Service& a, const Service& b) { return a.by < b.by; });
  auto first = services.begin();
  for (uint32_t wait = 0; wait < plan.submissionWaits.size(); ++wait) {
    VkPipelineStageFlags2& stages = plan.submissionWaits[wait].stages;
    const VkPipelineStageFlags2 before = stages;
    forEachBit(before, [&](VkPipelineStageFlags2 flag) {
      const auto end = std::find_if(first, services.end(),
                                    [&](const Service& s) { return s.by.wait != wait || flagOf(s.by) != flag; });
      const bool needed = (last == LastStage::stays && stages == flag) ||
                          std::any_of(first, end, [&](const Service& s) { return choices[s.need] == 1; });
      if (!needed) {
        stages &= ~flag;
        std::for_each(first, end, [&](const Service& s) { --choices[s.need]; });
      }
      first = end;
    });
    if (stages == 0) stages = firstBitOf(before);  // Whether the whole wait may go is another question.
  }
}

/// A wait may be there for what it tells its queue, and those that wait for that, about other queues.
void WaitMinimizer::takeWaits(SubmissionOrder& order, Plan& plan) const {
  std::vector<uint8_t> needed(plan.submissionWaits.size(), 0);
  for (const Need& need : needs_) {
    if (const auto only = onlyWait(need, plan)) needed[*only] = 1;
  }
  for (auto wait = static_cast<uint32_t>(needed.size()); wait-- > 0;) {
    if (needed[wait] != 0) continue;
    const VkPipelineStageFlags2 stages = std::exchange(plan.submissionWaits[wait].stages, 0);
    order.update();
    if (!met(order, plan)) plan.submissionWaits[wait].stages = stages;
  }
  order.update();
}

std::optional<uint32_t> WaitMinimizer::onlyWait(const Need& need, const Plan& plan) const {
  std::optional<uint32_t> only;
  for (uint32_t i = need.first; i < need.end; ++i) {
    if (!has(plan, stages_[i])) continue;
    if (only && *only != stages_[i].wait) return std::nullopt;
    only = stages_[i].wait;
  }
  return only;
}

bool WaitMinimizer::met(const SubmissionOrder& order, const Plan& plan) const {
  const auto last = static_cast<uint32_t>(plan.submissions.size() - 1);
  for (uint32_t i = 0; i < last; ++i) {
    if (!order.covers(order.momentOf(last), order.momentOf(i))) return false;
  }
  const auto isMet = [&](const Need& need) {
    const auto first = stages_.begin() + need.first, end = stages_.begin() + need.end;
    return std::any_of(first, end, [&](const WaitStage& stage) {
      return has(plan, stage) && order.waitCovers(stage.wait, stage.inFrameBefore, need.moment);
    });
  };
  const auto isOrdered = [&](const Ordered& ordered) { return order.covers(ordered.later, ordered.moment); };
  return std::all_of(needs_.begin(), needs_.end(), isMet) && std::all_of(ordered_.begin(), ordered_.end(), isOrdered);
}

}  // namespace lensgraph::rendergraph
