// Records the steps of a plan, on as many threads as are asked for, and submits them unless the host does.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rendergraph/backend.h"
#include "rendergraph/execute/frame/frame_in_flight.h"
#include "rendergraph/execute/frame/plan_store.h"
#include "rendergraph/execute/frame/queue_timelines.h"
#include "rendergraph/execute/frame/recording_context.h"
#include "rendergraph/execute/frame/step_recorder.h"
#include "rendergraph/execute_options.h"
#include "rendergraph/jobs.h"

namespace lensgraph::rendergraph {

/// A segment is the submissions up to the next host pass; a chunk is the steps of one command buffer; a lane is the
/// chunks that one thread records, one after the other, with one recorder for each queue.
/// The runner serves one frame at a time and keeps its memory, so that an unchanged frame allocates nothing.
class FrameRunner {
 public:
  /// All of them outlive the runner.
  FrameRunner(Backend& backend, const ExecutorOptions& options, RecordingContext& context, QueueTimelines& timelines,
              PlanStore& plans);

  /// Records and submits everything. `threads`: how many record at once, at least 1. What a recording throws passes
  /// through. Precondition: the context is prepared for this frame.
  void execute(FrameInFlight& frame, Timing timing, uint32_t threads);
  /// Records everything into the host's command buffer, on one thread.
  void record(FrameInFlight& frame, VkCommandBuffer commands);

 private:
  /// Steps recorded into one command buffer, one after the other.
  struct Chunk {
    uint32_t submission = 0;
    uint32_t firstStep = 0, steps = 0;
    uint32_t lane = 0;    // A lane's chunks lie next to each other.
    bool starts = false;  // Begins the frame.
    bool ends = false;    // Ends its submission.
    CommandStream commands;
  };

  const Plan& plan() const { return *context_.plan; }
  void begin(FrameInFlight& frame, Timing timing, uint32_t threads);
  bool needsStart() const;
  void recordStart(const CommandStream& commands);
  bool endsWithHostPass(uint32_t submission) const;
  uint32_t deviceSteps(uint32_t submission) const;
  void cutChunks(uint32_t first, uint32_t last);
  void cutSubmission(uint32_t submission, uint32_t& position, uint32_t total, uint32_t lanes);
  void openLanes();
  void recordLane(uint32_t lane);
  void recordChunk(Chunk& chunk);
  void recordSegment(uint32_t first, uint32_t last);
  void submit(uint32_t submission, std::span<const Chunk> chunks);
  void submitMeasured(uint32_t submission, std::span<const Chunk> chunks);
  void submitSegment(uint32_t first, uint32_t last);
  void waitForSubmission(uint32_t submission);
  UniqueRecorder& recorder(uint32_t lane, uint32_t queue);
  Jobs& jobs();
  void refuseHostPasses() const;

  Backend& backend_;
  bool severalInFlight_;
  Jobs* hostJobs_;
  RecordingContext& context_;
  QueueTimelines& timelines_;
  PlanStore& plans_;

  // Of the frame that is being executed:
  FrameInFlight* frame_ = nullptr;
  Timing timing_ = Timing::none;
  uint32_t threads_ = 1;
  std::vector<Chunk> chunks_;            // Of the current segment.
  std::vector<uint64_t> reachedValues_;  // By submission of the plan: value of its queue's timeline when it is done.

  // Reused from frame to frame:
  std::vector<std::unique_ptr<StepRecorder>> lanes_;
  std::vector<VkSemaphoreSubmitInfo> waits_;
  std::vector<VkCommandBufferSubmitInfo> buffers_;
  std::unique_ptr<ThreadPool> pool_;  // Made when several threads are first asked for, unless the host gave its jobs.
};

}  // namespace lensgraph::rendergraph
