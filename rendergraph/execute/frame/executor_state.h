// The inside of an Executor: one execution from the declaration to the device, and what waits for it.
#pragma once

#include <cstdint>

#include "rendergraph/backend.h"
#include "rendergraph/capture.h"
#include "rendergraph/execute/frame/frame_ring.h"
#include "rendergraph/execute/frame/frame_runner.h"
#include "rendergraph/execute/frame/plan_store.h"
#include "rendergraph/execute/frame/queue_timelines.h"
#include "rendergraph/execute/frame/recording_context.h"
#include "rendergraph/execute_options.h"

namespace lensgraph::rendergraph {

/// Between two calls every frame in flight is idle, or its frame has been closed under a number. A frame that breaks off
/// leaves everything as if it had not been begun, except that persistent content which it may have changed is unknown.
class ExecutorState {
 public:
  /// The backend and the host's jobs outlive the state.
  ExecutorState(Backend& backend, const ExecutorOptions& options);
  /// Waits for all submitted frames.
  ~ExecutorState();
  ExecutorState(const ExecutorState&) = delete;
  ExecutorState& operator=(const ExecutorState&) = delete;

  /// Executes the declaration and gives it to the device. Returns the number of the frame. Throws GraphError, and what
  /// recordings throw.
  uint64_t submit(const Declaration& declaration, const ExecuteOptions& options);
  /// Records the declaration into the host's command buffer. Throws as submit() does.
  void record(const Declaration& declaration, VkCommandBuffer commands, const CompileOptions& options);

  /// Waits for all submitted frames up to this number, and takes what they measured. Throws GraphError (deviceLost,
  /// device).
  void waitFor(uint64_t frame);
  void waitForAll() { waitFor(frames_.lastFrame()); }
  /// Whether waitFor() would return without waiting.
  bool isFinished(uint64_t frame) const;
  /// Waits for all frames, then destroys resources and plans.
  void clear();

  const FrameRing& frames() const { return frames_; }
  PlanStore& plans() { return plans_; }
  const PlanStore& plans() const { return plans_; }
  /// The capture of the latest frame that was waited for, or recorded.
  const Capture& capture() const { return capture_; }

 private:
  /// What the runner does with a prepared frame.
  template <class Run>
  uint64_t runFrame(const Declaration& declaration, const CompileOptions& options, Timing timing,
                    FrameInFlight::State state, Run&& run);
  FrameInFlight& openFrame();
  void prepare(const Declaration& declaration, const CompileOptions& options, FrameInFlight& frame, Timing timing);
  void makeObjects(const Declaration& declaration, FrameInFlight& frame);
  void openTimestamps(FrameInFlight& frame);
  void abandon(FrameInFlight& frame) noexcept;
  void finish(FrameInFlight& frame);
  void readTimestamps(FrameInFlight& frame);

  // In the order in which they use one another; destroyed the other way round.
  Backend& backend_;
  PlanStore plans_;
  QueueTimelines timelines_;
  FrameRing frames_;
  RecordingContext context_;
  FrameRunner runner_;
  Capture capture_;
};

}  // namespace lensgraph::rendergraph
