// Renders shots: joins engine (device, scene) and passes (techniques) through the render graph.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "engine/draw/environment.h"
#include "engine/image/image.h"
#include "passes/registry/registry.h"
#include "rendergraph/capture.h"
#include "rendergraph/executor.h"
#include "rendergraph/image_tap.h"
#include "samples/host/shot.h"
#include "shaders/shared/statistics.h"

namespace lensgraph::engine {
class Device;
struct Scene;
}  // namespace lensgraph::engine

namespace lensgraph::host {

struct Rendering {
  engine::FloatImage color;  ///< Linear RGBA.
  engine::FloatImage depth;  ///< View depth in metres, one channel, 1e10 where nothing is hit; empty for apply.
  shared::FrameStatistics statistics{};
  rendergraph::Capture capture;  ///< Of the last execution.
  double gpuMs = 0.0;            ///< Device time of all executions.
  double wallMs = 0.0;           ///< Host time of all executions. The first render() also compiles shaders.
  uint32_t executions = 0;       ///< Of the graph; progressive techniques take several for one picture.
  double estimatedError = -1.0;  ///< RMS standard error of a progressive technique; negative when it has none.
};

/// What RenderOptions::taps asked for.
struct Tapped {
  std::vector<engine::FloatImage> pictures;     ///< One for each tap; empty where nothing matched.
  std::vector<rendergraph::TapChoice> choices;  ///< Every image that could have been tapped.
};

/// Done executions and their number; called between executions.
using Progress = std::function<void(uint32_t done, uint32_t total)>;

/// Room in per-pixel lists, in fragments a pixel; see passes::SceneDraw.
struct ListRoom {
  float fragmentNodes = 1.0f, listFragments = 4.0f;
};

struct RenderOptions {
  std::string technique;
  passes::ParameterSet parameters;
  rendergraph::ExecuteOptions execute;
  bool wantDepth = false;
  Progress progress;
  /// Images of passes to be copied into `tapped`, which may be null without taps and lives as long as the rendering.
  /// A progressive technique's come from the last execution that has the pass. Formats that are no picture throw.
  std::vector<rendergraph::ImageTap> taps;
  Tapped* tapped = nullptr;
  /// Lists get no more room than this, and the picture is what fits. Without it, room grows and the frame is rendered
  /// again until everything fits.
  std::optional<ListRoom> fixedRoom;
  /// Called with the capture of each execution, if set.
  std::function<void(const rendergraph::Capture&)> observe;
};

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

  /// A technique of TechniqueInput::image on pictures: color RGB(A) linear, depth one channel of view depth in
  /// metres, same size.
  Rendering apply(const engine::FloatImage& color, const engine::FloatImage& depth, double fovyDeg,
                  const passes::Lens& lens, const RenderOptions& options);

  /// The graph that render() would execute (first frame), compiled for this device; for dumps.
  void declare(rendergraph::Graph& graph, const Shot& shot, const RenderOptions& options);
  rendergraph::Plan compile(const rendergraph::Graph& graph, const rendergraph::CompileOptions& options);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lensgraph::host
