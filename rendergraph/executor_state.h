// The inside of an Executor, shared by the files that implement it.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "rendergraph/binding_table.h"
#include "rendergraph/declaration.h"
#include "rendergraph/executor.h"
#include "rendergraph/plan_cache.h"
#include "rendergraph/plan_resources.h"
#include "rendergraph/retained_store.h"
#include "rendergraph/view_cache.h"

namespace rendergraph {

using Clock = std::chrono::steady_clock;

inline double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// What the latest execution exported, so that it can be looked up when the graph is gone.
struct ExportTable {
  uint32_t serial = 0;  // Of the declaration.
  BindingTable bound;
  std::vector<uint8_t> exported;
  std::vector<VkDeviceSize> sizes;  // Of buffers, bytes.
  void take(const Declaration& declaration, const BindingTable& table);
};

struct Executor::State {
  explicit State(Backend& device) : backend(device), retained(device) {}

  // Declared in the order in which things may use one another; destroyed the other way round.
  Backend& backend;
  HeapPool pool;
  PlanCache plans;
  RetainedStore retained;
  ViewCache importedViews;  // A host may destroy an imported image after any frame, so these live for one.

  // Of the latest execution:
  CachedPlan* current = nullptr;
  Capture capture;
  ExportTable exports;
  uint64_t compiled = 0, reused = 0;

  // During an execution:
  const Declaration* declaration = nullptr;
  BindingTable bound;
  // During a recording:
  const PlannedPass* planned = nullptr;
  std::vector<VkFormat> colorFormats;
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;
  std::vector<ResolvedBinding> bindings;  // Reused from call to call.

  /// Finds or compiles the plan, makes its objects, and fills the table. Throws GraphError.
  void prepare(const Declaration& declaration, const CompileOptions& options);
  VkImageView viewOf(uint32_t resource, const Subresources& range, VkImageViewType type);
  /// Drops what lives only as long as one execution.
  void finish();

 private:
  void makeResources();
};

}  // namespace rendergraph
