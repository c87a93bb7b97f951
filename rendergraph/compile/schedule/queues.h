// Which queue every pass runs on, and who owns what is used on several. Pure.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/device_facts.h"

namespace lensgraph::rendergraph {

struct Declaration;
struct Schedule;
class Cells;
class CellUses;

/// Sets Schedule::queue, queues and severalQueues. Raster and host passes, and what prefers a queue that the device
/// does not have, run on queue 0. Precondition: the order is set.
void assignQueues(const Declaration& declaration, std::span<const QueueFacts> queues, bool useQueues,
                  Schedule& schedule);

/// How a resource passes between the queue families that use it.
enum class Sharing : uint8_t {
  none,        ///< One family uses it, or each family what it has written itself; queues of one family share freely.
  exclusive,   ///< Ownership is transferred whenever another family needs its content.
  concurrent,  ///< Several families read it at once, so it is made with VK_SHARING_MODE_CONCURRENT.
  inTurns,     ///< Exclusive even though several families read the same content: the host made it, and the graph
               ///< cannot make it anew, so the families read it one after the other.
};

/// Whether it belongs to one family at a time.
inline bool hasOwner(Sharing sharing) {
  return sharing == Sharing::exclusive || sharing == Sharing::inTurns;
}

/// By resource. Empty when all steps are on queue 0.
std::vector<Sharing> sharingOf(const Declaration& declaration, const Cells& cells, const CellUses& cellUses,
                               const Schedule& schedule, std::span<const QueueFacts> queues);

}  // namespace lensgraph::rendergraph
