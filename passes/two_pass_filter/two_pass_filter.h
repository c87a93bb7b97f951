// Depth of field as a two-pass filter of one picture and its depth: Zhou, Chen, Pullen, "Accurate Depth of
// Field Simulation in Real Time", Computer Graphics Forum 2007. What it approximates and what that looks
// like: README.md.
#pragma once

#include <span>
#include <vector>

#include "passes/dof_io.h"
#include "passes/parameters.h"
#include "passes/technique.h"

namespace lensgraph::passes::two_pass_filter {

struct Parameters {
  float maxRadius = 256.0f;  ///< px, 1…1024: blur radii are limited to it.
  float minRadius = 0.5f;    ///< px, 0.1…2: r_min of the intensity 1/max(r, r_min)².
  float leakage = 0.25f;     ///< 1/px, 0…16: k of L = min(1, k·r_c).
};

std::span<const Field<Parameters>> fields();

/// Declares six nodes: clear_statistics, prepare, tiles, reach, vertical, horizontal; none when the lens has
/// no aperture, and the output is then inputs.color itself. Throws GraphError when the images have another
/// size than inputs.extent.
DofOutputs declare(rendergraph::Graph& graph, const DofInputs& inputs, const Parameters& parameters);

/// The registry's entry.
Technique technique();

}  // namespace lensgraph::passes::two_pass_filter
