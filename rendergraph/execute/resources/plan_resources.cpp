// Makes and shares memory.
#include "rendergraph/execute/resources/plan_resources.h"

#include <algorithm>

#include "rendergraph/declare/declaration.h"
#include "rendergraph/execute/resources/error_names.h"

namespace lensgraph::rendergraph {

namespace {

/// The object of one placement in `heap`, or with memory of its own.
template <class Object>
void makeObject(Backend& backend, const DeclaredResource& resource, const Placement& placement, bool dedicated,
                HeapId heap, Object& object) {
  if (resource.isImage) {
    const ImageRequest request{resource.image, placement.imageUsage, placement.concurrent, resource.name};
    if (dedicated) {
      const DedicatedImage made = backend.createDedicatedImage(request);
      object.dedicated = UniqueHeap(backend, made.heap);
      object.image = UniqueImage(backend, made.image);
    } else {
      object.image = UniqueImage(backend, backend.createImage(request, heap, placement.offset));
    }
    return;
  }
  const BufferRequest request{resource.buffer, placement.bufferUsage, placement.concurrent, resource.name};
  if (dedicated) {
    const DedicatedBuffer made = backend.createDedicatedBuffer(request);
    object.dedicated = UniqueHeap(backend, made.heap);
    object.buffer = UniqueBuffer(backend, made.buffer);
  } else {
    object.buffer = UniqueBuffer(backend, backend.createBuffer(request, heap, placement.offset));
  }
  if (resource.buffer.memory == MemoryKind::device) return;
  auto* address = static_cast<std::byte*>(backend.hostAddress(dedicated ? object.dedicated.get() : heap));
  object.address = address + (dedicated ? 0 : placement.offset);
}

/// The resource that has most to do with the size of a heap.
std::string_view largestIn(const Declaration& declaration, const Plan& plan, uint32_t heap) {
  const Placement* largest = nullptr;
  for (const Placement& placement : plan.placements) {
    if (placement.heap == heap && (largest == nullptr || placement.size > largest->size)) largest = &placement;
  }
  return largest != nullptr ? declaration.resources[largest->resource].name : std::string_view();
}

}  // namespace

HeapId HeapPool::acquire(Backend& backend, const PlannedHeap& planned, uint32_t slot, Heaps& taken) {
  std::erase_if(heaps_, [](const std::weak_ptr<PooledHeap>& heap) { return heap.expired(); });
  std::shared_ptr<PooledHeap> best;
  for (const std::weak_ptr<PooledHeap>& weak : heaps_) {
    const std::shared_ptr<PooledHeap> heap = weak.lock();
    const bool fits = heap->planned.memory == planned.memory &&
                      heap->planned.memoryTypeBits == planned.memoryTypeBits && heap->planned.size >= planned.size &&
                      (planned.memory == MemoryKind::device || heap->slot == slot);
    const bool isTaken = std::find(taken.begin(), taken.end(), heap) != taken.end();
    if (fits && !isTaken && (!best || heap->planned.size < best->planned.size)) best = heap;
  }
  if (!best) {
    best = std::make_shared<PooledHeap>();
    best->planned = planned;
    best->slot = slot;
    best->heap =
        UniqueHeap(backend, backend.createHeap(planned.size, planned.memoryTypeBits, planned.memory, "graph heap"));
    heaps_.push_back(best);
  }
  const HeapId id = best->heap.get();
  taken.push_back(std::move(best));
  return id;
}

void PlanResources::make(Backend& backend, HeapPool& pool, const Declaration& declaration, const Plan& plan,
                         uint32_t slot, bool hostVisible, Objects& into) {
  if (into.complete) return;
  Objects made;
  made.heaps.resize(plan.heaps.size());
  for (std::size_t i = 0; i < plan.heaps.size(); ++i) {
    const PlannedHeap& heap = plan.heaps[i];
    if (heap.dedicated || (heap.memory != MemoryKind::device) != hostVisible) continue;
    namingResource(largestIn(declaration, plan, static_cast<uint32_t>(i)),
                   [&] { made.heaps[i] = pool.acquire(backend, heap, slot, made.taken); });
  }
  made.objects.resize(plan.placements.size());
  for (std::size_t i = 0; i < plan.placements.size(); ++i) {
    const Placement& placement = plan.placements[i];
    const PlannedHeap& heap = plan.heaps[placement.heap];
    if ((heap.memory != MemoryKind::device) != hostVisible) continue;
    const DeclaredResource& resource = declaration.resources[placement.resource];
    namingResource(resource.name, [&] {
      makeObject(backend, resource, placement, heap.dedicated, made.heaps[placement.heap], made.objects[i]);
    });
  }
  made.complete = true;
  into = std::move(made);
}

void PlanResources::prepare(Backend& backend, HeapPool& pool, const Declaration& declaration, const Plan& plan,
                            uint32_t slot) {
  make(backend, pool, declaration, plan, slot, false, device_);
  Objects& own = slots_[slot];
  make(backend, pool, declaration, plan, slot, true, own);
  for (const UniqueEvent& event : own.events) backend.resetEvent(event.get());
  own.events.reserve(plan.events.size());
  while (own.events.size() < plan.events.size()) {
    const PlannedPass& setter = plan.passes[plan.events[own.events.size()].setAfter];
    own.events.emplace_back(backend, backend.createEvent(declaration.passes[setter.pass].name));
  }
}

void PlanResources::bind(const Plan& plan, uint32_t slot, ResourceTable& table) {
  for (std::size_t i = 0; i < plan.placements.size(); ++i) {
    const Placement& placement = plan.placements[i];
    const bool hostVisible = plan.heaps[placement.heap].memory != MemoryKind::device;
    Object& object = (hostVisible ? slots_[slot] : device_).objects[i];
    table[placement.resource] = {
        .image = object.image.get(), .buffer = object.buffer.get(), .views = &object.views, .address = object.address};
  }
}

}  // namespace lensgraph::rendergraph
