// The picture without a lens: everything in focus. One view through each pixel's centre, or the mean over the pixel's
// square (a box filter of 1 px, by sub-pixel jitter).
#pragma once

#include <span>
#include <vector>

#include "passes/dof_io.h"
#include "passes/lens/lens_samples.h"
#include "passes/parameters.h"
#include "passes/technique.h"

namespace lensgraph::passes::pinhole {

struct Parameters {
  int pixelSamples = 1;   ///< 1…4096 views; 1 looks through the pixel's centre only. Cost: one scene draw each.
  int viewsPerFrame = 8;  ///< 1…64 views an execution of the graph.
  LensPattern pattern = LensPattern::sobol;
};

std::span<const Field<Parameters>> fields();

/// Executions of the graph that make the finished picture.
uint32_t frameCount(const Parameters& parameters, const DofInputs& inputs);

/// Also gives the depth of the pixels' centres. Precondition: inputs.scene is set and outlives the recording.
DofOutputs declare(rendergraph::Graph& graph, const DofInputs& inputs, const Parameters& parameters);

/// The registry's entry.
Technique technique();

}  // namespace lensgraph::passes::pinhole
