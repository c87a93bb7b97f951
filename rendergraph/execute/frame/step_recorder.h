// Records steps of a plan, one after the other, into a command stream. Several recorders may record different steps of
// one frame at the same time; each belongs to one thread at a time and keeps its memory from frame to frame.
#pragma once

#include <cstdint>
#include <vector>

#include "rendergraph/backend.h"
#include "rendergraph/execute/frame/recording_context.h"
#include "rendergraph/execute/frame/step_state.h"

namespace lensgraph::rendergraph {

class StepRecorder {
 public:
  explicit StepRecorder(RecordingContext& frame) : frame_(&frame), state_(frame) {}

  /// Where the steps go from now on.
  void setCommands(const CommandStream& commands) { state_.commands = commands; }
  /// Records one step with its barriers and events. The steps of one rendering are recorded by one recorder, in order.
  /// What the pass's recording throws passes through.
  void recordStep(uint32_t step);
  /// Records what precedes a host pass.
  void recordHostWait(uint32_t step);
  void recordBarriers(const BarrierBatch& batch);
  /// Calls the recording of a host pass.
  void runHostPass(uint32_t step);

 private:
  void recordNamed(uint32_t step);
  void recordWaits(const PlannedPass& planned);
  void recordSets(const PlannedPass& planned);
  void beginRendering(const PlannedPass& planned);
  VkRenderingAttachmentInfo attachmentInfo(const PlannedAttachment& attachment, const VkClearValue& clear);
  void runRecording(uint32_t step);
  void recordDispatch(const DeclaredDispatch& dispatch);
  void stamp(uint32_t step, uint32_t end);
  void noteRecording(uint32_t step, double startMs);
  /// Valid until the next call.
  VkDependencyInfo dependencyOf(const BarrierBatch& batch);

  RecordingContext* frame_;
  StepState state_;
  // Reused from call to call:
  std::vector<VkClearValue> colorClears_;
  std::vector<VkRenderingAttachmentInfo> colors_;
  std::vector<VkImageMemoryBarrier2> imageBarriers_;
  std::vector<VkBufferMemoryBarrier2> bufferBarriers_;
};

}  // namespace lensgraph::rendergraph
