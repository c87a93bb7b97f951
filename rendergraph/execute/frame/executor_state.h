// The inside of an Executor, shared by the files that implement it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "rendergraph/backend.h"
#include "rendergraph/capture.h"
#include "rendergraph/execute/frame/frame_in_flight.h"
#include "rendergraph/execute/frame/plan_cache.h"
#include "rendergraph/execute/frame/recording_context.h"
#include "rendergraph/execute/frame/step_recorder.h"
#include "rendergraph/execute/resources/deletion_queue.h"
#include "rendergraph/execute/resources/persistent_store.h"
#include "rendergraph/execute/resources/plan_resources.h"
#include "rendergraph/execute_options.h"
#include "rendergraph/jobs.h"

namespace lensgraph::rendergraph {

/// Steps recorded into one command buffer, one after the other.
struct Chunk {
  uint32_t submission = 0;
  uint32_t firstStep = 0, steps = 0;
  uint32_t lane = 0;    // The recorder that records it; a lane's chunks lie next to each other.
  bool starts = false;  // Begins the frame.
  bool ends = false;    // Ends its submission.
  CommandStream commands;
};

struct QueueTimeline {
  UniqueTimeline semaphore;
  uint64_t value = 0;  // Of the last submission that was accepted.
};

struct ExecutorState {
  ExecutorState(Backend& device, const ExecutorOptions& chosen);
  ~ExecutorState();

  // Declared in the order in which things may use one another; destroyed the other way round.
  Backend& backend;
  ExecutorOptions options;
  std::vector<QueueTimeline> timelines;  // By queue; made with the first submission.
  DeletionQueue deletionQueue;
  HeapPool pool;
  PlanCache plans{deletionQueue};
  PersistentStore persistent;
  std::vector<FrameInFlight> slots;

  uint64_t lastFrame = 0;  // Number of the latest frame that was submitted or recorded.
  uint64_t lastHash = 0;   // Plan of the latest frame; 0: there is none, or it broke off.
  CachedPlan* current = nullptr;
  Capture capture;  // Of the latest frame that was waited for, or recorded.
  uint64_t compiled = 0, reused = 0;

  // During a frame, and kept for their memory:
  RecordingContext frame;
  std::vector<std::unique_ptr<StepRecorder>> lanes;
  std::vector<Chunk> chunks;
  std::vector<uint64_t> values;  // That stand for the plan's submissions, each on its queue's timeline.
  std::vector<VkSemaphoreSubmitInfo> waits;
  std::vector<VkCommandBufferSubmitInfo> buffers;
  std::vector<VkSemaphore> waitedSemaphores;
  std::vector<uint64_t> waitedValues;
  std::unique_ptr<ThreadPool> threads;  // Unless the host gave its own.

  /// The slot for the next frame; waits for the frame that used it last. Throws GraphError (deviceLost, device).
  FrameInFlight& openSlot();
  /// Finds or compiles the plan, makes its objects, and fills the frame context. Throws GraphError.
  void prepare(const Declaration& declaration, const CompileOptions& options, FrameInFlight& slot, Timing timing);
  /// The frame was submitted or recorded.
  void closeSlot(FrameInFlight& slot, FrameInFlight::State state);
  /// The frame broke off. Waits for what was submitted of it.
  void abandon(FrameInFlight& slot) noexcept;
  /// Waits for the slot's frame and takes what it measured. Throws GraphError (deviceLost, device).
  void finish(FrameInFlight& slot);
  /// Waits for all frames up to this one.
  void waitFor(uint64_t frame);
  /// This frame and all before it have finished, as far as the executor was told.
  uint64_t finishedFrame() const;
  void waitForAll() { waitFor(lastFrame); }
  void makeTimelines();
  /// Waits until these submissions of the slot's frame have finished. Throws GraphError (deviceLost, device) that says
  /// where the device stopped, as far as that can be known.
  void waitForDevice(const FrameInFlight& slot, std::span<const SentSubmission> sent);
  Jobs& jobs(uint32_t threadsWanted);
  /// Destroys resources and plans. No frame is under way.
  void forget();

 private:
  void makeResources(const Declaration& declaration, uint32_t slot);
  void readStamps(FrameInFlight& slot);
  void openTimestamps(FrameInFlight& slot);
  const SentSubmission* unfinished(const FrameInFlight& slot) const;
};

}  // namespace lensgraph::rendergraph
