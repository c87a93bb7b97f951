// Records the steps of a plan, on as many threads as are asked for, and submits them unless the host does.
#pragma once

#include <cstdint>
#include <span>

#include "rendergraph/execute/frame/executor_state.h"

namespace lensgraph::rendergraph {

class FrameRunner {
 public:
  /// `threads`: that record at once, at least 1.
  FrameRunner(ExecutorState& state, FrameInFlight& slot, Timing timing, uint32_t threads)
      : state_(state), slot_(slot), timing_(timing), threads_(threads) {}

  /// Records and submits everything. What a recording throws passes through.
  void execute();
  /// Records everything into the host's command buffer.
  void record(VkCommandBuffer commands);

 private:
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
  void refuseHostPasses() const;

  ExecutorState& state_;
  FrameInFlight& slot_;
  Timing timing_;
  uint32_t threads_;
};

}  // namespace lensgraph::rendergraph
