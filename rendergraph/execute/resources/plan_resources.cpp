// Makes the objects of a plan in heaps of the pool, or with memory of their own where the device wants that.
#include "rendergraph/execute/resources/plan_resources.h"

#include "rendergraph/declare/declaration.h"
#include "rendergraph/execute/resources/error_names.h"

namespace lensgraph::rendergraph {

namespace {

GraphObject objectOf(Backend& backend, const DeclaredResource& resource, const Placement& placement, bool dedicated,
                     HeapId heap) {
  const ObjectRequest request{.isImage = resource.isImage,
                              .imageDesc = resource.image,
                              .bufferDesc = resource.buffer,
                              .imageUsage = placement.imageUsage,
                              .bufferUsage = placement.bufferUsage,
                              .concurrent = placement.concurrent,
                              .name = resource.name};
  return dedicated ? makeDedicated(backend, request) : makeInHeap(backend, request, heap, placement.offset);
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

void PlanResources::make(Backend& backend, HeapPool& pool, const Declaration& declaration, const Plan& plan,
                         uint32_t frameInFlight, bool hostVisible, Objects& into) {
  if (into.complete) return;
  Objects made;
  made.heaps.resize(plan.heaps.size());
  for (std::size_t i = 0; i < plan.heaps.size(); ++i) {
    const PlannedHeap& heap = plan.heaps[i];
    if (heap.dedicated || (heap.memory != MemoryKind::device) != hostVisible) continue;
    namingResource(largestIn(declaration, plan, static_cast<uint32_t>(i)),
                   [&] { made.heaps[i] = pool.acquire(backend, heap, frameInFlight, made.taken); });
  }
  made.objects.resize(plan.placements.size());
  for (std::size_t i = 0; i < plan.placements.size(); ++i) {
    const Placement& placement = plan.placements[i];
    const PlannedHeap& heap = plan.heaps[placement.heap];
    if ((heap.memory != MemoryKind::device) != hostVisible) continue;
    const DeclaredResource& resource = declaration.resources[placement.resource];
    namingResource(resource.name, [&] {
      made.objects[i] = objectOf(backend, resource, placement, heap.dedicated, made.heaps[placement.heap]);
    });
  }
  made.complete = true;
  into = std::move(made);
}

void PlanResources::prepare(Backend& backend, HeapPool& pool, const Declaration& declaration, const Plan& plan,
                            uint32_t frameInFlight) {
  make(backend, pool, declaration, plan, frameInFlight, false, device_);
  Objects& own = byFrameInFlight_[frameInFlight];
  make(backend, pool, declaration, plan, frameInFlight, true, own);
  for (const UniqueEvent& event : own.events) backend.resetEvent(event.get());
  own.events.reserve(plan.events.size());
  while (own.events.size() < plan.events.size()) {
    const PlannedPass& setter = plan.passes[plan.events[own.events.size()].setAfter];
    own.events.emplace_back(backend, backend.createEvent(declaration.passes[setter.pass].name));
  }
}

void PlanResources::enterInto(ResourceTable& table, const Plan& plan, uint32_t frameInFlight) {
  for (std::size_t i = 0; i < plan.placements.size(); ++i) {
    const Placement& placement = plan.placements[i];
    const bool hostVisible = plan.heaps[placement.heap].memory != MemoryKind::device;
    table[placement.resource] = (hostVisible ? byFrameInFlight_[frameInFlight] : device_).objects[i].entry();
  }
}

}  // namespace lensgraph::rendergraph
