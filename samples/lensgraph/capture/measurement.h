// Measured frames: how they are timed, and what was measured.
#pragma once

#include <functional>
#include <vector>

#include "engine/vulkan/device.h"
#include "rendergraph/capture_series.h"
#include "samples/host/renderer.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {

/// Several frames of one picture.
struct Measurement {
  rendergraph::CaptureSeries series;  ///< The last execution of each frame.
  std::vector<double> gpuMs, wallMs;  ///< By frame, over all its executions.
  /// By frame, of isolated timing: device time of the same picture in one piece, with passes free to overlap.
  std::vector<double> uninterruptedMs;
  std::vector<rendergraph::Capture> executions;  ///< All of them, in order.
};

/// Times of whole frames of one picture, ms, frame by frame; nothing but the frame was measured.
struct FrameTimes {
  std::vector<double> gpuMs, wallMs;
  std::vector<double> cpuMs;  ///< Processor time, user and system, of all threads of the process.
  void add(const host::Rendering& rendering);
};

using RenderOnce = std::function<host::Rendering(const host::RenderOptions& options)>;

/// As the arguments say; otherwise isolated on CPU devices, where timestamps of single passes are wrong once something
/// is drawn.
rendergraph::Timing timingOf(const InspectionArguments& arguments, const engine::DeviceDescription& device);

/// Renders a warm-up frame and then the frames to measure, each isolated one beside the same frame in one piece. Returns
/// the last one. Throws what `renderOnce` throws, and engine::Error when the frames differ in their passes.
host::Rendering measureFrames(const InspectionArguments& arguments, host::RenderOptions options,
                              const RenderOnce& renderOnce, Measurement& measurement);

}  // namespace lensgraph::cli
