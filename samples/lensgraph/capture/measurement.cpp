// Renders frames and collects their times and captures.
#include "samples/lensgraph/capture/measurement.h"

#include "engine/error.h"

namespace lensgraph::cli {

void FrameTimes::add(const host::Rendering& rendering) {
  gpuMs.push_back(rendering.gpuMs);
  wallMs.push_back(rendering.wallMs);
  cpuMs.push_back(rendering.cpuMs);
}

rendergraph::Timing timingOf(const InspectionArguments& arguments, const engine::DeviceDescription& device) {
  const bool isolated = arguments.timing ? *arguments.timing == "isolated" : device.type == "cpu";
  return isolated ? rendergraph::Timing::isolated : rendergraph::Timing::inlineTimestamps;
}

host::Rendering measureFrames(const InspectionArguments& arguments, host::RenderOptions options,
                              const RenderOnce& renderOnce, Measurement& measurement) {
  const bool isolated = options.execute.timing == rendergraph::Timing::isolated;
  host::RenderOptions inOnePiece = options;
  inOnePiece.execute.timing = rendergraph::Timing::inlineTimestamps;
  renderOnce(options);
  if (arguments.trace) {
    options.observe = [&measurement](const auto& capture) { measurement.executions.push_back(capture); };
  }
  const int frames = arguments.frames.value_or(InspectionArguments::kDefaultFrames);
  host::Rendering rendering;
  for (int frame = 0; frame < frames; ++frame) {
    if (isolated) measurement.uninterruptedMs.push_back(renderOnce(inOnePiece).gpuMs);
    rendering = renderOnce(options);
    measurement.gpuMs.push_back(rendering.gpuMs);
    measurement.wallMs.push_back(rendering.wallMs);
    if (!measurement.series.add(rendering.capture)) {
      throw engine::Error("the measured frames differ in their passes", engine::ErrorKind::failed);
    }
  }
  return rendering;
}

}  // namespace lensgraph::cli
