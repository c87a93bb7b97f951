// An independent judge of plans: its own model of Vulkan's memory dependencies, its own table of what each usage
// touches, sharing no code with the planner.
//
// Uses. Every use of a subresource leaves one record per pipeline stage. A record knows, for each queue, the stages
// that are ordered after it, whether what it wrote is available, and to which (queue, stage, access) it is visible.
// Then a use is right when
//   – a read has every write before it ordered, available and visible to each of its stages and accesses;
//   – a write has everything before it ordered, writes available too; a write that nobody has read yet must also be
//     visible to it (write after write), while one that a read has seen needs order alone (write after read);
//   – the subresource is in the layout that the use needs, and content that is needed was not dropped;
//   – a layout transition, being a write of its own, has everything before it in the first scope of its barrier.
// All stages in which a writing pass touches a subresource count as part of its write. The plan's list is one possible
// order of events; two uses that only the list orders are a hazard, because nothing is ordered between the queues.
//
// Barriers. A barrier takes records into its first scope by their own stage, when they are of its queue, or through a
// chain (a stage of its queue that is already ordered after them), and passes its second scope on to them. Barriers
// act on their own resource alone, as in the validation layers, and not on each other within one batch. Stages are
// taken as they are named; the logically earlier and later ones are not added. An event's first scope is closed where
// it is set: what comes between that and the wait is not in it.
//
// Semaphores. The signal at the end of a submission covers all that its queue was given before and what that has
// waited for, and makes its writes available. The wait orders it before the named stages of the waiting submission
// and of all later ones on that queue, and makes it visible to them; barriers may chain from there. What was written
// is available where it is known to be: on the queue that waits, or behind the barrier that made it so.
//
// Host. The submission of a host pass is waited for: all that it covers comes before the host and before whatever
// follows in the list, and its writes are available. What the host reads needs a barrier to its stage; what it writes
// before a submission is visible to the device, and to itself.
//
// Queue families. An exclusive resource belongs to one family. Another one may use it after a release, in a barrier
// of the owner's queue, and a matching acquire (same layouts and range) that is ordered after it; or by dropping the
// content: with a transition from UNDEFINED, or, of a buffer, by replacing all of it. A transition needs ownership,
// and so does a use, save by the host. Imported and persistent resources belong to the family of queue 0 before and
// after the graph.
//
// Attachments. Steps that share a rendering access its attachments in rasterization order; all else in there needs a
// dependency, for which there is no place. The load operation of the first and the store operation of the last one
// count: what is declared is loaded or cleared, what is not stored is lost.
//
// Memory. A resource that takes over memory inherits the records of everything that had any of its bytes before.
// With overlapping frames the plan is replayed twice, and the memory's first users in the second frame inherit what
// the first one left. Retained resources rest on queue 0: whatever follows there is ordered after the frame before;
// without overlap the host has waited. Exported ones were used by the host as declared; imported ones are in the state
// that they were imported in. Host states before and after the graph are uses on queue 0 like any other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/plan.h"

namespace lensgraph::plan_checker {

/// A plan and what it was made from.
struct Setting {
  const rendergraph::Declaration& declaration;
  const rendergraph::Plan& plan;
  const rendergraph::CompileOptions& options;
  const rendergraph::DeviceFacts& device;
};

enum class Hazard {
  readAfterWrite,
  writeAfterRead,
  writeAfterWrite,
  layout,
  alias,
  lostContent,
  ownership,
  structure,  ///< The plan breaks a rule of plan.h, or of Vulkan's commands.
  memory,     ///< Heaps, placements or the memory report are wrong.
};

struct Finding {
  Hazard hazard;
  std::string text;
};

/// What the plan lacks or breaks. When its structure is broken, nothing else is looked at.
std::vector<Finding> findMissing(const Setting& setting);

struct Superfluous {
  std::vector<std::string> findings;
  uint32_t attempts = 0;  ///< Weakenings tried.
};
/// Weakens the plan in every single way: every barrier and event (without it, without one stage, one access, one mip
/// or layer, with a wrong layout), every semaphore wait (without it, without one stage), every load and store operation (with
/// DONT_CARE), every concurrent resource (exclusive). Reports each weakening after which nothing is missing. So it
/// finds what is superfluous in a plan, and at the same time shows that findMissing() notices every single fault.
Superfluous findSuperfluous(const Setting& setting);

/// The smallest number of batches with which the plan's barriers can do their work, each moved by itself to where
/// nothing goes missing: the fewest places that meet all their ranges. Events stay as they are.
uint32_t fewestBatches(const Setting& setting);

}  // namespace lensgraph::plan_checker
