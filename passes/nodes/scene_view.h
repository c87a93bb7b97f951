// One picture of the scene from one lens point: opaque surfaces, then alpha-blended ones composited exactly.
// Shared by the techniques that draw whole views (pinhole, accumulation).
#pragma once

#include <string>

#include "passes/dof_io.h"
#include "shaders/shared/view.h"

namespace lensgraph::passes {

struct SceneViewOutputs {
  rendergraph::Image color;        ///< RGBA32F, alpha 1.
  rendergraph::Image depth;        ///< D32, reversed, opaque and masked surfaces only.
  rendergraph::Buffer statistics;  ///< Updated when the scene has transparency.
};

/// Format of colour in every view: float, because the accumulation is a reference and because lavapipe reads it fastest.
inline constexpr VkFormat kViewColorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
inline constexpr VkFormat kViewDepthFormat = VK_FORMAT_D32_SFLOAT;

/// Declares `prefix`.opaque and, when the scene has transparency, `prefix`.clear_lists, .transparent and .composite.
/// Precondition: inputs.scene is set and outlives the recording.
SceneViewOutputs declareSceneView(rendergraph::Graph& graph, const DofInputs& inputs, const std::string& prefix,
                                  const shared::ViewConstants& view, rendergraph::Buffer statistics);

}  // namespace lensgraph::passes
