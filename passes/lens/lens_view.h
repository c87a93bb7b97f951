// The projection of one lens point: shaders/shared/view.h says what it means.
#pragma once

#include "passes/dof_io.h"
#include "shaders/shared/view.h"

namespace lensgraph::passes {

/// The view from lens point v (units of the lens radius, x right, y down), shifted by a sub-pixel offset in px.
/// v = 0 and offset 0 give the pinhole view, and so does any v when lens.cocScale is 0: bit for bit.
shared::ViewConstants viewFromLens(const DofInputs& inputs, shared::vec2 v, shared::vec2 pixelOffset);

}  // namespace lensgraph::passes
