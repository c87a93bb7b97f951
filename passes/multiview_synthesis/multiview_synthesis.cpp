// The multiview synthesis as a technique: parameters, and the order of its nodes.
#include "passes/multiview_synthesis/multiview_synthesis.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "passes/multiview_synthesis/layers.h"
#include "passes/multiview_synthesis/nodes.h"
#include "passes/nodes/scene_view.h"
#include "passes/nodes/statistics.h"
#include "passes/pinhole/pinhole.h"

namespace lensgraph::passes::multiview_synthesis {
namespace {

constexpr const char* kPrefix = "multiview_synthesis";

/// The layers reach at most this far beyond the picture, as a share of its longer side.
constexpr double kWidestBorder = 0.5;

/// The paper's mean distance between lens samples, 0.137 for 32, and as it shrinks with more.
double coneDiameterOf(const Parameters& parameters) {
  return parameters.coneWidth * 0.137 * std::sqrt(32.0 / parameters.lensSamples);
}

uint32_t roundedUp(double value, uint32_t multiple) {
  return static_cast<uint32_t>(std::ceil(value / multiple)) * multiple;
}

/// Largest |c| that any layer's content or the background has, px.
double largestBlur(const shared::LensConstants& lens, std::span<const shared::SceneLayer> layers) {
  const auto blur = [&](float vergence) { return double{lens.cocScale} * std::abs(lens.focusVergence - vergence); };
  return std::max(blur(layers.front().nearest), blur(0.0f));
}

uint32_t mostLayers(const SceneDraw& scene, const Parameters& parameters) {
  if (parameters.viewDependent) return kMostSplitLayers;
  return shared::kMaxSceneLayers / (scene.hasTransparency ? 2 : 1);
}

ViewPlan viewPlan(const DofInputs& inputs, const Parameters& parameters, const std::optional<SceneShading>& shading,
                  LensView view, std::string prefix) {
  ViewPlan plan;
  plan.prefix = std::move(prefix);
  plan.inputs = inputs;
  plan.parameters = parameters;
  plan.shading = shading;
  const auto& scene = *inputs.scene;
  const VergenceInterval whole{scene.farthestVergence, scene.nearestVergence};
  auto occupied = scene.occupied;
  if (occupied.empty() && whole.nearest > 0.0f) occupied = {&whole, 1};
  // All rays of a view may be one: through its own lens point, they do not travel at all.
  const double reach = std::max(static_cast<double>(view.reach), 1e-3);
  // A layer keeps one transparent surface. So where there are any, each border may save one, and views whose rays travel
  // less do not make do with fewer layers.
  const double spacingReach = scene.hasTransparency ? std::max(reach, 1.0) : reach;
  plan.layers = sceneLayers(occupied, {.pixelsPerVergence = inputs.lens.cocScale * spacingReach,
                                       .travel = parameters.delta,
                                       .smallestGap = scene.hasTransparency ? 0.0 : 0.25 * parameters.delta,
                                       .fixedCount = static_cast<uint32_t>(parameters.layers),
                                       .mostLayers = mostLayers(scene, parameters)});
  plan.view = std::move(view);

  plan.coneDiameter = static_cast<float>(coneDiameterOf(parameters));
  const double cone = std::min(plan.coneDiameter * largestBlur(inputs.lens, plan.layers), 256.0);
  plan.mips = cone > 1.0 ? 1 + static_cast<uint32_t>(std::ceil(std::log2(cone))) : 1;

  const auto [width, height] = inputs.extent;
  const double wanted = largestBlur(inputs.lens, plan.layers) * reach;
  const double border = std::min(parameters.border * wanted, kWidestBorder * std::max(width, height));
  plan.raysMayLeave = border < wanted;
  const auto side = static_cast<int32_t>(std::ceil(border) + 1.0);
  plan.border = {side, side};
  const uint32_t multiple = std::max(shared::kMultiviewCell, 1u << (plan.mips - 1));
  plan.size = {roundedUp(width + 2.0 * side, multiple), roundedUp(height + 2.0 * side, multiple)};
  return plan;
}

/// Without an aperture the views differ only in their pixel offsets, as those of the pinhole picture do.
pinhole::Parameters withoutLens(const Parameters& parameters) {
  return {.pixelSamples = parameters.views, .viewsPerFrame = 64, .pattern = parameters.pattern};
}

}  // namespace

std::span<const Field<Parameters>> fields() {
  static const std::vector<Field<Parameters>> table = {
      number<&Parameters::lensSamples>("lensSamples", "", 1, 4096, "Rays a pixel. Time grows with it."),
      number<&Parameters::delta>("delta", "px", 0.25, 64.0,
                                 "Most that a ray travels across the picture in one layer. Smaller finds more of what "
                                 "is hidden; halving it doubles layers and memory."),
      number<&Parameters::layers>("layers", "", 0, 64, "Number of layers; 0: as many as delta asks for."),
      number<&Parameters::iterations>("iterations", "", 1, 8, "Looks of the false position at a layer's surface."),
      choice<&Parameters::search, kSearchNames>(
          "search",
          "How a ray finds a layer's surface: falsePosition (the paper), which widens thin objects by up to delta; "
          "falsePositionInDepth, the same with depths, to compare; or scan, a look at every pixel on its way."),
      number<&Parameters::coneWidth>("coneWidth", "", 0.0, 8.0,
                                     "Diameter of the cones around rays, 1 being the paper's; 0 traces lines. Wider "
                                     "hides noise and softens what is hidden behind edges."),
      choice<&Parameters::jitter, kJitterNames>("jitter",
                                                "How rays differ from pixel to pixel: banding becomes noise."),
      number<&Parameters::views>("views", "", 1, 64,
                                 "Decompositions from points of the lens, each for the rays near it. More see more of "
                                 "what is hidden and antialias what is in focus; each costs one draw of the scene."),
      number<&Parameters::border>("border", "", 0.0, 1.0,
                                  "How far layers reach beyond the picture, in largest blur radii. Less saves memory "
                                  "and loses rays near the picture's edges."),
      toggle<&Parameters::splitTriangles>("splitTriangles",
                                          "Put triangles into every layer they cross, clipped; off, the paper: whole "
                                          "into the layer of the farthest vertex, where they may hide others."),
      toggle<&Parameters::viewDependent>("viewDependent",
                                         "Shade what a ray hits as seen from its lens point, so that gloss moves over "
                                         "surfaces as it does for a lens. Three times the memory for opaque layers, at "
                                         "most 32 layers; needs splitTriangles. Nothing changes for unlit scenes."),
      toggle<&Parameters::culling>("culling", "Skip layers where no ray can hit anything. Changes no picture."),
      choice<&Parameters::pattern, kLensPatternNames>("pattern", "Low-discrepancy pattern of the lens points."),
  };
  return table;
}

std::vector<Problem> validate(const Parameters& parameters, const DofInputs&) {
  std::vector<Problem> problems;
  if (parameters.views > parameters.lensSamples) {
    problems.push_back({"views", "there are more views than rays", "set views to lensSamples or less"});
  }
  if (parameters.viewDependent && !parameters.splitTriangles) {
    problems.push_back(
        {"viewDependent", "it needs triangles split at the layers' borders", "set splitTriangles to true"});
  }
  if (parameters.viewDependent && parameters.layers > static_cast<int>(kMostSplitLayers)) {
    problems.push_back({"viewDependent", "it allows 32 layers at most", "set layers to 32 or less"});
  }
  return problems;
}

DofOutputs declare(rendergraph::Graph& graph, const DofInputs& inputs, const Parameters& parameters) {
  if (inputs.lens.cocScale == 0.0f) return pinhole::declare(graph, inputs, withoutLens(parameters));
  auto views = lensViews({.aperture = inputs.aperture,
                          .rayCount = static_cast<uint32_t>(parameters.lensSamples),
                          .viewCount = static_cast<uint32_t>(parameters.views),
                          .pattern = parameters.pattern,
                          .jitter = parameters.jitter});
  DofOutputs out;
  out.statistics = declareStatistics(graph, kPrefix);
  const auto [width, height] = inputs.extent;
  out.color = graph.createImage(std::string(kPrefix) + ".color",
                                {.format = kViewColorFormat, .width = width, .height = height});
  std::optional<SceneShading> shading;
  if (parameters.viewDependent && inputs.scene->importShading) shading = inputs.scene->importShading(graph);
  std::vector<ViewPlan> plans;
  uint32_t rayCount = 0;
  for (LensView& view : views) {
    const auto number = static_cast<uint32_t>(plans.size());
    const std::string prefix = kPrefix + (views.size() > 1 ? ".view" + std::to_string(number) : std::string());
    plans.push_back(viewPlan(inputs, parameters, shading, std::move(view), prefix));
    plans.back().number = number;
    plans.back().rayBase = rayCount;
    rayCount += static_cast<uint32_t>(plans.back().view.rays.size());
  }
  const Tables tables = declareUpload(graph, plans);
  for (const ViewPlan& plan : plans) {
    LayerImages images = declareDecompose(graph, plan, tables, out.statistics);
    const auto visits = parameters.culling ? declareCulling(graph, plan, tables, images) : rendergraph::Buffer{};
    declareMips(graph, plan, tables, images);
    out.color =
        declareTrace(graph, plan, tables, images, visits, out.color, plan.number == 0, plan.number + 1 == plans.size());
  }
  return out;
}

namespace {

constexpr std::string_view kIgnoredLensFields[] = {"maxCocRadius"};  // Every view is a true one.

}  // namespace

Technique technique() {
  return makeTechnique<Parameters>(
      {.name = "multiview_synthesis",
       .title = "Multiview synthesis",
       .source = "Lee, Eisemann, Seidel 2009, Depth-of-Field Rendering with Multiview Synthesis",
       .input = TechniqueInput::scene,
       .fields = fields(),
       .ignoredLensFields = kIgnoredLensFields,
       .declare = declare,
       .validate = validate,
       .quick = {.views = 4},
       .quickPixelSamples = 4});
}

}  // namespace lensgraph::passes::multiview_synthesis
