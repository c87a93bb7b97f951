// The nodes of the multi-layer filtering, each a function from handles to handles.
#pragma once

#include <vulkan/vulkan_core.h>

#include "passes/dof_io.h"
#include "passes/multilayer_filtering/filter_levels.h"
#include "passes/multilayer_filtering/parameters.h"
#include "rendergraph/graph.h"

namespace lensgraph::passes::multilayer_filtering {

/// What all nodes need.
struct FramePlan {
  DofInputs inputs;
  Parameters parameters;
  LevelPlan levels;

  /// px, of the pixels' lists: the picture and what of its border is needed.
  VkExtent2D listExtent() const;
  bool hasCoverage() const { return inputs.scene->hasTransparency; }
  uint32_t reservedNodes() const;
  uint32_t nodeRoom() const;  ///< Nodes beyond the reserved ones.
  float mostSquare() const;   ///< px²: the lens's limit of |c|², infinity where there is none.
  uint32_t listRoom() const;  ///< Fragments of all lists of all levels.
};

/// Per-pixel linked lists.
struct LinkedLists {
  rendergraph::Image heads;
  rendergraph::Buffer nodes, allocator;
};

/// Lists as ranges of consecutive arrays, those of all levels one behind another. List i holds the fragments from
/// lists[i] to lists[i + 1].
struct FragmentLists {
  rendergraph::Buffer levels, looks;  ///< FilterLevel, one a level; FilterLook.
  rendergraph::Buffer lists, vergences, colors;
  rendergraph::Buffer coverages;  ///< Default-made where everything is opaque: coverage is alpha then.
};

/// One draw of the scene: `clear_lists`, `collect`.
LinkedLists declareCollect(rendergraph::Graph& graph, const FramePlan& plan);
/// Level 0: `upload`, `sort`, `scan0`, `compact`.
FragmentLists declareCompact(rendergraph::Graph& graph, const FramePlan& plan, LinkedLists& linked,
                             rendergraph::Buffer& statistics);
/// Level `level` ≥ 1 from the one before: `countK`, `scanK`, and `mipK` or `stackK`.
void declareFilter(rendergraph::Graph& graph, const FramePlan& plan, uint32_t level, FragmentLists& lists);
/// The picture: `accumulate`.
rendergraph::Image declareAccumulate(rendergraph::Graph& graph, const FramePlan& plan, const FragmentLists& lists,
                                     rendergraph::Buffer& statistics);

}  // namespace lensgraph::passes::multilayer_filtering
