// Makes and shares memory.
#include "rendergraph/plan_resources.h"

#include <algorithm>

#include "rendergraph/declaration.h"
#include "rendergraph/naming.h"

namespace rendergraph {

HeapPool::Heaps HeapPool::acquire(Backend& backend, const std::vector<PlannedHeap>& planned) {
  std::erase_if(heaps_, [](const std::weak_ptr<PooledHeap>& heap) { return heap.expired(); });
  Heaps result;
  for (const PlannedHeap& wanted : planned) {
    std::shared_ptr<PooledHeap> best;
    for (const std::weak_ptr<PooledHeap>& weak : heaps_) {
      const std::shared_ptr<PooledHeap> heap = weak.lock();
      const bool fits = heap->planned.memory == wanted.memory &&
                        heap->planned.memoryTypeBits == wanted.memoryTypeBits && heap->planned.size >= wanted.size;
      const bool taken = std::find(result.begin(), result.end(), heap) != result.end();
      if (fits && !taken && (!best || heap->planned.size < best->planned.size)) best = heap;
    }
    if (!best) {
      best = std::make_shared<PooledHeap>();
      heaps_.push_back(best);
      best->planned = wanted;
      best->heap =
          OwnedHeap(backend, backend.createHeap(wanted.size, wanted.memoryTypeBits, wanted.memory, "graph heap"));
    }
    result.push_back(std::move(best));
  }
  return result;
}

PlanResources::PlanResources(Backend& backend, HeapPool& pool, const Declaration& declaration, const Plan& plan)
    : heaps_(pool.acquire(backend, plan.heaps)) {
  objects_.reserve(plan.placements.size());
  for (const Placement& placement : plan.placements) {
    const DeclaredResource& resource = declaration.resources[placement.resource];
    const HeapId heap = heaps_[placement.heap]->heap.get();
    Object& object = objects_.emplace_back();
    namingResource(resource.name, [&] {
      if (resource.isImage) {
        object.image = OwnedImage(
            backend, backend.createImage(resource.image, placement.imageUsage, heap, placement.offset, resource.name));
        return;
      }
      object.buffer = OwnedBuffer(
          backend, backend.createBuffer(resource.buffer, placement.bufferUsage, heap, placement.offset, resource.name));
      if (resource.buffer.memory != MemoryKind::device) {
        object.address = static_cast<std::byte*>(backend.hostAddress(heap)) + placement.offset;
      }
    });
  }
}

void PlanResources::bind(const Plan& plan, BindingTable& table) {
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    Object& object = objects_[i];
    table[plan.placements[i].resource] = {
        .image = object.image.get(), .buffer = object.buffer.get(), .views = &object.views, .address = object.address};
  }
}

}  // namespace rendergraph
