// Lens rays traced through a layered picture of the scene that is drawn once (Lee, Eisemann, Seidel 2009).
#pragma once

#include <span>
#include <vector>

#include "passes/dof_io.h"
#include "passes/multiview_synthesis/parameters.h"
#include "passes/parameters.h"
#include "passes/technique.h"

namespace lensgraph::passes::multiview_synthesis {

std::span<const Field<Parameters>> fields();
/// What is wrong with parameters that are right by themselves; empty when nothing is.
std::vector<Problem> validate(const Parameters& parameters, const DofInputs& inputs);

/// Aperture 0 gives the pinhole picture of the same pixel samples, bit for bit.
/// Precondition: inputs.scene is set and outlives the recording.
DofOutputs declare(rendergraph::Graph& graph, const DofInputs& inputs, const Parameters& parameters);

/// The registry's entry.
Technique technique();

}  // namespace lensgraph::passes::multiview_synthesis
