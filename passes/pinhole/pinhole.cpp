// Nodes of the pinhole picture.
#include "passes/pinhole/pinhole.h"

#include <vector>

#include "passes/lens/lens_view.h"
#include "passes/nodes/sanitize.h"
#include "passes/nodes/scene_view.h"
#include "passes/nodes/statistics.h"
#include "passes/nodes/view_mean.h"

namespace lensgraph::passes::pinhole {
namespace {

ViewMean meanOf(const Parameters& parameters) {
  return {.prefix = "pinhole",
          .viewCount = static_cast<uint32_t>(parameters.pixelSamples),
          .viewsPerFrame = static_cast<uint32_t>(parameters.viewsPerFrame),
          .sample = [pattern = parameters.pattern](uint32_t view) {
            LensSample sample = lensSample({.anamorphicRatio = 1.0f}, pattern, view, true);
            sample.v = {0.0f, 0.0f};
            return sample;
          }};
}

}  // namespace

std::span<const Field<Parameters>> fields() {
  static const std::vector<Field<Parameters>> table = {
      number<&Parameters::pixelSamples>("pixelSamples", "", 1, 4096,
                                        "Views averaged over the pixel's square; each costs one draw of the scene."),
      number<&Parameters::viewsPerFrame>("viewsPerFrame", "", 1, 64,
                                         "Views per execution of the graph; changes no picture."),
      choice<&Parameters::pattern, kLensPatternNames>("pattern", "Low-discrepancy pattern of the sub-pixel offsets."),
  };
  return table;
}

uint32_t frameCount(const Parameters& parameters, const DofInputs&) {
  return parameters.pixelSamples == 1 ? 1 : passes::frameCount(meanOf(parameters));
}

DofOutputs declare(rendergraph::Graph& graph, const DofInputs& inputs, const Parameters& parameters) {
  DofInputs sharp = inputs;
  sharp.lens.cocScale = 0.0f;
  const auto centre = viewFromLens(sharp, {0.0f, 0.0f}, {0.0f, 0.0f});
  auto view = declareSceneView(graph, sharp, "pinhole", centre, declareStatistics(graph, "pinhole"));
  // With more samples the centre's view is kept for its depth alone, and culled when nobody asks for that.
  if (parameters.pixelSamples == 1) {
    declareSanitize(graph, "pinhole", view.color, view.statistics);
    return {.color = view.color, .depth = view.depth, .standardError = {}, .statistics = view.statistics};
  }
  auto out = declareViewMean(graph, sharp, meanOf(parameters));
  out.depth = view.depth;
  return out;
}

Technique technique() {
  return makeTechnique<Parameters>({.name = "pinhole",
                                    .title = "Pinhole",
                                    .source = "no lens",
                                    .input = TechniqueInput::scene,
                                    .fields = fields(),
                                    .declare = declare,
                                    .frameCount = frameCount,
                                    .quick = {.pixelSamples = 16},
                                    .quickPixelSamples = 16});
}

}  // namespace lensgraph::passes::pinhole
