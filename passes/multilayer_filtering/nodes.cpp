// Nodes of the multi-layer filtering. What they compute is in shaders/multilayer_filtering.
#include "passes/multilayer_filtering/nodes.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "passes/lens/lens_view.h"
#include "passes/nodes/prefix_sum.h"
#include "passes/nodes/scene_view.h"
#include "rendergraph/compute_pass.h"
#include "shaders/shared/emit.h"
#include "shaders/shared/multilayer_filtering.h"
#include "spirv/multilayer_filtering/accumulate_comp.h"
#include "spirv/multilayer_filtering/compact_comp.h"
#include "spirv/multilayer_filtering/count_comp.h"
#include "spirv/multilayer_filtering/merge_comp.h"
#include "spirv/multilayer_filtering/shown_comp.h"
#include "spirv/multilayer_filtering/sort_comp.h"

namespace lensgraph::passes::multilayer_filtering {
namespace {

using rendergraph::Buffer;
using rendergraph::ComputeProgram;
using rendergraph::Graph;
using rendergraph::groupsFor;
using rendergraph::Image;
using rendergraph::PassContext;
using rendergraph::PassKind;
using rendergraph::Usage;

const ComputeProgram kSort{"multilayer_filtering.sort", multilayer_filtering_sort_comp};
const ComputeProgram kCompact{"multilayer_filtering.compact", multilayer_filtering_compact_comp};
const ComputeProgram kCount{"multilayer_filtering.count", multilayer_filtering_count_comp};
const ComputeProgram kMerge{"multilayer_filtering.merge", multilayer_filtering_merge_comp};
const ComputeProgram kShown{"multilayer_filtering.shown", multilayer_filtering_shown_comp};
const ComputeProgram kAccumulate{"multilayer_filtering.accumulate", multilayer_filtering_accumulate_comp};

std::string named(const char* name) {
  return std::string("multilayer_filtering.") + name;
}

shared::ivec2 signedExtent(VkExtent2D extent) {
  return {static_cast<int32_t>(extent.width), static_cast<int32_t>(extent.height)};
}

uint32_t room(double perPixel, VkExtent2D extent, uint64_t most) {
  const double wanted = perPixel * extent.width * extent.height;
  return static_cast<uint32_t>(std::clamp(wanted, 1.0, static_cast<double>(most)));
}

/// The view of the lists' pixels: that of the pinhole, of pixels that may be finer, on a picture that is larger all around.
shared::ViewConstants listView(const FramePlan& plan) {
  DofInputs wider = plan.inputs;
  wider.extent = plan.listExtent();
  const uint32_t steps = plan.levels.looks.front().level;
  wider.projection.pixelsPerTangent *= static_cast<float>(1u << steps);
  const auto shift = [](int32_t first, uint32_t inner, uint32_t outer) {
    return static_cast<float>(-first) + 0.5f * static_cast<float>(inner) - 0.5f * static_cast<float>(outer);
  };
  const auto& first = plan.levels.levels.front().first;
  return viewFromLens(wider, {0.0f, 0.0f},
                      {shift(first.x, plan.inputs.extent.width << steps, wider.extent.width),
                       shift(first.y, plan.inputs.extent.height << steps, wider.extent.height)});
}

VkExtent2D extentOf(const shared::FilterLevel& level) {
  return {static_cast<uint32_t>(level.size.x), static_cast<uint32_t>(level.size.y)};
}

}  // namespace

VkExtent2D FramePlan::listExtent() const {
  return extentOf(levels.levels.front());
}

uint32_t FramePlan::reservedNodes() const {
  return listExtent().width * listExtent().height;
}

uint32_t FramePlan::nodeRoom() const {
  return room(inputs.scene->fragmentNodesPerPixel, inputs.extent, shared::kFragmentNextMask - 1 - reservedNodes());
}

uint32_t FramePlan::listRoom() const {
  return room(inputs.scene->listFragmentsPerPixel, inputs.extent, UINT32_MAX / sizeof(shared::uvec2));
}

float FramePlan::mostSquare() const {
  return inputs.lens.maxCocRadius * inputs.lens.maxCocRadius;
}

LinkedLists declareCollect(Graph& graph, const FramePlan& plan) {
  const VkExtent2D extent = plan.listExtent();
  const VkDeviceSize reserved = VkDeviceSize{plan.reservedNodes()} * sizeof(shared::FragmentNode);
  LinkedLists lists;
  lists.heads =
      graph.createImage(named("heads"), {.format = VK_FORMAT_R32_UINT, .width = extent.width, .height = extent.height});
  lists.nodes = graph.createBuffer(named("nodes"),
                                   {.size = reserved + VkDeviceSize{plan.nodeRoom()} * sizeof(shared::FragmentNode)});
  lists.allocator = graph.createBuffer(named("allocator"), {.size = sizeof(uint32_t)});
  auto clear = graph.addPass(named("clear_lists"), PassKind::transfer);
  lists.heads = clear.write(lists.heads, Usage::transferDestination);
  lists.nodes = clear.write(lists.nodes, Usage::transferDestination);
  lists.allocator = clear.write(lists.allocator, Usage::transferDestination);
  clear.record([lists, reserved](PassContext& context) {
    context.clearImage(lists.heads, VkClearColorValue{});
    context.fillBuffer(lists.nodes, shared::kFragmentPending, reserved);
    context.fillBuffer(lists.allocator, 0);
  });

  auto collect = graph.addPass(named("collect"), PassKind::raster);
  constexpr auto kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  collect.renderArea(extent);
  lists.heads = collect.modify(lists.heads, Usage::storage, {}, kFragment);
  lists.nodes = collect.modify(lists.nodes, Usage::storage, kFragment);
  lists.allocator = collect.modify(lists.allocator, Usage::storage, kFragment);
  const auto emit =
      plan.parameters.faces == Faces::front ? shared::SceneEmit::frontFragmentList : shared::SceneEmit::fragmentList;
  collect.record([scene = plan.inputs.scene, extent, view = listView(plan), lists, emit](PassContext& context) {
    const std::array bindings = {rendergraph::storage(lists.heads), rendergraph::storage(lists.nodes),
                                 rendergraph::storage(lists.allocator)};
    scene->record(context, {.emit = emit, .view = view, .extent = extent, .emitBindings = bindings});
  });
  return lists;
}

namespace {

FragmentLists declareUpload(Graph& graph, const FramePlan& plan) {
  const auto& levels = plan.levels.levels;
  const auto& looks = plan.levels.looks;
  FragmentLists lists;
  lists.levels = graph.createBuffer(named("levels"), {.size = std::as_bytes(std::span(levels)).size()});
  lists.looks = graph.createBuffer(named("looks"), {.size = std::as_bytes(std::span(looks)).size()});
  lists.lists = graph.createBuffer(named("lists"), {.size = plan.levels.listCount * sizeof(uint32_t)});
  const VkDeviceSize fragments = plan.listRoom();
  lists.vergences = graph.createBuffer(named("vergences"), {.size = fragments * sizeof(float)});
  lists.colors = graph.createBuffer(named("colors"), {.size = fragments * sizeof(shared::uvec2)});
  if (plan.hasCoverage()) {
    lists.coverages = graph.createBuffer(named("coverages"), {.size = fragments * sizeof(float)});
  }
  auto pass = graph.addPass(named("upload"), PassKind::transfer);
  lists.levels = pass.write(lists.levels, Usage::transferDestination);
  lists.looks = pass.write(lists.looks, Usage::transferDestination);
  pass.record([lists, levels, looks](PassContext& context) {
    context.updateBuffer(lists.levels, std::as_bytes(std::span(levels)));
    context.updateBuffer(lists.looks, std::as_bytes(std::span(looks)));
  });
  return lists;
}

void declareSort(Graph& graph, const FramePlan& plan, LinkedLists& linked, Buffer& counts, Buffer& statistics) {
  const auto length = static_cast<uint32_t>(plan.parameters.listLength);
  const bool outer = plan.parameters.faces == Faces::outer;
  // A solid gives two fragments, of which one stays.
  const uint32_t heap = outer ? 2 * length : length;
  compute(graph, named("sort"), kSort)
      .modify(linked.heads)
      .modify(linked.nodes)
      .write(counts)
      .modify(statistics)
      .specialize({length, heap, outer})
      .groups(groupsFor(plan.listExtent(), shared::kMultilayerTile));
}

}  // namespace

FragmentLists declareCompact(Graph& graph, const FramePlan& plan, LinkedLists& linked, Buffer& statistics) {
  FragmentLists lists = declareUpload(graph, plan);
  declareSort(graph, plan, linked, lists.lists, statistics);
  declarePrefixSum(graph, named("scan0"), lists.lists, {.count = plan.reservedNodes()});

  const shared::CompactPush push{.size = signedExtent(plan.listExtent()),
                                 .room = plan.listRoom(),
                                 .reservedNodes = plan.reservedNodes(),
                                 .lens = plan.inputs.lens};
  auto compact = compute(graph, named("compact"), kCompact);
  compact.read(linked.heads).read(linked.nodes).read(linked.allocator);
  compact.read(lists.lists).write(lists.vergences).write(lists.colors);
  plan.hasCoverage() ? compact.write(lists.coverages) : compact.placeholder();
  compact.modify(statistics)
      .push(push)
      .specialize({plan.hasCoverage()})
      .groups(groupsFor(plan.listExtent(), shared::kMultilayerTile));
  return lists;
}

void declareFilter(Graph& graph, const FramePlan& plan, uint32_t level, FragmentLists& lists) {
  const auto& made = plan.levels.levels[level];
  const std::string number = std::to_string(level);
  const auto groups = groupsFor(extentOf(made), shared::kMultilayerTile);
  const shared::FilterPush push{.level = level,
                                .room = plan.listRoom(),
                                .cocScale = plan.inputs.lens.cocScale,
                                .focusVergence = plan.inputs.lens.focusVergence,
                                .epsilon = static_cast<float>(plan.parameters.epsilon)};
  compute(graph, named("count") + number, kCount)
      .read(lists.levels)
      .modify(lists.lists)
      .read(lists.vergences)
      .push(push)
      .groups(groups);
  const auto cells = static_cast<uint32_t>(made.size.x * made.size.y);
  declarePrefixSum(graph, named("scan") + number, lists.lists,
                   {.first = made.firstList, .count = cells, .continues = true});

  auto merge = compute(graph, named(made.tapDistance == 0 ? "mip" : "stack") + number, kMerge);
  merge.read(lists.levels).read(lists.lists).modify(lists.vergences).modify(lists.colors);
  plan.hasCoverage() ? merge.modify(lists.coverages) : merge.placeholder();
  merge.push(push).specialize({plan.hasCoverage()}).groups(groups);
}

namespace {

/// Which looks each tile of the picture shows.
Buffer declareShown(Graph& graph, const FramePlan& plan, const FragmentLists& lists, rendergraph::Groups tiles) {
  Buffer shown = graph.createBuffer(named("shown_looks"), {.size = tiles.x * tiles.y * sizeof(uint32_t)});
  const VkExtent2D extent = {tiles.x, tiles.y};
  const shared::ShownPush push{.tiles = signedExtent(extent),
                               .lookCount = static_cast<uint32_t>(plan.levels.looks.size()),
                               .room = plan.listRoom(),
                               .cocScale = plan.inputs.lens.cocScale,
                               .focusVergence = plan.inputs.lens.focusVergence,
                               .mostSquare = plan.mostSquare()};
  compute(graph, named("shown"), kShown)
      .read(lists.levels)
      .read(lists.looks)
      .read(lists.lists)
      .read(lists.vergences)
      .write(shown)
      .push(push)
      .groups(groupsFor(extent, shared::kMultilayerTile));
  return shown;
}

}  // namespace

Image declareAccumulate(Graph& graph, const FramePlan& plan, const FragmentLists& lists, Buffer& statistics) {
  const auto& inputs = plan.inputs;
  const auto& parameters = plan.parameters;
  Image picture = graph.createImage(
      named("color"), {.format = kViewColorFormat, .width = inputs.extent.width, .height = inputs.extent.height});
  const auto tiles = groupsFor(inputs.extent, shared::kMultilayerTile);
  const Buffer shown = declareShown(graph, plan, lists, tiles);
  const shared::MultilayerAccumulatePush push{.size = signedExtent(inputs.extent),
                                              .tileColumns = tiles.x,
                                              .lastList = plan.levels.listCount - 1,
                                              .room = plan.listRoom(),
                                              .cocScale = inputs.lens.cocScale,
                                              .focusVergence = inputs.lens.focusVergence,
                                              .linkDistance = static_cast<float>(parameters.linkDistance),
                                              .red = inputs.background[0],
                                              .green = inputs.background[1],
                                              .blue = inputs.background[2],
                                              .nearLooks = plan.levels.nearLooks,
                                              .farLooks = plan.levels.farLooks,
                                              .mostSquare = plan.mostSquare()};
  // The paper's borders are where a level begins to show; ours, half of the way to where it shows alone.
  const float stepAt = parameters.levelMatch == LevelMatch::diameter ? 0.0f : 0.5f;
  const bool isRound = std::ranges::any_of(plan.levels.looks, [](const auto& look) { return look.ring > 0.0f; });
  auto accumulate = compute(graph, named("accumulate"), kAccumulate);
  accumulate.read(lists.levels).read(lists.looks).read(lists.lists).read(lists.vergences).read(lists.colors);
  plan.hasCoverage() ? accumulate.read(lists.coverages) : accumulate.placeholder();
  accumulate.read(shown)
      .write(picture)
      .modify(statistics)
      .push(push)
      .specialize({plan.hasCoverage(), parameters.interpolateLevels, parameters.bilinear,
                   parameters.blend == Blend::additive, stepAt, isRound})
      .groups(tiles);
  return picture;
}

}  // namespace lensgraph::passes::multilayer_filtering
