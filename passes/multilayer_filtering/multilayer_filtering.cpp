// The multi-layer filtering as a technique: parameters, and the order of its nodes.
#include "passes/multilayer_filtering/multilayer_filtering.h"

#include <algorithm>

#include "passes/lens/lens_samples.h"
#include "passes/multilayer_filtering/nodes.h"
#include "passes/nodes/scene_view.h"
#include "passes/nodes/statistics.h"
#include "passes/pinhole/pinhole.h"

namespace lensgraph::passes::multilayer_filtering {
namespace {

/// Lists reach at most this far beyond the picture, as a share of its longer side.
constexpr double kWidestBorder = 0.5;

/// Variance of the aperture's light along an axis (mean of both), in units of the lens radius squared. Box filters know
/// nothing else of its shape.
double apertureMoment(const shared::ApertureShape& aperture) {
  if (aperture.gaussian != 0) return 0.5 * (aperture.anamorphicRatio + 1.0 / aperture.anamorphicRatio);
  constexpr uint32_t kPoints = 256;
  double sum = 0.0, weights = 0.0;
  for (uint32_t i = 0; i < kPoints; ++i) {
    const LensSample sample = lensSample(aperture, LensPattern::sobol, i, false);
    sum += sample.weight * 0.5 * (sample.v.x * sample.v.x + sample.v.y * sample.v.y);
    weights += sample.weight;
  }
  return sum / weights;
}

/// s: lists have 2^s × 2^s pixels for each of the picture's.
int subpixelSteps(Antialiasing antialiasing) {
  switch (antialiasing) {
    case Antialiasing::none:
      return 0;
    case Antialiasing::points2x2:
      return 1;
    case Antialiasing::points4x4:
      return 2;
  }
  return 0;
}

FramePlan framePlan(const DofInputs& inputs, const Parameters& parameters) {
  const auto& lens = inputs.lens;
  const auto blur = [&](float vergence) { return double{lens.cocScale} * (lens.focusVergence - vergence); };
  LevelRequest request;
  request.extent = inputs.extent;
  request.nearCoc = std::clamp(-blur(inputs.scene->nearestVergence), 0.0, double{lens.maxCocRadius});
  request.farCoc = std::clamp(blur(inputs.scene->farthestVergence), 0.0, double{lens.maxCocRadius});
  request.subpixelSteps = subpixelSteps(parameters.antialiasing);
  request.mipSteps = parameters.mipSteps;
  request.stackSteps = parameters.stackSteps;
  request.border = std::min(parameters.border * std::max(request.nearCoc, request.farCoc),
                            kWidestBorder * std::max(inputs.extent.width, inputs.extent.height));
  request.apertureMoment = apertureMoment(inputs.aperture);
  request.kernel = parameters.kernel;
  request.match = parameters.levelMatch;
  request.bilinear = parameters.bilinear;
  request.truncate = parameters.truncation;
  return {.inputs = inputs, .parameters = parameters, .levels = planLevels(request)};
}

}  // namespace

std::span<const Field<Parameters>> fields() {
  static const std::vector<Field<Parameters>> table = {
      number<&Parameters::listLength>("listLength", "", 1, 16,
                                      "n: fragments of a pixel that are kept, nearest first. More show more of what is "
                                      "hidden; time and memory of lists grow."),
      number<&Parameters::mipSteps>("mipSteps", "", 0, 13,
                                    "a of the filter configuration a/b: first filter steps, which halve the "
                                    "resolution. More are faster and coarser."),
      number<&Parameters::stackSteps>(
          "stackSteps", "", -1, 10,
          "b: further filter steps, which keep the resolution. -1: as many as the blur asks "
          "for; fewer limit the blur."),
      number<&Parameters::epsilon>("epsilon", "", 0.0, 4.0,
                                   "Fragments are merged while their blur radii differ by less than this share. "
                                   "Larger makes shorter lists and joins surfaces."),
      number<&Parameters::linkDistance>("linkDistance", "", 0.0, 4.0,
                                        "Gap in blur radius, as a share of it, up to which fragments that follow one "
                                        "another are of one surface and add up."),
      choice<&Parameters::blend, kBlendNames>("blend",
                                              "How surfaces are composited: over, or additive (the paper), which "
                                              "over-estimates opacity where three layers meet."),
      choice<&Parameters::kernel, kKernelNames>(
          "kernel",
          "The shape of large blurs: round, of eight boxes of a stack step's level, with levelMatch moments; or "
          "box, squares (the paper), faster."),
      choice<&Parameters::levelMatch, kLevelMatchNames>(
          "levelMatch",
          "Which filter stands for a circle of confusion: that of equal second moment, or that whose side is "
          "the diameter (the paper)."),
      choice<&Parameters::antialiasing, kAntialiasingNames>(
          "antialiasing",
          "Points of a pixel at which surfaces are seen: 2x2 and 4x4 collect 4 and 16 times as much and "
          "smooth edges in focus."),
      toggle<&Parameters::interpolateLevels>("interpolateLevels", "Blend between levels; off shows steps."),
      toggle<&Parameters::bilinear>("bilinear", "Look up four cells of a level; off is faster and blocky."),
      toggle<&Parameters::truncation>("truncation",
                                      "Drop fragments that neither a level nor a coarser one shows. Saves time."),
      choice<&Parameters::faces, kFacesNames>(
          "faces",
          "Fragments that lists hold: outer, both faces but for the insides of opaque "
          "solids; all; front, those that face the camera (the paper)."),
      number<&Parameters::border>("border", "", 0.0, 1.0,
                                  "How far lists reach beyond the picture, in largest blur radii. 0, the paper, saves "
                                  "memory and repeats the picture's edge."),
  };
  return table;
}

DofOutputs declare(rendergraph::Graph& graph, const DofInputs& inputs, const Parameters& parameters) {
  if (inputs.lens.cocScale == 0.0f) {
    return pinhole::declare(graph, inputs,
                            {.pixelSamples = 1 << (2 * subpixelSteps(parameters.antialiasing)), .viewsPerFrame = 64});
  }
  const FramePlan plan = framePlan(inputs, parameters);
  DofOutputs out;
  out.statistics = declareStatistics(graph, "multilayer_filtering");
  LinkedLists linked = declareCollect(graph, plan);
  FragmentLists lists = declareCompact(graph, plan, linked, out.statistics);
  for (uint32_t level = 1; level < plan.levels.levels.size(); ++level) declareFilter(graph, plan, level, lists);
  out.color = declareAccumulate(graph, plan, lists, out.statistics);
  return out;
}

namespace {

// Blurs have the aperture's second moment, which the others do not change.
constexpr std::string_view kIgnoredLensFields[] = {"bladeRotation", "opticalVignetting"};
constexpr std::string_view kSizeOnlyLensFields[] = {"bladeCount", "bladeCurvature", "anamorphicRatio",
                                                    "sphericalAberration"};

}  // namespace

Technique technique() {
  return makeTechnique<Parameters>(
      {.name = "multilayer_filtering",
       .title = "Multi-layer filtering",
       .source =
           "Selgrad, Reintges, Penk, Wagner, Stamminger 2015, Real-time Depth of Field using Multi-Layer Filtering",
       .input = TechniqueInput::scene,
       .fields = fields(),
       .ignoredLensFields = kIgnoredLensFields,
       .sizeOnlyLensFields = kSizeOnlyLensFields,
       .declare = declare,
       .quick = {.antialiasing = Antialiasing::points2x2},
       .quickPixelSamples = 4});
}

}  // namespace lensgraph::passes::multilayer_filtering
