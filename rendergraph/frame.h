// Records the passes of a plan, and submits them unless the host does.
#pragma once

#include <cstdint>
#include <vector>

#include "rendergraph/executor_state.h"

namespace rendergraph {

class Frame {
 public:
  Frame(Executor& executor, Executor::State& state, Timing timing)
      : executor_(executor), state_(state), timing_(timing) {}

  /// Records and submits everything. What a recording throws passes through.
  void execute();
  /// Records everything into the host's command buffer.
  void record(VkCommandBuffer commands);
  /// Whether anything was submitted.
  bool submitted() const { return submitted_; }

 private:
  void open();
  double submit();
  void recordPass(uint32_t step);
  void recordHostPass(uint32_t step);
  void recordBarriers(const BarrierBatch& batch);
  void beginRendering(const PlannedPass& planned);
  void runRecording(const PlannedPass& planned);
  void noteRecording(uint32_t step, double startMs);
  void stamp(uint32_t step);
  void readStamps(double submitMs);

  Executor& executor_;
  Executor::State& state_;
  Timing timing_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  bool opened_ = false;
  bool submitted_ = false;
  const Clock::time_point start_ = Clock::now();  // Of the frame; captures count from it.
  double recordedMs_ = 0.0;                       // Sum over the passes.
  std::vector<uint32_t> stamped_;                 // Steps with two timestamps in the open submission.
  std::vector<VkImageMemoryBarrier2> imageBarriers_;
  std::vector<VkBufferMemoryBarrier2> bufferBarriers_;
};

}  // namespace rendergraph
