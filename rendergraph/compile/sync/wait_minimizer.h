// Which stages of which semaphore waits the barriers and uses of a plan rely on. Those that nothing relies on are taken
// away. Pure.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "rendergraph/compile/schedule/submission_order.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

/// One stage of one wait.
struct WaitStage {
  uint32_t wait = 0;           ///< Index in Plan::submissionWaits.
  uint32_t stage = 0;          ///< Number of the bit.
  bool inFrameBefore = false;  ///< The wait of the frame before; it has the same stages.
  auto operator<=>(const WaitStage&) const = default;
  bool sameAs(const WaitStage& other) const { return wait == other.wait && stage == other.stage; }
};

class WaitMinimizer {
 public:
  /// Something relies on one of the stages to have waited for the moment, no matter which.
  void needOneOf(SubmissionOrder::Moment moment, std::vector<WaitStage>& stages);
  /// Something relies on the order of two moments, through whatever waits.
  void needOrder(SubmissionOrder::Moment moment, SubmissionOrder::Moment later);

  /// `order` is that of the plan. The waits of the last submission stay: they stand for the end of the frame.
  void minimize(SubmissionOrder& order, Plan& plan) const;

 private:
  struct Need {
    SubmissionOrder::Moment moment;
    uint32_t first, end;  // Of stages_.
  };
  struct Ordered {
    SubmissionOrder::Moment moment, later;
  };
  /// Whether the last stage of a wait may be removed, which removes the wait, or stays.
  enum class LastStage { mayGo, stays };
  void takeStages(Plan& plan, LastStage last) const;
  void takeWaits(SubmissionOrder& order, Plan& plan) const;
  std::optional<uint32_t> onlyWait(const Need& need, const Plan& plan) const;
  bool met(const SubmissionOrder& order, const Plan& plan) const;

  std::vector<WaitStage> stages_;
  std::vector<Need> needs_;
  std::vector<Ordered> ordered_;
};

}  // namespace lensgraph::rendergraph
