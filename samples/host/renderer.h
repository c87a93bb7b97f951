// Renders shots: joins engine (device, scene) and passes (techniques) through the render graph.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/draw/environment.h"
#include "engine/image/image.h"
#include "engine/scene/scene.h"
#include "passes/lens/physical_lens.h"
#include "rendergraph/compile_options.h"
#include "rendergraph/graph.h"
#include "rendergraph/plan.h"
#include "samples/host/rendering.h"
#include "samples/host/shot.h"

namespace lensgraph::engine {
class Device;
}

namespace lensgraph::host {

struct RendererState;

/// One scene on one device; keeps its GPU copy, pipelines and plans between renders. The device outlives it.
class Renderer {
 public:
  /// Loads the shot's scene. Throws engine::Error. Warnings of the loader go to `warnings`.
  Renderer(engine::Device& device, const Shot& shot, std::vector<std::string>& warnings);
  /// A scene made in memory. Precondition: engine::findProblems(scene) is empty. `environment` lights lit shots.
  Renderer(engine::Device& device, engine::Scene scene, const std::optional<engine::Environment>& environment);
  /// A renderer for images only (apply()).
  explicit Renderer(engine::Device& device);
  ~Renderer();

  /// The shot may differ from the constructor's in all but its scene. Throws engine::Error (bad parameters name the
  /// parameter and the nearest known one) and rendergraph::GraphError.
  Rendering render(const Shot& shot, const RenderOptions& options);

  /// A technique of TechniqueInput::image on pictures of one size: color grey, RGB or RGBA, linear and premultiplied;
  /// depth one channel, in metres along the axis, where what is not positive is infinitely far (convertDepth() makes it of
  /// others). Alpha is blurred as the colours are; without it the result's is 1. What no technique can use of the colour
  /// is replaced as by cleanColor(), and counted in Rendering::statistics.replacedTexels.
  Rendering apply(const engine::FloatImage& color, const engine::FloatImage& depth, double fovyDeg,
                  const passes::Lens& lens, const RenderOptions& options);

  /// The graph that render() would execute (first frame), compiled for this device; for dumps.
  void declare(rendergraph::Graph& graph, const Shot& shot, const RenderOptions& options);
  rendergraph::Plan compile(const rendergraph::Graph& graph, const rendergraph::CompileOptions& options);

 private:
  std::unique_ptr<RendererState> state_;
};

}  // namespace lensgraph::host
