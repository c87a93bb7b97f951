// The mean of many views of the scene, a few per execution of the graph (Haeberli & Akeley 1990). What accumulation
// does over the lens, and pinhole over the pixel.
#pragma once

#include <functional>
#include <string>

#include "passes/dof_io.h"
#include "passes/lens/lens_samples.h"

namespace lensgraph::passes {

struct ViewMean {
  std::string prefix;          ///< Of pass and resource names; also names what persists across executions.
  uint32_t viewCount = 1;      ///< Views of the finished picture.
  uint32_t viewsPerFrame = 8;  ///< Views of one execution.
  std::function<LensSample(uint32_t view)> sample;  ///< Called while declaring.
};

/// Executions until the picture is finished.
uint32_t frameCount(const ViewMean& mean);

/// Declares views DofInputs::frame · viewsPerFrame … of the mean, and the picture so far. Frame 0 starts anew; frames
/// beyond the last declare only the resolve. The mean lives in persistent images of the executor, named by prefix.
/// Precondition: inputs.scene is set and outlives the recording.
DofOutputs declareViewMean(rendergraph::Graph& graph, const DofInputs& inputs, const ViewMean& mean);

}  // namespace lensgraph::passes
