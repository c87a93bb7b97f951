// Constants of the exact transparency nodes (shaders/transparency, passes/scene_view).
#ifndef LENSGRAPH_SHARED_TRANSPARENCY_H
#define LENSGRAPH_SHARED_TRANSPARENCY_H

#include "shaders/shared/interop.h"

SHARED_NAMESPACE_BEGIN

SHARED_CONST uint kTransparencyTile = 8u;          // px; work group side
SHARED_CONST uint kTransparencyBudget = 60000u;    // node visits per pixel: lists of up to 244 nodes are exact

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_TRANSPARENCY_H
