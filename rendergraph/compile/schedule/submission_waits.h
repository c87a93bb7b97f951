// Finds the fewest semaphore waits that order the queues among each other. Pure.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/compile/schedule/queues.h"

namespace lensgraph::rendergraph {

struct Declaration;
struct Schedule;
class Cells;
class CellUses;

/// A step waits for a step of another queue.
struct StepWait {
  uint32_t from;  ///< Step; kNone: what the host or the previous frame did, which ends with queue 0.
  uint32_t to;    ///< Step; one past the last step: what follows the graph, on queue 0.
  VkPipelineStageFlags2 stages;
};

/// In order of the steps that wait. `sharing`: from sharingOf(), for this schedule. Precondition: the schedule uses
/// several queues.
std::vector<StepWait> findStepWaits(const Declaration& declaration, const Cells& cells, const CellUses& cellUses,
                                    std::span<const Sharing> sharing, bool overlappingFrames, const Schedule& schedule);

}  // namespace lensgraph::rendergraph
