// All fragments of the scene in per-pixel lists, filtered level by level, composited by circle of confusion (Selgrad,
// Reintges, Penk, Wagner, Stamminger 2015).
#pragma once

#include <span>
#include <vector>

#include "passes/dof_io.h"
#include "passes/multilayer_filtering/parameters.h"
#include "passes/parameters.h"
#include "passes/technique.h"

namespace lensgraph::passes::multilayer_filtering {

std::span<const Field<Parameters>> fields();

/// Aperture 0 gives the pinhole picture, bit for bit.
/// Precondition: inputs.scene is set and outlives the recording.
DofOutputs declare(rendergraph::Graph& graph, const DofInputs& inputs, const Parameters& parameters);

/// The registry's entry.
Technique technique();

}  // namespace lensgraph::passes::multilayer_filtering
