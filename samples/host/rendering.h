// What a rendering is asked for, and what it returns.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/image/image.h"
#include "passes/parameters.h"
#include "rendergraph/capture.h"
#include "rendergraph/execute_options.h"
#include "rendergraph/image_tap.h"
#include "shaders/shared/statistics.h"

namespace lensgraph::host {

inline constexpr float kNothingHit = 1e10f;  ///< m; the depth of the background in pictures.

struct Rendering {
  engine::FloatImage color;  ///< Linear RGBA, premultiplied; alpha 1 except of pictures that have it (apply).
  engine::FloatImage depth;  ///< View depth in metres, one channel, kNothingHit where nothing is hit; empty for apply.
  shared::FrameStatistics statistics{};
  rendergraph::Capture capture;  ///< Of the last execution.
  double gpuMs = 0.0;            ///< Device time of all executions.
  double wallMs = 0.0;           ///< Host time of all executions. The first render() also compiles shaders.
  double cpuMs = 0.0;            ///< Processor time of all threads of the process during these executions.
  uint64_t graphBytes = 0;       ///< Memory that the graph allocated for an execution, the largest of all.
  uint32_t executions = 0;       ///< Of the graph; progressive techniques take several for one picture.
  /// One line each: what of the shot had no effect, or why the picture may not be what was meant.
  std::vector<std::string> warnings;
  double estimatedError = -1.0;  ///< RMS standard error of a progressive technique; negative when it has none.
};

/// What RenderOptions::taps asked for.
struct Tapped {
  std::vector<engine::FloatImage> pictures;     ///< One for each tap; empty where nothing matched.
  std::vector<rendergraph::TapChoice> choices;  ///< Every image that could have been tapped.
};

/// Done executions and their number; called between executions. Of `raytraced`: parts of the work.
using Progress = std::function<void(uint32_t done, uint32_t total)>;

/// A picture of a progressive technique before it is finished: after how many of its executions, and the picture.
using Intermediate = std::function<void(uint32_t executions, const engine::FloatImage& color)>;

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
  /// Called with the picture after each of the executions that `intermediateAt` names (from 1, ascending), the finished
  /// one excepted. Null: never.
  Intermediate intermediate;
  std::vector<uint32_t> intermediateAt;
  /// Images of passes to be copied into `tapped`, which may be null without taps and lives as long as the rendering.
  /// A progressive technique's come from the last execution that has the pass. Formats that are no picture throw.
  std::vector<rendergraph::ImageTap> taps;
  Tapped* tapped = nullptr;
  /// Lists get no more room than this, and the picture is what fits. Without it, room grows and the frame is rendered
  /// again until everything fits.
  std::optional<ListRoom> fixedRoom;
  /// Called with the capture of each execution, if set.
  std::function<void(const rendergraph::Capture&)> observe;
  /// Of `raytraced` alone: a file in which the state is kept, and from which an interrupted rendering goes on; empty: none.
  std::filesystem::path checkpoint;
};

}  // namespace lensgraph::host
