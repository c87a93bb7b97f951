// The frame loop: inputs of a shot, the technique's nodes, execution, read-back.
#include "samples/host/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "engine/draw/scene_renderer.h"
#include "engine/error.h"
#include "engine/gltf/load_gltf.h"
#include "engine/graph/graph_backend.h"
#include "engine/image/image_io.h"
#include "engine/scene/camera.h"
#include "engine/scene/visible_range.h"
#include "engine/vulkan/command_buffers.h"
#include "engine/vulkan/device.h"
#include "passes/pinhole/pinhole.h"
#include "rendergraph/compiler.h"
#include "samples/host/read_back.h"
#include "samples/host/shot_scene.h"
#include "samples/host/texels.h"

namespace lensgraph::host {
namespace {

using passes::DofInputs;
using passes::DofOutputs;
using rendergraph::Buffer;
using rendergraph::Graph;
using rendergraph::PassContext;

constexpr float kNothingHit = 1e10f;  // m; the depth of the background in pictures

[[noreturn]] void throwProblem(const passes::Problem& problem, std::string_view technique) {
  throw engine::Error(engine::ErrorParts{.file = {},
                                         .field = std::string(technique) + "." + problem.parameter,
                                         .reason = problem.reason,
                                         .remedy = problem.remedy});
}

const passes::Technique& techniqueOf(const RenderOptions& options) {
  const auto* technique = passes::findTechnique(options.technique);
  if (technique == nullptr) {
    const std::string near(passes::nearestTechniqueName(options.technique));
    throw engine::Error(
        engine::ErrorParts{.file = {},
                           .field = "technique",
                           .reason = "unknown technique '" + options.technique + "'",
                           .remedy = near.empty() ? "see 'lensgraph techniques'" : "did you mean '" + near + "'?"});
  }
  const auto problems = passes::check(options.parameters, technique->parameters);
  if (!problems.empty()) throwProblem(problems.front(), technique->name);
  return *technique;
}

/// What of a frame comes back to the host; default-made handles are not asked for.
struct ReadBacks {
  Buffer color, depth, standardError;
  std::vector<Buffer> statistics;
};

/// What a frame's declaration gives the host: the technique's outputs, and the statistics of all its parts.
struct FrameOutputs {
  DofOutputs technique;
  std::vector<Buffer> statistics;
};

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

/// Whether something was left out of a frame for want of room.
bool lacksRoom(const shared::FrameStatistics& frame) {
  return frame.transparentDropped > 0 || frame.fragmentNodesDropped > 0 || frame.listFragmentsDropped > 0;
}

/// Sets the room of what was too small to a quarter more than was needed, so that neighbouring views fit too.
void makeRoom(const shared::FrameStatistics& frame, double pixels, passes::SceneDraw& scene) {
  const auto perPixel = [&](uint32_t needed) { return static_cast<float>(1.25 * needed / pixels); };
  if (frame.transparentDropped > 0) scene.transparentNodesPerPixel = perPixel(frame.transparentNodes);
  if (frame.fragmentNodesDropped > 0) scene.fragmentNodesPerPixel = perPixel(frame.fragmentNodes);
  if (frame.listFragmentsDropped > 0) scene.listFragmentsPerPixel = perPixel(frame.listFragments);
}

/// Vergence of a depth picture's sample; what is not a positive depth is infinitely far.
float vergenceOf(float depth) {
  return depth > 0.0f && depth < kNothingHit ? 1.0f / depth : 0.0f;
}

/// Opaque black for every pixel of an RGBA picture that is not finite; how many there were. At the input, so that a
/// technique that hands its input through (no aperture) gives finite pictures too.
uint32_t replaceNonFinite(engine::FloatImage& picture) {
  uint32_t replaced = 0;
  for (std::size_t i = 0; i < picture.samples.size(); i += 4) {
    const auto texel = std::span(picture.samples).subspan(i, 4);
    if (std::ranges::all_of(texel, [](float value) { return std::isfinite(value); })) continue;
    std::ranges::copy(std::array{0.0f, 0.0f, 0.0f, 1.0f}, texel.begin());
    ++replaced;
  }
  return replaced;
}

/// Takes home what the taps have copied in the latest execution.
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

std::optional<engine::Environment> loadEnvironment(const Shot& shot) {
  if (!shot.environment) return std::nullopt;
  return engine::prepareEnvironment(engine::readImage(*shot.environment));
}

}  // namespace

struct Renderer::State {
  explicit State(engine::Device& usedDevice) : device(usedDevice), backend(usedDevice), executor(backend) {}

