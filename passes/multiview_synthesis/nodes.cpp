// Nodes of the multiview synthesis. What they compute is in shaders/multiview_synthesis.
#include "passes/multiview_synthesis/nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "passes/lens/lens_view.h"
#include "passes/nodes/scene_view.h"
#include "rendergraph/compute_pass.h"
#include "shaders/shared/multiview_synthesis.h"
#include "spirv/multiview_synthesis/dilate_comp.h"
#include "spirv/multiview_synthesis/mip_comp.h"
#include "spirv/multiview_synthesis/redistribute_comp.h"
#include "spirv/multiview_synthesis/trace_comp.h"
#include "spirv/multiview_synthesis/trace_shaded_comp.h"
#include "spirv/multiview_synthesis/visit_comp.h"

namespace lensgraph::passes::multiview_synthesis {
namespace {

using rendergraph::Buffer;
using rendergraph::ComputeProgram;
using rendergraph::Graph;
using rendergraph::groupsFor;
using rendergraph::Image;
using rendergraph::PassContext;
using rendergraph::PassKind;
using rendergraph::Usage;

const ComputeProgram kRedistribute{"multiview_synthesis.redistribute", multiview_synthesis_redistribute_comp};
const ComputeProgram kDilate{"multiview_synthesis.dilate", multiview_synthesis_dilate_comp};
const ComputeProgram kVisit{"multiview_synthesis.visit", multiview_synthesis_visit_comp};
const ComputeProgram kMip{"multiview_synthesis.mip", multiview_synthesis_mip_comp};
const ComputeProgram kTrace{"multiview_synthesis.trace", multiview_synthesis_trace_comp};
const ComputeProgram kTraceShaded{"multiview_synthesis.trace_shaded", multiview_synthesis_trace_shaded_comp};

/// Half the bytes of full floats; the layers are the technique's memory. Radiance is limited to 65504.
constexpr VkFormat kColorFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kHeightFormat = VK_FORMAT_R32_SFLOAT;
constexpr VkImageViewType kArray = VK_IMAGE_VIEW_TYPE_2D_ARRAY;

/// A bit for each slice.
using SliceMask = shared::uvec2;

VkDeviceSize maskBytes(const ViewPlan& plan, uint32_t levels) {
  return VkDeviceSize{levels} * plan.cells().width * plan.cells().height * sizeof(SliceMask);
}

shared::ivec2 signedExtent(VkExtent2D extent) {
  return {static_cast<int32_t>(extent.width), static_cast<int32_t>(extent.height)};
}

/// The layers' view: that of the pinhole, from the view's lens point, on a picture that is larger all around.
shared::ViewConstants layerView(const ViewPlan& plan) {
  DofInputs wider = plan.inputs;
  wider.extent = plan.size;
  const auto shift = [](int32_t border, uint32_t inner, uint32_t outer) {
    return static_cast<float>(border) + 0.5f * static_cast<float>(inner) - 0.5f * static_cast<float>(outer);
  };
  const auto& [x, y] = plan.view.pixelOffset;
  auto view = viewFromLens(wider, plan.view.lens,
                           {x + shift(plan.border.x, plan.inputs.extent.width, plan.size.width),
                            y + shift(plan.border.y, plan.inputs.extent.height, plan.size.height)});
  view.lensPoint.w = static_cast<float>(plan.number);
  return view;
}

/// Draws the surfaces of an emit into a range of slices of the colour attachments and of depth.
void declareDraw(Graph& graph, const ViewPlan& plan, const Tables& tables, shared::SceneEmit emit, const char* name,
                 uint32_t firstSlice, std::span<Image* const> colors, Image& depth) {
  const rendergraph::Subresources slices{.mipCount = 1, .firstLayer = firstSlice, .layerCount = plan.layerCount()};
  auto pass = graph.addPass(plan.prefix + name, PassKind::raster);
  pass.read(tables.layers, Usage::storage, VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT);
  for (Image* color : colors) *color = pass.color(*color, {.range = slices});
  depth = pass.depth(depth, {.range = slices});
  pass.record([scene = plan.inputs.scene, extent = plan.size, view = layerView(plan), layers = tables.layers,
               emit](PassContext& context) {
    const std::array bindings = {rendergraph::storage(layers)};
    scene->record(context, {.emit = emit, .view = view, .extent = extent, .emitBindings = bindings});
  });
}

void declareRedistribute(Graph& graph, const ViewPlan& plan, const Tables& tables, Image depth, LayerImages& images,
                         Buffer& statistics) {
  const bool moves = !plan.parameters.splitTriangles || plan.layerCount() > kMostSplitLayers;
  const shared::RedistributePush push{.size = signedExtent(plan.size),
                                      .table = plan.number,
                                      .sliceCount = plan.sliceCount(),
                                      .layerCount = plan.layerCount(),
                                      .vergenceScale = plan.inputs.lens.vergenceScale,
                                      .vergenceOffset = plan.inputs.lens.vergenceOffset};
  compute(graph, plan.prefix + ".redistribute", kRedistribute)
      .sample(depth, rendergraph::kNearest, {}, kArray)
      .read(tables.layers)
      .modify(images.color, rendergraph::mip(0), kArray)
      .write(images.height, {}, kArray)
      .write(images.occupied)
      .modify(statistics)
      .push(push)
      .specialize({moves})
      .groups(groupsFor(plan.size, shared::kMultiviewTile));
}

/// Largest |c| that any layer's content has, px.
float largestCoc(const ViewPlan& plan) {
  const auto& lens = plan.inputs.lens;
  const auto radius = [&](float vergence) { return lens.cocScale * std::abs(lens.focusVergence - vergence); };
  return std::max(radius(plan.layers.front().nearest), radius(plan.layers.back().farthest));
}

/// Highest level of the N-buffer: windows are as wide as the widest spread of rays, in cells.
uint32_t highestLevel(const ViewPlan& plan, float rayReach) {
  const float widest = 2.0f * std::ceil(largestCoc(plan) * rayReach + 2.0f) + shared::kMultiviewCell;
  const float cells = std::min(std::ceil(widest / shared::kMultiviewCell) + 1.0f,
                               static_cast<float>(std::max(plan.cells().width, plan.cells().height)));
  return static_cast<uint32_t>(std::floor(std::log2(std::max(cells, 1.0f))));
}

/// How far from the view's lens point a ray and the cone around it reach.
float rayReach(const ViewPlan& plan) {
  return plan.view.reach + 2.0f * plan.coneDiameter;  // A trilinear look-up reads two of its texels to each side.
}

}  // namespace

VkExtent2D ViewPlan::cells() const {
  return {size.width / shared::kMultiviewCell, size.height / shared::kMultiviewCell};
}

Tables declareUpload(Graph& graph, std::span<const ViewPlan> plans) {
  std::vector<shared::SceneLayerTable> layers(plans.size());
  std::vector<shared::LensRay> rays;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    layers[i].layerCount = plans[i].layerCount();
    layers[i].splitTriangles = plans[i].parameters.splitTriangles ? 1u : 0u;
    std::ranges::copy(plans[i].layers, layers[i].layers);
    rays.insert(rays.end(), plans[i].view.rays.begin(), plans[i].view.rays.end());
  }
  Tables tables;
  tables.layers = graph.createBuffer("multiview_synthesis.layers", {.size = std::as_bytes(std::span(layers)).size()});
  tables.rays = graph.createBuffer("multiview_synthesis.rays", {.size = std::as_bytes(std::span(rays)).size()});
  auto pass = graph.addPass("multiview_synthesis.upload", PassKind::transfer);
  tables.layers = pass.write(tables.layers, Usage::transferDestination);
  tables.rays = pass.write(tables.rays, Usage::transferDestination);
  pass.record([tables, layers = std::move(layers), rays = std::move(rays)](PassContext& context) {
    context.updateBuffer(tables.layers, std::as_bytes(std::span(layers)));
    context.updateBuffer(tables.rays, std::as_bytes(std::span(rays)));
  });
  return tables;
}

