// Nodes of one view. Transparency is exact and independent of draw order: all alpha-blended fragments in front of the
// opaque surface are collected in per-pixel lists, sorted, and composited (an A-buffer, Carpenter 1984).
#include "passes/nodes/scene_view.h"

#include <algorithm>
#include <array>

#include "rendergraph/compute_pass.h"
#include "shaders/shared/emit.h"
#include "shaders/shared/transparency.h"
#include "spirv/transparency/composite_comp.h"

namespace lensgraph::passes {
namespace {

using rendergraph::Buffer;
using rendergraph::Graph;
using rendergraph::Image;
using rendergraph::PassContext;
using rendergraph::PassKind;
using rendergraph::Usage;

const rendergraph::ComputeProgram kComposite{"transparency.composite", transparency_composite_comp};

struct Lists {
  Image heads;
  Buffer nodes;
  Buffer allocator;
};

VkDeviceSize nodeBytes(const DofInputs& inputs) {
  const double pixels = static_cast<double>(inputs.extent.width) * inputs.extent.height;
  const double nodes = std::max(1.0, pixels * inputs.scene->transparentNodesPerPixel);
  return static_cast<VkDeviceSize>(nodes) * sizeof(shared::TransparentNode);
}

Lists declareCollect(Graph& graph, const DofInputs& inputs, const std::string& prefix,
                     const shared::ViewConstants& view, Image depth) {
  Lists lists;
  lists.heads = graph.createImage(
      prefix + ".heads", {.format = VK_FORMAT_R32_UINT, .width = inputs.extent.width, .height = inputs.extent.height});
  lists.nodes = graph.createBuffer(prefix + ".nodes", {.size = nodeBytes(inputs)});
  lists.allocator = graph.createBuffer(prefix + ".allocator", {.size = sizeof(uint32_t)});
  auto clear = graph.addPass(prefix + ".clear_lists", PassKind::transfer);
  lists.heads = clear.write(lists.heads, Usage::transferDestination);
  lists.allocator = clear.write(lists.allocator, Usage::transferDestination);
  clear.record([lists](PassContext& context) {
    context.clearImage(lists.heads, VkClearColorValue{});
    context.fillBuffer(lists.allocator, 0);
  });

  auto collect = graph.addPass(prefix + ".transparent", PassKind::raster);
  collect.depthReadOnly(depth);
  constexpr auto kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  lists.heads = collect.modify(lists.heads, Usage::storage, {}, kFragment);
  lists.nodes = collect.write(lists.nodes, Usage::storage, kFragment);
  lists.allocator = collect.modify(lists.allocator, Usage::storage, kFragment);
  collect.record([scene = inputs.scene, extent = inputs.extent, view, lists](PassContext& context) {
    const std::array bindings = {rendergraph::storage(lists.heads), rendergraph::storage(lists.nodes),
                                 rendergraph::storage(lists.allocator)};
    scene->record(
        context,
        {.emit = shared::SceneEmit::transparentList, .view = view, .extent = extent, .emitBindings = bindings});
  });
  return lists;
}

void declareComposite(Graph& graph, const DofInputs& inputs, const std::string& prefix, const Lists& lists,
                      SceneViewOutputs& out) {
  compute(graph, prefix + ".composite", kComposite)
      .modify(out.color)
      .read(lists.heads)
      .read(lists.nodes)
      .read(lists.allocator)
      .modify(out.statistics)
      .groups(rendergraph::groupsFor(inputs.extent, shared::kTransparencyTile));
}

}  // namespace

SceneViewOutputs declareSceneView(Graph& graph, const DofInputs& inputs, const std::string& prefix,
                                  const shared::ViewConstants& view, Buffer statistics) {
  const auto [width, height] = inputs.extent;
  SceneViewOutputs out;
  out.statistics = statistics;
  out.color = graph.createImage(prefix + ".color", {.format = kViewColorFormat, .width = width, .height = height});
  out.depth = graph.createImage(prefix + ".depth", {.format = kViewDepthFormat, .width = width, .height = height});

  auto opaque = graph.addPass(prefix + ".opaque", PassKind::raster);
  const auto& b = inputs.background;
  out.color = opaque.color(out.color, {.clear = {.float32 = {b[0], b[1], b[2], 1.0f}}});
  out.depth = opaque.depth(out.depth);
  opaque.record([scene = inputs.scene, extent = inputs.extent, view](PassContext& context) {
    scene->record(context,
                  {.emit = shared::SceneEmit::opaqueRadiance, .view = view, .extent = extent, .emitBindings = {}});
  });
  if (!inputs.scene->hasTransparency) return out;

  declareComposite(graph, inputs, prefix, declareCollect(graph, inputs, prefix, view, out.depth), out);
  return out;
}

}  // namespace lensgraph::passes
