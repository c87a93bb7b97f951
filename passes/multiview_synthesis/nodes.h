// The nodes of the multiview synthesis, each a function from handles to handles.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "passes/dof_io.h"
#include "passes/multiview_synthesis/lens_rays.h"
#include "passes/multiview_synthesis/parameters.h"
#include "rendergraph/graph.h"
#include "shaders/shared/emit.h"

namespace lensgraph::passes::multiview_synthesis {

/// Triangles are split over at most this many layers (shaders/scene/layers.geom); with more, what is left moves after.
inline constexpr uint32_t kMostSplitLayers = 32;

/// What all nodes of one view need.
struct ViewPlan {
  std::string prefix;  ///< Of pass and resource names.
  DofInputs inputs;
  Parameters parameters;
  LensView view;
  uint32_t number = 0;   ///< Of the view, and so of its layer table.
  uint32_t rayBase = 0;  ///< Where its rays begin in the table of all views' rays.
  std::vector<shared::SceneLayer> layers;
  VkExtent2D size;            ///< px, of the layers; a multiple of the cells and of the coarsest mip level's texels.
  shared::ivec2 border;       ///< px of the layers to the left of and above the picture.
  bool raysMayLeave = false;  ///< Some rays reach beyond the layers.
  std::optional<SceneShading> shading;  ///< Set: hits are shaded as seen from their ray's lens point.
  uint32_t mips = 1;                    ///< Of the layers' colour.
  float coneDiameter = 0.0f;            ///< λ, px per px of |c|; 0: lines.

  uint32_t layerCount() const { return static_cast<uint32_t>(layers.size()); }
  /// Slices of the layer images: opaque layers, then, where anything is transparent, as many transparent ones.
  uint32_t sliceCount() const { return layerCount() * (inputs.scene->hasTransparency ? 2 : 1); }
  VkExtent2D cells() const;
};

/// The tables that the shaders read, of all views.
struct Tables {
  rendergraph::Buffer layers, rays;
};

/// The scene in layers.
struct LayerImages {
  rendergraph::Image color;  ///< RGBA16F array with mips: premultiplied radiance and coverage.
  rendergraph::Image gloss,
      facing;                    ///< For shading: RGBA16F arrays of the opaque layers, with mips (emit.h says what).
  rendergraph::Image height;     ///< R32F array: the depth buffer's value; 0 where a layer is empty.
  rendergraph::Buffer occupied;  ///< N-buffer: per level and cell a bit for each slice that holds anything.
};

Tables declareUpload(rendergraph::Graph& graph, std::span<const ViewPlan> plans);
LayerImages declareDecompose(rendergraph::Graph& graph, const ViewPlan& plan, const Tables& tables,
                             rendergraph::Buffer& statistics);
/// Which slices the rays of each cell may hit.
rendergraph::Buffer declareCulling(rendergraph::Graph& graph, const ViewPlan& plan, const Tables& tables,
                                   LayerImages& images);
void declareMips(rendergraph::Graph& graph, const ViewPlan& plan, const Tables& tables, LayerImages& images);
/// Adds the view's rays to the picture; the first view starts it, the last one finishes it.
rendergraph::Image declareTrace(rendergraph::Graph& graph, const ViewPlan& plan, const Tables& tables,
                                const LayerImages& images, rendergraph::Buffer visits, rendergraph::Image picture,
                                bool isFirst, bool isLast);

}  // namespace lensgraph::passes::multiview_synthesis
