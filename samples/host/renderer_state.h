// The inside of a Renderer, shared by the files that implement it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/draw/scene_renderer.h"
#include "engine/graph/graph_backend.h"
#include "engine/vulkan/device.h"
#include "passes/technique.h"
#include "rendergraph/executor.h"
#include "samples/host/rendering.h"
#include "samples/host/shot.h"

namespace lensgraph::host {

/// A technique of the registry, configured.
struct ChosenTechnique {
  const passes::Technique& entry;
  std::unique_ptr<const passes::ConfiguredTechnique> configured;
};

/// The technique that the options name, with their parameters. Throws engine::Error (bad input).
ChosenTechnique techniqueOf(const RenderOptions& options);

/// What of a frame comes back to the host; default-made handles are not asked for.
struct ReadBacks {
  rendergraph::Buffer color, depth, standardError;
  std::vector<rendergraph::Buffer> statistics;
};

/// What a frame's declaration gives the host: the technique's outputs, and the statistics of all its parts.
struct FrameOutputs {
  passes::DofOutputs technique;
  std::vector<rendergraph::Buffer> statistics;
};

struct RendererState {
  explicit RendererState(engine::Device& usedDevice) : device(usedDevice), backend(usedDevice), executor(backend) {}

  /// Declares one frame.
  using DeclareFrame = std::function<FrameOutputs(rendergraph::Graph&, uint32_t frame)>;

  passes::DofInputs sceneInputs(const Shot& shot);
  passes::SceneShading importShading(rendergraph::Graph& graph) const;
  Rendering run(const ChosenTechnique& technique, const passes::DofInputs& inputs, const RenderOptions& options,
                const DeclareFrame& declareFrame);
  std::vector<std::string> warningsOf(const Shot& shot, const passes::Technique& technique,
                                      const passes::ParameterSet& parameters, const Rendering& rendering) const;
  ReadBacks declareReadBacks(rendergraph::Graph& graph, const FrameOutputs& frame, bool isLast, bool wantDepth);
  FrameOutputs declareTechnique(rendergraph::Graph& graph, passes::DofInputs inputs, const ChosenTechnique& technique,
                                bool wantDepth);

  engine::Device& device;
  engine::GraphBackend backend;
  rendergraph::Executor executor;
  std::optional<engine::Scene> scene;
  std::unique_ptr<engine::SceneRenderer> renderer;
  std::optional<engine::Environment> environment;
  /// Fragment nodes have all the room that the device can give, and what found none is left out.
  bool nodesAreCapped = false;
  bool nothingIsVisible = false;  ///< Of the scene, in the shot that sceneInputs() was asked for last.
  passes::SceneDraw sceneDraw;
  std::vector<passes::VergenceInterval> occupied;  ///< What sceneDraw refers to.
};

}  // namespace lensgraph::host
