// A timeline semaphore for each queue: submissions raise its value, and the host waits for values.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/backend.h"
#include "rendergraph/execute/frame/frame_in_flight.h"
#include "rendergraph/execute/frame/plan_store.h"
#include "rendergraph/execute/resources/unique_handle.h"

namespace lensgraph::rendergraph {

/// The value of a queue is that of its latest submission which the backend accepted. When a wait fails, nobody knows
/// what the device has executed, so the plans' persistent content is distrusted.
class QueueTimelines {
 public:
  /// Both outlive the timelines.
  QueueTimelines(Backend& backend, PlanStore& plans) : backend_(backend), plans_(plans) {}

  /// Makes the semaphores that do not exist yet. Throws GraphError (device, outOfMemory).
  void open();
  VkSemaphore semaphore(uint32_t queue) const { return queues_[queue].semaphore.get(); }
  uint64_t value(uint32_t queue) const { return queues_[queue].value; }

  /// Submits work that raises the queue's value by one. Returns the value; it stays when the backend throws.
  /// Precondition: `submission` signals nothing; open() was called.
  uint64_t submit(uint32_t queue, VkSubmitInfo2 submission);

  /// Whether the device has finished the submission.
  bool isFinished(const SentSubmission& sent) const;
  /// Waits until the device has finished these submissions of the frame. Throws GraphError (deviceLost, device) that
  /// names the passes between which the device stopped, as far as that can be known.
  void wait(const FrameInFlight& frame, std::span<const SentSubmission> sent);

 private:
  struct Timeline {
    UniqueTimeline semaphore;
    uint64_t value = 0;
  };
  const SentSubmission* firstUnfinished(const FrameInFlight& frame) const;

  Backend& backend_;
  PlanStore& plans_;
  std::vector<Timeline> queues_;
  std::vector<VkSemaphore> waitedSemaphores_;  // Reused from wait to wait.
  std::vector<uint64_t> waitedValues_;
};

}  // namespace lensgraph::rendergraph
