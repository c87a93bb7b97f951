// The frame loop: declares the technique's nodes, executes them, reads the results back.
#include "samples/host/renderer.h"

#include <algorithm>
#include <cstring>

#include "engine/error.h"
#include "engine/process_usage.h"
#include "passes/pinhole/pinhole.h"
#include "rendergraph/compiler.h"
#include "samples/host/limits/fitting_size.h"
#include "samples/host/limits/list_room.h"
#include "samples/host/raytraced.h"
#include "samples/host/read_back.h"
#include "samples/host/renderer_state.h"
#include "samples/host/shot_scene.h"
#include "samples/host/technique_choice.h"
#include "samples/host/texels.h"
#include "samples/host/warnings.h"

namespace lensgraph::host {
namespace {

using passes::DofInputs;
using passes::DofOutputs;
using rendergraph::Buffer;
using rendergraph::Graph;

[[noreturn]] void throwProblem(const passes::Problem& problem, std::string_view technique) {
  throw engine::Error(engine::ErrorParts{.file = {},
                                         .field = std::string(technique) + "." + problem.parameter,
                                         .reason = problem.reason,
                                         .remedy = problem.remedy});
}

void add(shared::FrameStatistics& total, const shared::FrameStatistics& frame) {
  total.replacedTexels += frame.replacedTexels;
  total.transparentUnsorted += frame.transparentUnsorted;
  total.clampedCoc = std::max(total.clampedCoc, frame.clampedCoc);
  total.transparentNodes = std::max(total.transparentNodes, frame.transparentNodes);
  total.transparentDropped = std::max(total.transparentDropped, frame.transparentDropped);
  total.fragmentNodes = std::max(total.fragmentNodes, frame.fragmentNodes);
  total.fragmentNodesDropped = std::max(total.fragmentNodesDropped, frame.fragmentNodesDropped);
  total.listFragments = std::max(total.listFragments, frame.listFragments);
  total.listFragmentsDropped = std::max(total.listFragmentsDropped, frame.listFragmentsDropped);
  total.unsortedLists += frame.unsortedLists;
}

/// Converts the copies that the taps made in the latest execution to pictures.
void keepTapped(const Graph& graph, const rendergraph::Executor& executor, const rendergraph::ImageTaps& taps,
                Tapped& tapped) {
  tapped.pictures.resize(taps.images().size());
  for (std::size_t i = 0; i < taps.images().size(); ++i) {
    const auto& image = taps.images()[i];
    if (!image.buffer) continue;
    tapped.pictures[i] = pictureOf(executor.mapped(image.buffer), image.format, image.aspect, image.extent);
  }
  for (const auto& choice : rendergraph::tappableImages(graph)) {
    if (std::ranges::find(tapped.choices, choice) == tapped.choices.end()) tapped.choices.push_back(choice);
  }
}

/// Whether the frame that makes the picture could be compiled in that size, with the room that lists have now.
bool fits(RendererState& state, const Shot& shot, PictureExtent extent, const RenderOptions& options) {
  Shot smaller = shot;
  smaller.width = extent.width;
  smaller.height = extent.height;
  Graph graph;
  try {
    const auto frame =
        state.declareTechnique(graph, state.sceneInputs(smaller), techniqueOf(options), options.wantDepth);
    state.declareReadBacks(graph, frame, true, options.wantDepth);
    graph.finish();
    rendergraph::compile(graph.declaration(), options.execute.compile, state.backend);
  } catch (const rendergraph::GraphError& error) {
    if (error.misuse() == rendergraph::Misuse::overLimit) return false;
    throw;
  }
  return true;
}

}  // namespace

ChosenTechnique techniqueOf(const RenderOptions& options) {
  const passes::Technique& technique = requireTechnique(options.technique, {}, "technique");
  if (isRaytraced(technique.name)) failWithoutGraph("--technique", "no graph to declare");
  const auto problems = passes::check(options.parameters, technique.parameters);
  if (!problems.empty()) throwProblem(problems.front(), technique.name);
  return {technique, technique.configure(options.parameters)};
}

Renderer::Renderer(engine::Device& device, const Shot& shot, std::vector<std::string>& warnings)
    : Renderer(device, loadShotScene(shot, warnings), loadShotEnvironment(shot)) {}

Renderer::Renderer(engine::Device& device, engine::Scene scene, const std::optional<engine::Environment>& environment)
    : state_(std::make_unique<RendererState>(device)) {
  state_->scene = std::move(scene);
  state_->environment = environment;
  state_->renderer = std::make_unique<engine::SceneRenderer>(state_->backend, *state_->scene, environment);
}

Renderer::Renderer(engine::Device& device) : state_(std::make_unique<RendererState>(device)) {}
Renderer::~Renderer() = default;

FrameOutputs RendererState::declareTechnique(Graph& graph, DofInputs inputs, const ChosenTechnique& technique,
                                             bool wantDepth) {
  // Without a scene (apply) the pictures are already in the inputs.
  DofOutputs view;
  const bool isImage = technique.entry.input == passes::TechniqueInput::image;
  if (inputs.scene != nullptr && (isImage || wantDepth) && technique.entry.name != "pinhole") {
    DofInputs sharp = inputs;
    sharp.frame = 0;
    view = passes::pinhole::declare(graph, sharp, {});
    inputs.color = view.color;
    inputs.depth = view.depth;
  }
  const auto problems = technique.configured->validate(inputs);
  if (!problems.empty()) throwProblem(problems.front(), technique.entry.name);
  FrameOutputs out;
  out.technique = technique.configured->declare(graph, inputs);
  if (!out.technique.depth) out.technique.depth = view.depth;
  // Of a pinhole view that is drawn for its depth alone nothing else is asked for, and the graph leaves it out.
  if (isImage && view.statistics) out.statistics.push_back(view.statistics);
  if (out.technique.statistics) out.statistics.push_back(out.technique.statistics);
  return out;
}

ReadBacks RendererState::declareReadBacks(Graph& graph, const FrameOutputs& frame, bool isLast, bool wantDepth) {
  ReadBacks back;
  for (const Buffer& buffer : frame.statistics) back.statistics.push_back(readBack(graph, buffer, "statistics"));
  if (!isLast) return back;
  const DofOutputs& out = frame.technique;
  back.color = readBack(graph, out.color, "color");
  if (wantDepth && out.depth) back.depth = readBack(graph, out.depth, "depth");
  if (out.standardError) back.standardError = readBack(graph, out.standardError, "standard_error");
  return back;
}

Rendering RendererState::run(const ChosenTechnique& technique, const DofInputs& inputs, const RenderOptions& options,
                             const DeclareFrame& declareFrame) {
  Rendering rendering;
  const uint32_t frames = technique.configured->frameCount(inputs);
  Graph graph;
  rendergraph::ImageTaps taps;
  for (const auto& tap : options.taps) taps.add(tap);
  if (options.tapped != nullptr) graph.observe(&taps);
  for (uint32_t frame = 0; frame < frames; ++frame) {
    graph.reset();
    const bool isLast = frame + 1 == frames;
    const bool isShown = !isLast && options.intermediate && std::ranges::count(options.intermediateAt, frame + 1) > 0;
    const auto back = declareReadBacks(graph, declareFrame(graph, frame), isLast || isShown, options.wantDepth);
    graph.finish();
    const double cpuMsBefore = engine::processCpuMs();
    executor.execute(graph, options.execute);
    rendering.cpuMs += engine::processCpuMs() - cpuMsBefore;
    rendering.graphBytes = std::max<uint64_t>(rendering.graphBytes, executor.capture().memory.peakBytes);
    ++rendering.executions;
    if (options.observe) options.observe(executor.capture());
    if (options.tapped != nullptr) keepTapped(graph, executor, taps, *options.tapped);
    rendering.gpuMs += std::max(executor.capture().frameGpuMs, 0.0);
    rendering.wallMs += executor.capture().frameWallMs;
    for (const Buffer& buffer : back.statistics) {
      shared::FrameStatistics statistics;
      std::memcpy(&statistics, executor.mapped(buffer).data(), sizeof statistics);
      add(rendering.statistics, statistics);
    }
    if (!options.fixedRoom && lacksRoom(rendering.statistics, nodesAreCapped))
      return rendering;  // The caller makes room and starts again.
    if (options.progress) options.progress(frame + 1, frames);
    if (isShown) options.intermediate(frame + 1, imageFrom(executor.mapped(back.color), inputs.extent, 4));
    if (!isLast) continue;
    rendering.color = imageFrom(executor.mapped(back.color), inputs.extent, 4);
    if (back.depth) {
      rendering.depth = imageFrom(executor.mapped(back.depth), inputs.extent, 1);
      for (float& z : rendering.depth.samples) z = z > 0.0f ? inputs.projection.nearPlane / z : kNothingHit;
    }
    if (back.standardError) rendering.estimatedError = rootMeanSquare(executor.mapped(back.standardError));
  }
  rendering.capture = executor.capture();
  return rendering;
}

Rendering Renderer::render(const Shot& shot, const RenderOptions& options) {
  if (isRaytraced(requireTechnique(options.technique, {}, "technique").name)) {
    if (!state_->scene) throw engine::Error("this renderer was made without a scene");
    return renderRaytraced(*state_->scene, state_->environment, shot, options);
  }
  const auto technique = techniqueOf(options);
  const DofInputs inputs = state_->sceneInputs(shot);
  if (options.fixedRoom) {
    state_->sceneDraw.fragmentNodesPerPixel = options.fixedRoom->fragmentNodes;
    state_->sceneDraw.listFragmentsPerPixel = options.fixedRoom->listFragments;
  }
  const double pixels = static_cast<double>(inputs.extent.width) * inputs.extent.height;
  RoomSearch room(state_->sceneDraw);
  for (;;) {
    state_->nodesAreCapped = room.nodesAreCapped();
    try {
      auto rendering = state_->run(technique, inputs, options, [&](Graph& graph, uint32_t frame) {
        DofInputs now = inputs;
        now.frame = frame;
        return namingShot(shot, "technique",
                          [&] { return state_->declareTechnique(graph, now, technique, options.wantDepth); });
      });
      if (options.fixedRoom || !lacksRoom(rendering.statistics, room.nodesAreCapped())) {
        rendering.warnings = state_->warningsOf(shot, technique.entry, options.parameters, rendering);
        return rendering;
      }
      room.grow(rendering.statistics, pixels);
    } catch (const rendergraph::GraphError& error) {
      if (error.misuse() != rendergraph::Misuse::overLimit) throw;
      const PictureExtent wanted{shot.width, shot.height};
      const auto fitsNow = [&](PictureExtent extent) { return fits(*state_, shot, extent, options); };
      // A picture with what the device has room for is better than none.
      if (!options.fixedRoom && room.giveWay([&] { return fitsNow(wanted); })) continue;
      rethrowNamingShot(tooLarge(wanted, options.technique, error, largestFitting(wanted, fitsNow)), shot,
                        "resolution");
    }
  }
}

std::vector<std::string> RendererState::warningsOf(const Shot& shot, const passes::Technique& technique,
                                                   const passes::ParameterSet& parameters,
                                                   const Rendering& rendering) const {
  std::vector<std::string> warnings;
  const auto add = [&](const std::optional<std::string>& warning) {
    if (warning) warnings.push_back(*warning);
  };
  add(ignoredLensWarning(shot.lens, technique));
  if (nothingIsVisible) {
    add(invisibleSceneWarning(*scene, shotCamera(shot, *scene), shot.lens.metersPerUnit));
  } else if (shot.faces == engine::DrawnFaces::material) {
    add(backFacesWarning(rendering.color, shot.background, *scene));
  }
  if (shot.shading == Shading::lit) add(unlitSceneWarning(*scene, environment.has_value()));
  add(listRoomWarning(rendering.statistics));
  add(limitedBlurWarning(rendering.statistics.clampedCoc, shot.lens, technique, parameters, shot.height));
  return warnings;
}

void Renderer::declare(Graph& graph, const Shot& shot, const RenderOptions& options) {
  const auto technique = techniqueOf(options);
  const DofInputs inputs = state_->sceneInputs(shot);
  const auto out = namingShot(shot, "technique",
                              [&] { return state_->declareTechnique(graph, inputs, technique, options.wantDepth); });
  graph.exportImage(out.technique.color, {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                          VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
}

rendergraph::Plan Renderer::compile(const Graph& graph, const rendergraph::CompileOptions& options) {
  return rendergraph::compile(graph.declaration(), options, state_->backend);
}

}  // namespace lensgraph::host
