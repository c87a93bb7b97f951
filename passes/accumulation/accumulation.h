// The reference: the mean of pinhole views from many points of the lens (Haeberli & Akeley 1990; Cook 1984).
//
// Exact in the limit for everything the scene pass draws, hidden surfaces and alpha-blended ones included. Progressive:
// each execution of the graph adds `viewsPerFrame` views; the picture so far and its standard error are always there.
#pragma once

#include <span>
#include <vector>

#include "passes/dof_io.h"
#include "passes/lens/lens_samples.h"
#include "passes/parameters.h"
#include "passes/technique.h"

namespace lensgraph::passes::accumulation {

struct Parameters {
  int lensSamples = 256;    ///< 1…65536 views. Cost: one scene draw each.
  bool pixelJitter = true;  ///< Also average over the pixel's square (box filter, 1 px): antialiasing for free.
  bool gaussian = false;  ///< Gaussian lens of σ = E instead of the aperture's shape (for comparison with Kraus 2007).
  int viewsPerFrame = 8;  ///< 1…64 views an execution of the graph.
  LensPattern pattern = LensPattern::sobol;
};

std::span<const Field<Parameters>> fields();

/// Executions of the graph that make the finished picture.
uint32_t frameCount(const Parameters& parameters, const DofInputs& inputs);

/// Aperture 0 gives the pinhole picture of the same pixel samples, bit for bit.
/// Precondition: inputs.scene is set and outlives the recording.
DofOutputs declare(rendergraph::Graph& graph, const DofInputs& inputs, const Parameters& parameters);

/// The registry's entry.
Technique technique();

}  // namespace lensgraph::passes::accumulation