LayerImages declareDecompose(Graph& graph, const ViewPlan& plan, const Tables& tables, Buffer& statistics) {
  const uint32_t opaque = plan.layerCount(), slices = plan.sliceCount();
  const auto image = [&](const char* name, VkFormat format, uint32_t layers, uint32_t mips) {
    return graph.createImage(
        plan.prefix + name,
        {.format = format, .width = plan.size.width, .height = plan.size.height, .layers = layers, .mips = mips});
  };
  LayerImages images;
  images.color = image(".layer_color", kColorFormat, slices, plan.mips);
  images.height = image(".layer_height", kHeightFormat, slices, 1);
  images.occupied =
      graph.createBuffer(plan.prefix + ".occupied", {.size = maskBytes(plan, highestLevel(plan, rayReach(plan)) + 1)});
  Image depth = image(".layer_depth", kViewDepthFormat, slices, 1);
  if (plan.shading) {
    images.gloss = image(".layer_gloss", kColorFormat, opaque, plan.mips);
    images.facing = image(".layer_facing", kColorFormat, opaque, plan.mips);
    const std::array colors = {&images.color, &images.gloss, &images.facing};
    declareDraw(graph, plan, tables, shared::SceneEmit::opaqueSurfaceLayers, ".decompose", 0, colors, depth);
  } else {
    const std::array colors = {&images.color};
    declareDraw(graph, plan, tables, shared::SceneEmit::opaqueLayers, ".decompose", 0, colors, depth);
  }
  if (slices > opaque) {
    const std::array colors = {&images.color};
    declareDraw(graph, plan, tables, shared::SceneEmit::transparentLayers, ".decompose_transparent", opaque, colors,
                depth);
  }
  declareRedistribute(graph, plan, tables, depth, images, statistics);
  return images;
}

