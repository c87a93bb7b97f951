// The heaps, images, buffers and events of one plan.
//
// Device memory is shared among the plans of an executor, and by the frames in flight: the device executes one frame
// after the other, so switching between graphs, or halving a resolution, costs no further memory. What the host reads
// or writes while the device works on another frame exists once for each frame in flight, as do events.
#pragma once

#include <span>
#include <vector>

#include "rendergraph/execute/resources/graph_objects.h"
#include "rendergraph/execute/resources/heap_pool.h"
#include "rendergraph/execute/resources/resource_table.h"
#include "rendergraph/execute/resources/unique_handle.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

struct Declaration;

/// Frames in flight are given by their index in the executor.
class PlanResources {
 public:
  explicit PlanResources(uint32_t framesInFlight) : byFrameInFlight_(framesInFlight) {}

  /// Makes what the frame in flight needs and does not exist, and unsets its events. The device has finished its frame
  /// before. Throws GraphError that names the resource; what was made remains, for the next attempt.
  void prepare(Backend& backend, HeapPool& pool, const Declaration& declaration, const Plan& plan,
               uint32_t frameInFlight);
  /// Enters the objects of the plan's placements into the table. Precondition: prepare() for this frame in flight.
  void enterInto(ResourceTable& table, const Plan& plan, uint32_t frameInFlight);
  std::span<const UniqueEvent> events(uint32_t frameInFlight) const { return byFrameInFlight_[frameInFlight].events; }

 private:
  /// Objects by placement; those of the other kind of memory are empty. Destroyed before the heaps, views before images.
  struct Objects {
    HeapPool::Heaps taken;
    std::vector<HeapId> heaps;  // By planned heap; 0: of the other kind, or dedicated.
    std::vector<GraphObject> objects;
    std::vector<UniqueEvent> events;
    bool complete = false;
  };
  void make(Backend& backend, HeapPool& pool, const Declaration& declaration, const Plan& plan, uint32_t frameInFlight,
            bool hostVisible, Objects& into);

  Objects device_;
  std::vector<Objects> byFrameInFlight_;
};

}  // namespace lensgraph::rendergraph
