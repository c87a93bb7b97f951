// Nodes of template_technique. What they compute is in its shaders.
#include "passes/_template/template_technique.h"

#include <array>

#include "passes/nodes/statistics.h"
#include "rendergraph/compute_pass.h"
#include "shared/template_technique.h"
#include "spirv/template_technique/gather_comp.h"

namespace lensgraph::passes::template_technique {
namespace {

const rendergraph::ComputeProgram kGather{"template_technique.gather", template_technique_gather_comp};

// The aperture is a disc.
constexpr std::string_view kIgnoredLensFields[] = {"bladeCount",      "bladeRotation",     "bladeCurvature",
                                                   "anamorphicRatio", "opticalVignetting", "sphericalAberration"};

}  // namespace

std::span<const Field<Parameters>> fields() {
  static const std::array all = {
      number<&Parameters::samples>("samples", "", 1, 256, "Taps a pixel. Time grows with it; fewer show as noise.")};
  return all;
}

DofOutputs declare(rendergraph::Graph& graph, const DofInputs& inputs, const Parameters& parameters) {
  DofOutputs out;
  out.color = inputs.color;
  if (inputs.lens.cocScale == 0.0f) return out;

  const auto [width, height] = inputs.extent;
  out.statistics = declareStatistics(graph, "template_technique");
  out.color = graph.createImage("template_technique.color",
                                {.format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = width, .height = height});
  const shared::TemplateTechniquePush push{.size = {static_cast<int32_t>(width), static_cast<int32_t>(height)},
                                           .lens = inputs.lens,
                                           .samples = static_cast<uint32_t>(parameters.samples)};
  compute(graph, kGather.name, kGather)
      .sample(inputs.color, rendergraph::kNearest, rendergraph::mip(0))
      .sample(inputs.depth, rendergraph::kNearest, rendergraph::mip(0))
      .write(out.color)
      .modify(out.statistics)
      .push(push)
      .groups(rendergraph::groupsFor(inputs.extent, shared::kTemplateTechniqueTile));
  return out;
}

Technique technique() {
  return makeTechnique<Parameters>({.name = "template_technique",
                                    .title = "Template",
                                    .source = "the folder to copy for a technique of your own",
                                    .input = TechniqueInput::image,
                                    .fields = fields(),
                                    .ignoredLensFields = kIgnoredLensFields,
                                    .declare = declare,
                                    .quick = {.samples = 16}});
}

}  // namespace lensgraph::passes::template_technique
