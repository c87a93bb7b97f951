// How a technique draws the host's scene without knowing it: a callback, and what the callback is told.
//
// The host's shaders meet the technique's through shaders/shared/emit.h: the vertex stage multiplies by
// ViewConstants::clipFromView, the fragment stage does what SceneEmit says.
#pragma once

#include <vulkan/vulkan_core.h>

#include <functional>
#include <span>

#include "rendergraph/graph.h"
#include "rendergraph/program.h"
#include "shaders/shared/emit.h"
#include "shaders/shared/view.h"

namespace lensgraph::passes {

struct SceneDrawCall {
  shared::SceneEmit emit = shared::SceneEmit::opaqueRadiance;
  shared::ViewConstants view{};
  VkExtent2D extent = {0, 0};  ///< Of viewport and scissor, px.
  /// For emits with storage: the technique's resources, bindings 0, 1, … of descriptor set 2. Declared by the pass.
  std::span<const rendergraph::Binding> emitBindings;
};

/// Vergences from `farthest` to `nearest`, 1/m.
struct VergenceInterval {
  float farthest = 0.0f, nearest = 0.0f;
};

/// Lights and environment as resources of one graph, for techniques that shade where a lens ray hits (shaders/scene
/// holds the formulas; the environment is a latitude-longitude map with -Z in the middle, mips by roughness).
struct SceneShading {
  rendergraph::Image environment;
  rendergraph::Buffer lights;     ///< LightConstants (shaders/shared/scene.h)
  rendergraph::Buffer constants;  ///< SceneConstants, uniform
};

/// The host's scene, as far as techniques are concerned. Lives until the frame has been recorded.
struct SceneDraw {
  /// Records draws inside a raster pass (rendering has begun; viewport and scissor are the callback's to set).
  /// Lengths in view space are metres.
  std::function<void(rendergraph::PassContext&, const SceneDrawCall&)> record;
  /// Imports what shading needs. Empty: nothing looks different from another side.
  std::function<SceneShading(rendergraph::Graph&)> importShading;
  /// Whether anything is alpha-blended: techniques declare nothing for transparency without it.
  bool hasTransparency = false;
  /// Vergence range over all geometry inside the frustum and, where it can be seen, the background (0), 1/m.
  float nearestVergence = 0.0f;
  float farthestVergence = 0.0f;
  /// Where in that range there is geometry, whole triangles at a time: disjoint, nearest first; for techniques that keep
  /// something per depth. Empty: it may be anywhere in the range. Geometry outside of it is drawn, but roughly.
  std::span<const VergenceInterval> occupied;
  /// Room for alpha-blended fragments, a mean over all pixels. Too little drops fragments and counts them in
  /// FrameStatistics::transparentDropped; the host then renders again with more.
  float transparentNodesPerPixel = 4.0f;
  /// The same for fragments of all surfaces, of techniques that keep every one: of linked lists, beyond the first of each
  /// list; and of lists compacted and filtered. A mean over the picture's pixels, whatever lists there are. See
  /// FrameStatistics::fragmentNodesDropped and listFragmentsDropped.
  float fragmentNodesPerPixel = 1.0f;
  float listFragmentsPerPixel = 4.0f;
};

}  // namespace lensgraph::passes
