// The step that one recorder records at the moment, as PassContext shows it to the recording of its pass.
#pragma once

#include <vulkan/vulkan_core.h>

#include <vector>

#include "rendergraph/backend.h"
#include "rendergraph/execute/frame/recording_context.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

struct StepState {
  explicit StepState(RecordingContext& recordedFrame) : frame(recordedFrame) {}

  RecordingContext& frame;
  CommandStream commands;                ///< Where the step's commands go; null in a host pass.
  const PlannedPass* planned = nullptr;  ///< The step; null before the first one.
  // Of the rendering that is going on, when the step is a raster pass:
  std::vector<VkFormat> colorFormats;
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  /// Bindings of the call that is being recorded. They keep their memory from call to call.
  std::vector<ResolvedBinding> bindings;
};

}  // namespace lensgraph::rendergraph
