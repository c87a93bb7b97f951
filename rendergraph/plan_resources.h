// The heaps, images and buffers of one plan. Heaps are shared among the plans of an executor, since only one of them
// executes at a time: switching between graphs, or halving a resolution, costs no further memory.
#pragma once

#include <memory>
#include <vector>

#include "rendergraph/binding_table.h"
#include "rendergraph/owned.h"
#include "rendergraph/plan.h"
#include "rendergraph/view_cache.h"

namespace rendergraph {

struct Declaration;

struct PooledHeap {
  PlannedHeap planned;  ///< With its real size.
  OwnedHeap heap;
};

class HeapPool {
 public:
  using Heaps = std::vector<std::shared_ptr<PooledHeap>>;
  /// One heap for each planned one, at least as large; different ones for one call. Throws GraphError (device).
  Heaps acquire(Backend& backend, const std::vector<PlannedHeap>& planned);

 private:
  std::vector<std::weak_ptr<PooledHeap>> heaps_;
};

class PlanResources {
 public:
  /// Throws GraphError (device) that names the resource; nothing remains then.
  PlanResources(Backend& backend, HeapPool& pool, const Declaration& declaration, const Plan& plan);
  /// Enters the plan's own resources.
  void bind(const Plan& plan, BindingTable& table);

 private:
  struct Object {
    OwnedImage image;
    OwnedBuffer buffer;
    ViewCache views;
    std::byte* address = nullptr;
  };
  HeapPool::Heaps heaps_;
  std::vector<Object> objects_;  // By placement. Destroyed before the heaps; views before images.
};

}  // namespace rendergraph
