// Cuts the schedule into submissions, and finds the fewest waits that order the queues among each other. Pure.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/compile/schedule/queues.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

struct Declaration;
struct Schedule;
class Cells;
class CellUses;

struct Submissions {
  std::vector<PlannedSubmission> list;
  std::vector<SubmissionWait> waits;
  std::vector<uint32_t> of;  ///< By step: its submission.
  /// By step: the last step that may run at the same time or later than it on any queue, or the step itself. What
  /// begins after it may use the memory of what ends with the step.
  std::vector<uint32_t> lastConcurrent;
};

/// Puts the steps of each submission together, which may change the schedule. `sharing`: of sharingOf(), for the
/// schedule as given; `cellUses` belongs to it too and must be made anew afterwards.
Submissions planSubmissions(const Declaration& declaration, const Cells& cells, const CellUses& cellUses,
                            std::span<const Sharing> sharing, bool overlappingFrames, Schedule& schedule);

}  // namespace lensgraph::rendergraph
