// Which layers of view depth a scene is decomposed into (Lee, Eisemann, Seidel 2009, §4.1, eq. 4).
//
// Layers are spaced evenly in vergence, that is in the signed radius of the circle of confusion, so that a lens ray
// travels equally far in each. Beyond the paper: only depths at which there is something get layers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "passes/scene_draw.h"
#include "shaders/shared/emit.h"

namespace lensgraph::passes::multiview_synthesis {

struct LayerSpacing {
  double pixelsPerVergence = 1.0;  ///< px·m: how far a ray moves across the picture per 1/m; K times its |v|.
  double travel = 3.0;             ///< δ, px: most that a ray travels in one layer, if that many layers are allowed.
  double smallestGap = 0.0;        ///< px: gaps narrower than this, by the same measure, are not worth a layer border.
  uint32_t fixedCount = 0;         ///< As many layers as this, whatever they span; 0: as many as `travel` asks for.
  uint32_t mostLayers = shared::kMaxSceneLayers;
};

/// Share of a layer by which its content reaches beyond each border into the neighbours (the paper's 10 %).
inline constexpr double kLayerOverlap = 0.1;

/// Layers that cover `occupied` (disjoint, nearest first), near side first. At least one, also for an empty scene.
/// Where intervals or their layers are more than allowed, the smallest gaps are closed and layers grow.
std::vector<shared::SceneLayer> sceneLayers(std::span<const VergenceInterval> occupied, const LayerSpacing& spacing);

}  // namespace lensgraph::passes::multiview_synthesis
