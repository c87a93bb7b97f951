// Nodes of the accumulation reference.
#include "passes/accumulation/accumulation.h"

#include <vector>

#include "passes/nodes/scene_view.h"
#include "passes/nodes/view_mean.h"
#include "passes/pinhole/pinhole.h"

namespace lensgraph::passes::accumulation {
namespace {

ViewMean meanOf(const Parameters& parameters, const shared::ApertureShape& aperture) {
  return {.prefix = "accumulation",
          .viewCount = static_cast<uint32_t>(parameters.lensSamples),
          .viewsPerFrame = static_cast<uint32_t>(parameters.viewsPerFrame),
          .sample = [aperture, parameters](uint32_t view) {
            return lensSample(aperture, parameters.pattern, view, parameters.pixelJitter);
          }};
}

/// Without an aperture the views differ only in their pixel offsets, as those of the pinhole picture do.
pinhole::Parameters withoutLens(const Parameters& parameters) {
  return {.pixelSamples = parameters.pixelJitter ? parameters.lensSamples : 1,
          .viewsPerFrame = parameters.viewsPerFrame,
          .pattern = parameters.pattern};
}

}  // namespace

std::span<const Field<Parameters>> fields() {
  static const std::vector<Field<Parameters>> table = {
      number<&Parameters::lensSamples>("lensSamples", "", 1, 65536,
                                       "Views from points of the lens; each costs one draw of the scene."),
      toggle<&Parameters::pixelJitter>("pixelJitter", "Also average over the pixel's square (box filter of 1 px)."),
      toggle<&Parameters::gaussian>("gaussian",
                                    "Gaussian lens with sigma = lens radius instead of the aperture's shape."),
      number<&Parameters::viewsPerFrame>("viewsPerFrame", "", 1, 64,
                                         "Views per execution of the graph; changes no picture."),
      choice<&Parameters::pattern, kLensPatternNames>("pattern", "Low-discrepancy pattern of lens points and offsets."),
  };
  return table;
}

uint32_t frameCount(const Parameters& parameters, const DofInputs& inputs) {
  if (inputs.lens.cocScale == 0.0f) return pinhole::frameCount(withoutLens(parameters), inputs);
  return passes::frameCount(meanOf(parameters, inputs.aperture));
}

DofOutputs declare(rendergraph::Graph& graph, const DofInputs& inputs, const Parameters& parameters) {
  if (inputs.lens.cocScale == 0.0f) return pinhole::declare(graph, inputs, withoutLens(parameters));
  DofInputs own = inputs;
  if (parameters.gaussian) own.aperture.gaussian = 1u;
  return declareViewMean(graph, own, meanOf(parameters, own.aperture));
}

namespace {

constexpr std::string_view kIgnoredLensFields[] = {"maxCocRadius"};  // Every view is a true one.

}  // namespace

Technique technique() {
  return makeTechnique<Parameters>(
      {.name = "accumulation",
       .title = "Accumulation (reference)",
       .source = "Haeberli & Akeley 1990, The accumulation buffer; Cook 1984, Distributed ray tracing",
       .input = TechniqueInput::scene,
       .fields = fields(),
       .ignoredLensFields = kIgnoredLensFields,
       .declare = declare,
       .frameCount = frameCount,
       .quick = {.lensSamples = 16},
       .quickPixelSamples = 16});
}

}  // namespace lensgraph::passes::accumulation