  /// Declares one frame.
  using DeclareFrame = std::function<FrameOutputs(Graph&, uint32_t frame)>;

  DofInputs sceneInputs(const Shot& shot);
  passes::SceneShading importShading(Graph& graph) const;
  Rendering run(const passes::Technique& technique, const DofInputs& inputs, const RenderOptions& options,
                const DeclareFrame& declareFrame);
  ReadBacks declareReadBacks(Graph& graph, const FrameOutputs& frame, bool isLast, bool wantDepth);
  FrameOutputs declareTechnique(Graph& graph, DofInputs inputs, const passes::Technique& technique,
                                const RenderOptions& options);

  engine::Device& device;
  engine::GraphBackend backend;
  rendergraph::Executor executor;
  std::optional<engine::Scene> scene;
  std::unique_ptr<engine::SceneRenderer> renderer;
  passes::SceneDraw sceneDraw;
  std::vector<passes::VergenceInterval> occupied;  ///< What sceneDraw refers to.
};

Renderer::Renderer(engine::Device& device, const Shot& shot, std::vector<std::string>& warnings)
    : Renderer(device, loadShotScene(shot, warnings), loadEnvironment(shot)) {}

Renderer::Renderer(engine::Device& device, engine::Scene scene, const std::optional<engine::Environment>& environment)
    : state_(std::make_unique<State>(device)) {
  state_->scene = std::move(scene);
  state_->renderer = std::make_unique<engine::SceneRenderer>(state_->backend, *state_->scene, environment);
}

Renderer::Renderer(engine::Device& device) : state_(std::make_unique<State>(device)) {}
Renderer::~Renderer() = default;

passes::SceneShading Renderer::State::importShading(Graph& graph) const {
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

DofInputs Renderer::State::sceneInputs(const Shot& shot) {
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
                          .lit = shot.shading == Shading::lit});
  const engine::LensOpening opening{passes::apertureRadius(shot.lens) * shared::apertureReach(inputs.aperture),
                                    inputs.lens.focusVergence};
  const auto range = engine::visibleRange(*scene, camera, width, height, opening, shot.lens.metersPerUnit);
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

FrameOutputs Renderer::State::declareTechnique(Graph& graph, DofInputs inputs, const passes::Technique& technique,
                                               const RenderOptions& options) {
  // Without a scene (apply) the pictures are already in the inputs.
  DofOutputs view;
  const bool isImage = technique.input == passes::TechniqueInput::image;
  if (inputs.scene != nullptr && (isImage || options.wantDepth) && technique.name != "pinhole") {
    DofInputs sharp = inputs;
    sharp.frame = 0;
    view = passes::pinhole::declare(graph, sharp, {});
    inputs.color = view.color;
    inputs.depth = view.depth;
  }
  const auto problems = technique.validate(options.parameters, inputs);
  if (!problems.empty()) throwProblem(problems.front(), technique.name);
  FrameOutputs out;
  out.technique = technique.declare(graph, inputs, options.parameters);
  if (!out.technique.depth) out.technique.depth = view.depth;
  // Of a pinhole view that is drawn for its depth alone nothing else is asked for, and the graph leaves it out.
  if (isImage && view.statistics) out.statistics.push_back(view.statistics);
  if (out.technique.statistics) out.statistics.push_back(out.technique.statistics);
  return out;
}

ReadBacks Renderer::State::declareReadBacks(Graph& graph, const FrameOutputs& frame, bool isLast, bool wantDepth) {
  ReadBacks back;
  for (const Buffer& buffer : frame.statistics) back.statistics.push_back(readBack(graph, buffer, "statistics"));
  if (!isLast) return back;
  const DofOutputs& out = frame.technique;
  back.color = readBack(graph, out.color, "color");
  if (wantDepth && out.depth) back.depth = readBack(graph, out.depth, "depth");
  if (out.standardError) back.standardError = readBack(graph, out.standardError, "standard_error");
  return back;
}

Rendering Renderer::State::run(const passes::Technique& technique, const DofInputs& inputs,
                               const RenderOptions& options, const DeclareFrame& declareFrame) {
  Rendering rendering;
  const uint32_t frames = technique.frameCount(options.parameters, inputs);
  Graph graph;
  rendergraph::ImageTaps taps;
  for (const auto& tap : options.taps) taps.add(tap);
  if (options.tapped != nullptr) graph.observe(&taps);
  for (uint32_t frame = 0; frame < frames; ++frame) {
    graph.reset();
    const bool isLast = frame + 1 == frames;
    const auto back = declareReadBacks(graph, declareFrame(graph, frame), isLast, options.wantDepth);
    graph.finish();
    executor.execute(graph, options.execute);
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
    if (!options.fixedRoom && lacksRoom(rendering.statistics))
      return rendering;  // The caller makes room and starts again.
    if (options.progress) options.progress(frame + 1, frames);
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
  const auto& technique = techniqueOf(options);
  const DofInputs inputs = state_->sceneInputs(shot);
  if (options.fixedRoom) {
    state_->sceneDraw.fragmentNodesPerPixel = options.fixedRoom->fragmentNodes;
    state_->sceneDraw.listFragmentsPerPixel = options.fixedRoom->listFragments;
  }
  const double pixels = static_cast<double>(inputs.extent.width) * inputs.extent.height;
  for (;;) {
    auto rendering = state_->run(technique, inputs, options, [&](Graph& graph, uint32_t frame) {
      DofInputs now = inputs;
      now.frame = frame;
      return state_->declareTechnique(graph, now, technique, options);
    });
    if (options.fixedRoom || !lacksRoom(rendering.statistics)) return rendering;
    makeRoom(rendering.statistics, pixels, state_->sceneDraw);
  }
}

void Renderer::declare(Graph& graph, const Shot& shot, const RenderOptions& options) {
  const auto& technique = techniqueOf(options);
  const auto out = state_->declareTechnique(graph, state_->sceneInputs(shot), technique, options);
  graph.exportImage(out.technique.color, {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                          VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
}

rendergraph::Plan Renderer::compile(const Graph& graph, const rendergraph::CompileOptions& options) {
  return rendergraph::compile(graph.declaration(), options, state_->backend);
}

Rendering Renderer::apply(const engine::FloatImage& color, const engine::FloatImage& depth, double fovyDeg,
                          const passes::Lens& lens, const RenderOptions& options) {
  const auto& technique = techniqueOf(options);
  if (technique.input != passes::TechniqueInput::image) {
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
  engine::FloatImage finite = withOpaqueAlpha(color);
  const uint32_t replaced = replaceNonFinite(finite);
  const auto colorImage = upload(VK_FORMAT_R32G32B32A32_SFLOAT, finite, "color");
  const auto depthImage = upload(VK_FORMAT_R32_SFLOAT, vergence, "vergence");

  DofInputs inputs;
  inputs.extent = {color.width, color.height};
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
    return state_->declareTechnique(graph, now, technique, options);
  });
  rendering.statistics.replacedTexels += replaced;
  return rendering;
}

}  // namespace lensgraph::host