Buffer declareCulling(Graph& graph, const ViewPlan& plan, const Tables& tables, LayerImages& images) {
  const auto cells = plan.cells();
  const auto groups = groupsFor(cells, shared::kMultiviewTile);
  const uint32_t highest = highestLevel(plan, rayReach(plan));
  for (uint32_t level = 1; level <= highest; ++level) {
    const shared::DilatePush push{.cells = signedExtent(cells), .level = level};
    compute(graph, plan.prefix + ".n_buffer" + std::to_string(level), kDilate)
        .modify(images.occupied)
        .push(push)
        .groups(groups);
  }
  Buffer visits = graph.createBuffer(plan.prefix + ".visits", {.size = maskBytes(plan, 1)});
  const shared::VisitPush push{.cells = signedExtent(cells),
                               .table = plan.number,
                               .layerCount = plan.layerCount(),
                               .highestLevel = highest,
                               .cocScale = plan.inputs.lens.cocScale,
                               .focusVergence = plan.inputs.lens.focusVergence,
                               .rayReach = rayReach(plan),
                               .hasTransparency = plan.sliceCount() > plan.layerCount() ? 1u : 0u};
  compute(graph, plan.prefix + ".cull", kVisit)
      .read(images.occupied)
      .read(tables.layers)
      .write(visits)
      .push(push)
      .groups(groups);
  return visits;
}

namespace {

void declareMipsOf(Graph& graph, const ViewPlan& plan, const Tables& tables, const char* name, uint32_t slices,
                   Image& image) {
  for (uint32_t level = 1; level < plan.mips; ++level) {
    const VkExtent2D extent = {plan.size.width >> level, plan.size.height >> level};
    const shared::MipPush push{.size = signedExtent(extent),
                               .level = level,
                               .table = plan.number,
                               .layerCount = plan.layerCount(),
                               .cocScale = plan.inputs.lens.cocScale,
                               .focusVergence = plan.inputs.lens.focusVergence,
                               .coneDiameter = plan.coneDiameter};
    auto groups = groupsFor(extent, shared::kMultiviewTile);
    groups.z = slices;
    compute(graph, plan.prefix + name + std::to_string(level), kMip)
        .read(image, rendergraph::mip(level - 1), kArray)
        .write(image, rendergraph::mip(level), kArray)
        .read(tables.layers)
        .push(push)
        .groups(groups);
  }
}

}  // namespace

void declareMips(Graph& graph, const ViewPlan& plan, const Tables& tables, LayerImages& images) {
  declareMipsOf(graph, plan, tables, ".mip", plan.sliceCount(), images.color);
  if (!plan.shading) return;
  declareMipsOf(graph, plan, tables, ".gloss_mip", plan.layerCount(), images.gloss);
  declareMipsOf(graph, plan, tables, ".facing_mip", plan.layerCount(), images.facing);
}

