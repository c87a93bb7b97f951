// The part of a capture that follows from declaration and plan.
#pragma once

#include "rendergraph/capture.h"
#include "rendergraph/execute_options.h"

namespace lensgraph::rendergraph {

struct Declaration;

/// Names, bytes, barriers, lifetimes and memory; times are left unmeasured. Keeps Capture::planReused, and the memory of
/// what the capture held, so that an unchanged frame allocates nothing.
void beginCapture(Capture& capture, const Declaration& declaration, const Plan& plan, Timing timing);

}  // namespace lensgraph::rendergraph
