// Heaps that the plans of one executor share.
#pragma once

#include <memory>
#include <vector>

#include "rendergraph/execute/resources/unique_handle.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

/// A heap of the pool; it lives as long as some plan uses it.
struct PooledHeap {
  PlannedHeap planned;         ///< With its real size.
  uint32_t frameInFlight = 0;  ///< Host-visible memory: index of the frame in flight that it serves.
  UniqueHeap heap;
};

class HeapPool {
 public:
  using Heaps = std::vector<std::shared_ptr<PooledHeap>>;
  /// A heap at least as large, which is not in `taken`; added to it. Host-visible ones serve one frame in flight only.
  /// Throws GraphError (outOfMemory, device).
  HeapId acquire(Backend& backend, const PlannedHeap& planned, uint32_t frameInFlight, Heaps& taken);

 private:
  std::vector<std::weak_ptr<PooledHeap>> heaps_;
};

}  // namespace lensgraph::rendergraph