namespace {

/// Rays of one dispatch. Devices may end an invocation's loops after 65 535 iterations in all, silently.
uint32_t raysPerDispatch(const ViewPlan& plan) {
  constexpr float kIterations = 60000.0f;
  float looks = static_cast<float>(plan.parameters.iterations + 4);
  if (plan.parameters.search == Search::scan) {
    float thickest = 0.0f;
    for (const auto& layer : plan.layers) thickest = std::max(thickest, layer.borders.x - layer.borders.y);
    looks = 2.0f * plan.inputs.lens.cocScale * plan.view.reach * thickest + 4.0f;
  }
  const float perRay = static_cast<float>(plan.sliceCount()) * (looks + 1.0f) + 1.0f;
  return static_cast<uint32_t>(std::max(kIterations / perRay, 1.0f));
}

}  // namespace

Image declareTrace(Graph& graph, const ViewPlan& plan, const Tables& tables, const LayerImages& images, Buffer visits,
                   Image picture, bool isFirst, bool isLast) {
  const uint32_t most = raysPerDispatch(plan);
  const uint32_t total = plan.view.raysPerPixel;
  const auto& [lens, aperture] = std::pair(plan.inputs.lens, plan.inputs.aperture);
  const auto& background = plan.inputs.background;
  const rendergraph::SamplerDesc bilinear{};  // Of the nearest level: half the price of trilinear, SSIM within 0.003.
  const rendergraph::SamplerDesc around{.mipmap = VK_SAMPLER_MIPMAP_MODE_LINEAR,
                                        .address = VK_SAMPLER_ADDRESS_MODE_REPEAT};
  for (uint32_t first = 0; first < total; first += most) {
    const bool starts = isFirst && first == 0;
    const bool ends = isLast && first + most >= total;
    const std::string part = total > most ? ".trace" + std::to_string(first / most) : ".trace";
    const shared::TracePush push{.aperture = aperture,
                                 .size = signedExtent(plan.size),
                                 .border = plan.border,
                                 .extent = {plan.inputs.extent.width, plan.inputs.extent.height},
                                 .viewPoint = plan.view.lens,
                                 .background = {background[0], background[1], background[2]},
                                 .table = plan.number,
                                 .layerCount = plan.layerCount(),
                                 .rayBase = plan.rayBase,
                                 .rayTotal = static_cast<uint32_t>(plan.view.rays.size()),
                                 .firstRay = first,
                                 .rayCount = std::min(most, total - first),
                                 .flags = (starts ? shared::kTraceFirst : 0u) | (ends ? shared::kTraceLast : 0u),
                                 .cocScale = lens.cocScale,
                                 .focusVergence = lens.focusVergence,
                                 .vergenceScale = lens.vergenceScale,
                                 .coneDiameter = plan.coneDiameter,
                                 .noiseReach = noiseReach(static_cast<uint32_t>(plan.parameters.lensSamples)),
                                 .pixelsPerTangent = plan.inputs.projection.pixelsPerTangent};
    auto trace = compute(graph, plan.prefix + part, plan.shading ? kTraceShaded : kTrace);
    trace.sample(images.color, bilinear, {}, kArray).read(images.height, {}, kArray);
    trace.read(tables.layers).read(tables.rays);
    visits ? trace.read(visits) : trace.placeholder();
    starts ? trace.write(picture) : trace.modify(picture);
    if (plan.shading) {
      trace.sample(images.gloss, bilinear, {}, kArray).sample(images.facing, bilinear, {}, kArray);
      trace.sample(plan.shading->environment, around).read(plan.shading->lights).uniform(plan.shading->constants);
    }
    trace.push(push)
        .specialize({plan.parameters.jitter, plan.parameters.search, plan.parameters.iterations, plan.mips > 1,
                     plan.sliceCount() > plan.layerCount(), static_cast<bool>(visits), plan.raysMayLeave})
        .groups(groupsFor(plan.inputs.extent, shared::kMultiviewTile));
  }
  return picture;
}

}  // namespace lensgraph::passes::multiview_synthesis
