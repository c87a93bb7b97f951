// The shader-side constants of draws, lights and viewpoint (shaders/shared/scene.h) from the engine's scene.
#pragma once

#include "engine/draw/scene_gpu.h"
#include "engine/scene/scene.h"
#include "engine/scene/viewpoint.h"
#include "shaders/shared/scene.h"

namespace lensgraph::engine {

/// Whether a draw's back faces are drawn as its front faces are.
bool drawsBothFaces(const SceneViewpoint& viewpoint, const SceneDrawItem& item);
/// Matrices are multiplied in double and rounded once.
shared::DrawConstants drawConstantsOf(const SceneViewpoint& viewpoint, const SceneDrawItem& item);
shared::LightConstants lightConstantsOf(const SceneViewpoint& viewpoint, const Light& light);
/// Fills the viewpoint's part: its rotation.
void fillViewpoint(shared::SceneConstants& constants, const SceneViewpoint& viewpoint);

}  // namespace lensgraph::engine
