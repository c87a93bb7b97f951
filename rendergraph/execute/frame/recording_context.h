// What the recordings of one frame share: only read while they run, except for views, which are made on demand.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <span>

#include "rendergraph/capture.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/execute/resources/resource_table.h"
#include "rendergraph/execute/resources/unique_handle.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

using Clock = std::chrono::steady_clock;

inline double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct RecordingContext {
  explicit RecordingContext(Backend& device) : backend(device) {}

  Backend& backend;
  const Declaration* declaration = nullptr;
  const Plan* plan = nullptr;
  ResourceTable objects;
  std::span<const UniqueEvent> events;  ///< Of Plan::events.
  Capture* capture = nullptr;           ///< Each step writes its own times.
  Clock::time_point start;
  VkQueryPool timestamps = VK_NULL_HANDLE;  ///< Null: no times are taken inside submissions.
  uint32_t timestampSteps = 0;              ///< Steps that have room in the pool.

  const DeclaredPass& declared(const PlannedPass& planned) const { return declaration->passes[planned.pass]; }
  /// Whether two timestamps of the step, in slots 2·step and 2·step + 1, are written.
  bool isStamped(uint32_t step) const {
    return timestamps != VK_NULL_HANDLE && step < timestampSteps && backend.hasTimestamps(plan->passes[step].queue) &&
           declared(plan->passes[step]).kind != PassKind::host;
  }
  /// From any recording. Throws GraphError that names the resource.
  VkImageView viewOf(uint32_t resource, const Subresources& range, VkImageViewType type);

 private:
  std::mutex views_;
};

}  // namespace lensgraph::rendergraph
