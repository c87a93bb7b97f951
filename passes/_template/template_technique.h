// The smallest depth of field there is, to be copied: docs/new_technique.md. What it approximates and what that looks
// like: README.md.
#pragma once

#include <span>

#include "passes/dof_io.h"
#include "passes/parameters.h"
#include "passes/technique.h"

namespace lensgraph::passes::template_technique {

struct Parameters {
  int samples = 48;  ///< 1…256 taps a pixel. Time grows with it; fewer show as noise.
};

/// Names, ranges and descriptions of the parameters.
std::span<const Field<Parameters>> fields();

/// Declares `clear_statistics` and `gather`; nothing when the lens has no aperture, and the output is then inputs.color
/// itself. Precondition: checkInputs(TechniqueInput::image, inputs) found nothing.
DofOutputs declare(rendergraph::Graph& graph, const DofInputs& inputs, const Parameters& parameters);

/// The registry's entry.
Technique technique();

}  // namespace lensgraph::passes::template_technique
