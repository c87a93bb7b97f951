// A technique on two pictures: uploads color and depth, and runs the technique on them instead of on a drawn view.
#include <algorithm>
#include <limits>
#include <numbers>
#include <span>

#include "engine/error.h"
#include "engine/vulkan/command_buffers.h"
#include "passes/lens/physical_lens.h"
#include "samples/host/picture_inputs.h"
#include "samples/host/renderer.h"
#include "samples/host/renderer_state.h"
#include "samples/host/texels.h"
#include "samples/host/warnings.h"

namespace lensgraph::host {

using passes::DofInputs;
using rendergraph::Graph;

namespace {

/// Vergence of a depth picture's sample; what is not a positive depth is infinitely far.
float vergenceOf(float depth) {
  if (!(depth > 0.0f && depth < kNothingHit)) return 0.0f;
  return std::min(1.0f / depth, std::numeric_limits<float>::max());
}

}  // namespace

Rendering Renderer::apply(const engine::FloatImage& color, const engine::FloatImage& depth, double fovyDeg,
                          const passes::Lens& lens, const RenderOptions& options) {
  const auto technique = techniqueOf(options);
  if (technique.entry.input != passes::TechniqueInput::image) {
    throw engine::Error("technique '" + options.technique + "' draws a scene; apply works on pictures");
  }
  const auto upload = [&](VkFormat format, const engine::FloatImage& picture, const char* name) {
    auto image = engine::makeImage(state_->device, {.format = format, .width = color.width, .height = color.height},
                                   VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                       VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                   name);
    engine::upload(state_->device, image, std::as_bytes(std::span(picture.samples)));
    return image;
  };
  engine::FloatImage vergence = depth;
  for (float& sample : vergence.samples) sample = vergenceOf(sample);
  // At the input, so that a technique that hands its input through (no aperture) gives finite pictures too.
  engine::FloatImage finite = color;
  const ColorFindings found = cleanColor(finite);
  const auto colorImage = upload(VK_FORMAT_R32G32B32A32_SFLOAT, finite, "color");
  const auto depthImage = upload(VK_FORMAT_R32_SFLOAT, vergence, "vergence");

  DofInputs inputs;
  inputs.extent = {color.width, color.height};
  inputs.colorHasAlpha = hasAlpha(finite);
  const double fovy = fovyDeg * std::numbers::pi / 180.0;
  inputs.lens = passes::lensConstants(lens, fovy, static_cast<int>(color.height), 1.0);
  inputs.lens.vergenceScale = 1.0f;
  inputs.lens.vergenceOffset = 0.0f;
  inputs.aperture = passes::apertureShape(lens);
  inputs.projection.pixelsPerTangent =
      static_cast<float>(passes::pixelsPerTangent(lens, fovy, static_cast<int>(color.height)));
  const auto import = [](Graph& graph, const engine::GpuImage& image, const char* name) {
    constexpr rendergraph::AccessState kRest{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_READ_BIT,
                                             VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    return graph.importImage(name, image.desc,
                             {.image = image.image.get(),
                              .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                       VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                              .before = kRest,
                              .after = kRest});
  };
  auto rendering = state_->run(technique, inputs, options, [&](Graph& graph, uint32_t) {
    DofInputs now = inputs;
    now.color = import(graph, colorImage, "color");
    now.depth = import(graph, depthImage, "vergence");
    return state_->declareTechnique(graph, now, technique, options.wantDepth);
  });
  rendering.statistics.replacedTexels += static_cast<uint32_t>(found.notFinite);
  if (const auto warning = limitedBlurWarning(rendering.statistics.clampedCoc, lens, technique.entry,
                                              options.parameters, static_cast<int>(color.height))) {
    rendering.warnings.push_back(*warning);
  }
  return rendering;
}

}  // namespace lensgraph::host
