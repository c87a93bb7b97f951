// Declares one technique alone: on two imported pictures, or on a scene that draws nothing.
#include "bare_technique.h"

namespace lensgraph {

namespace {

constexpr rendergraph::AccessState kSampled = {.stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                               .access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                               .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
constexpr rendergraph::AccessState kHostRead = {.stages = VK_PIPELINE_STAGE_2_HOST_BIT,
                                                .access = VK_ACCESS_2_HOST_READ_BIT};

}  // namespace

void declareBare(rendergraph::Graph& graph, const passes::Technique& technique, const BareOptions& options,
                 passes::SceneDraw& scene) {
  scene.hasTransparency = options.hasTransparency;
  passes::DofInputs inputs;
  inputs.extent = options.extent;
  inputs.lens = {.cocScale = options.cocScale,
                 .focusVergence = 0.5f,
                 .maxCocRadius = 1e30f,
                 .vergenceScale = 100.0f,
                 .vergenceOffset = 0.0f};
  inputs.aperture.anamorphicRatio = 1.0f;
  inputs.projection = {.pixelsPerTangent = 494.5f, .nearPlane = 0.01f};
  if (technique.input == passes::TechniqueInput::scene) {
    inputs.scene = &scene;
  } else {
    const auto host = [&](std::string_view name, VkFormat format) {
      return graph.importImage(name, {.format = format, .width = options.extent.width, .height = options.extent.height},
                               {.usage = VK_IMAGE_USAGE_SAMPLED_BIT, .before = kSampled, .after = kSampled});
    };
    inputs.color = host("host.color", VK_FORMAT_R32G32B32A32_SFLOAT);
    inputs.depth = host("host.depth", VK_FORMAT_D32_SFLOAT);
  }
  const auto out = technique.configure(options.parameters)->declare(graph, inputs);
  graph.exportImage(out.color, kSampled);
  if (out.standardError) graph.exportImage(out.standardError, kSampled);
  if (out.statistics) graph.exportBuffer(out.statistics, kHostRead);
}

}  // namespace lensgraph
