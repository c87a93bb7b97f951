// Takes the smallest free heap that is large enough, or makes a new one.
#include "rendergraph/execute/resources/heap_pool.h"

#include <algorithm>

namespace lensgraph::rendergraph {

HeapId HeapPool::acquire(Backend& backend, const PlannedHeap& planned, uint32_t frameInFlight, Heaps& taken) {
  std::erase_if(heaps_, [](const std::weak_ptr<PooledHeap>& heap) { return heap.expired(); });
  std::shared_ptr<PooledHeap> best;
  for (const std::weak_ptr<PooledHeap>& weak : heaps_) {
    const std::shared_ptr<PooledHeap> heap = weak.lock();
    const bool fits = heap->planned.memory == planned.memory &&
                      heap->planned.memoryTypeBits == planned.memoryTypeBits && heap->planned.size >= planned.size &&
                      (planned.memory == MemoryKind::device || heap->frameInFlight == frameInFlight);
    const bool isTaken = std::find(taken.begin(), taken.end(), heap) != taken.end();
    if (fits && !isTaken && (!best || heap->planned.size < best->planned.size)) best = heap;
  }
  if (!best) {
    best = std::make_shared<PooledHeap>();
    best->planned = planned;
    best->frameInFlight = frameInFlight;
    best->heap =
        UniqueHeap(backend, backend.createHeap(planned.size, planned.memoryTypeBits, planned.memory, "graph heap"));
    heaps_.push_back(best);
  }
  const HeapId id = best->heap.get();
  taken.push_back(std::move(best));
  return id;
}

}  // namespace lensgraph::rendergraph
