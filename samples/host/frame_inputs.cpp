// A shot's inputs of a technique: lens and projection, what is visible of the scene, and the callbacks that draw it.
#include <algorithm>

#include "engine/error.h"
#include "engine/scene/camera.h"
#include "engine/scene/visible_range.h"
#include "samples/host/renderer_state.h"
#include "samples/host/shot_scene.h"

namespace lensgraph::host {

using passes::DofInputs;
using rendergraph::Graph;
using rendergraph::PassContext;

passes::SceneShading RendererState::importShading(Graph& graph) const {
  const auto buffer = [&](const char* name, const engine::GpuBuffer& one, VkBufferUsageFlags usage) {
    return graph.importBuffer(name, {.size = std::max<VkDeviceSize>(one.size, 16)},
                              {.buffer = one.buffer.get(), .usage = usage, .before = {}, .after = {}});
  };
  const auto& environment = renderer->environment();
  constexpr rendergraph::AccessState kRest{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_READ_BIT,
                                           VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  return {.environment = graph.importImage("environment", environment.desc,
                                           {.image = environment.image.get(),
                                            .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                            .before = kRest,
                                            .after = kRest}),
          .lights = buffer("lights", renderer->lights(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT),
          .constants = buffer("scene_constants", renderer->constants(), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT)};
}

DofInputs RendererState::sceneInputs(const Shot& shot) {
  if (!renderer) throw engine::Error("this renderer was made without a scene");
  const engine::Camera camera = shotCamera(shot, *scene);
  const auto width = static_cast<uint32_t>(shot.width), height = static_cast<uint32_t>(shot.height);
  DofInputs inputs;
  inputs.extent = {width, height};
  inputs.lens = passes::lensConstants(shot.lens, camera.fovy, shot.height, camera.nearPlane);
  inputs.aperture = passes::apertureShape(shot.lens);
  inputs.projection.pixelsPerTangent =
      static_cast<float>(passes::pixelsPerTangent(shot.lens, camera.fovy, shot.height));
  inputs.projection.nearPlane = static_cast<float>(camera.nearPlane);
  inputs.background = shot.background;

  renderer->setViewpoint({.viewFromWorld = camera.viewFromWorld,
                          .metersPerUnit = shot.lens.metersPerUnit,
                          .lit = shot.shading == Shading::lit,
                          .faces = shot.faces});
  const engine::LensOpening opening{passes::apertureRadius(shot.lens) * shared::apertureReach(inputs.aperture),
                                    inputs.lens.focusVergence};
  const auto range = engine::visibleRange(*scene, camera, width, height, opening, shot.lens.metersPerUnit);
  nothingIsVisible = range.isEmpty;
  sceneDraw.nearestVergence = range.isEmpty ? 0.0f : static_cast<float>(1.0 / range.nearestDepth);
  occupied.clear();
  for (const auto& span : range.spans) {
    occupied.push_back({static_cast<float>(1.0 / span.farthest), static_cast<float>(1.0 / span.nearest)});
  }
  sceneDraw.occupied = occupied;
  sceneDraw.farthestVergence = 0.0f;  // The background may always show.
  sceneDraw.hasTransparency = renderer->hasTransparency();
  sceneDraw.importShading = {};
  if (shot.shading == Shading::lit) sceneDraw.importShading = [this](Graph& graph) { return importShading(graph); };
  sceneDraw.record = [this](PassContext& context, const passes::SceneDrawCall& call) {
    std::vector<rendergraph::ResolvedBinding> bindings;
    for (const auto& binding : call.emitBindings) {
      const bool isImage = static_cast<bool>(binding.image);
      bindings.push_back(
          {.kind = binding.kind,
           .view = isImage ? context.view(binding.image, binding.range, binding.viewType) : VK_NULL_HANDLE,
           .layout = VK_IMAGE_LAYOUT_GENERAL,
           .sampler = binding.sampler,
           .buffer = isImage ? VK_NULL_HANDLE : context.buffer(binding.buffer)});
    }
    renderer->draw(context.commands(), {.emit = call.emit,
                                        .view = call.view,
                                        .extent = call.extent,
                                        .colorFormats = context.colorFormats(),
                                        .depthFormat = context.depthFormat(),
                                        .samples = context.samples(),
                                        .emitBindings = bindings});
  };
  inputs.scene = &sceneDraw;
  return inputs;
}

}  // namespace lensgraph::host
