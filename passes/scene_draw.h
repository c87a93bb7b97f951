// How a technique draws the host's scene without knowing it: a callback, and what the callback is told.
//
// The host's shaders meet the technique's through shaders/shared/emit.h: the vertex stage multiplies by
// ViewConstants::clipFromView, the fragment stage does what SceneEmit says.
#pragma once

#include <functional>
#include <span>

#include "rendergraph/pass.h"
#include "rendergraph/program.h"
#include "shaders/shared/view.h"

namespace passes {

/// Which surfaces a draw covers and what their fragments do.
enum class SceneEmit : uint8_t {
  /// Opaque and alpha-masked surfaces. Colour attachment 0: linear radiance, alpha 1. Depth attachment: tested
  /// (greater) and written.
  opaqueRadiance,
  /// Alpha-blended surfaces only. No colour attachment; depth attachment tested, not written. Each fragment appends
  /// itself to per-pixel lists through the bindings of shaders/shared/transparent_list.h.
  transparentList,
};

struct SceneDrawCall {
  SceneEmit emit = SceneEmit::opaqueRadiance;
  shared::ViewConstants view{};
  /// For emits with storage: the technique's resources, bindings 0… of descriptor set 2. Declared by the pass.
  std::span<const rendergraph::Binding> emitBindings;
};

/// The host's scene, as far as techniques are concerned. Lives until the frame has been recorded.
struct SceneDraw {
  /// Records draws inside a raster pass (rendering has begun; viewport and scissor are the callback's to set).
  std::function<void(rendergraph::PassContext&, const SceneDrawCall&)> record;
  /// Whether anything is alpha-blended: techniques declare nothing for transparency without it.
  bool hasTransparency = false;
  /// Vergence range over all geometry inside the frustum and, where it can be seen, the background (0), 1/m.
  float nearestVergence = 0.0f;
  float farthestVergence = 0.0f;
};

}  // namespace passes
