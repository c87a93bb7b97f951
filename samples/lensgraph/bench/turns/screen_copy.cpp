// Two persistent pictures, so that a copy is all that a frame does: see screen_copy.h.
#include "samples/lensgraph/bench/turns/screen_copy.h"

#include <algorithm>

#include "engine/process_usage.h"

namespace lensgraph::cli {

using rendergraph::Image;
using rendergraph::PassContext;
using rendergraph::PassKind;
using rendergraph::Usage;

ScreenCopy::ScreenCopy(const engine::Device& device, uint32_t width, uint32_t height)
    : backend_(device), executor_(backend_), width_(width), height_(height) {}

TurnTimes ScreenCopy::copy() {
  graph_.reset();
  const rendergraph::ImageDesc desc{.format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = width_, .height = height_};
  Image from = graph_.persistentImage("from", desc);
  Image to = graph_.persistentImage("to", desc);
  if (!isFilled_) {
    auto fill = graph_.addPass("fill", PassKind::transfer);
    from = fill.write(from, Usage::transferDestination);
    fill.record([from](PassContext& context) { context.clearImage(from, {}); });
  }
  auto copy = graph_.addPass("copy", PassKind::transfer);
  copy.read(from, Usage::transferSource);
  to = copy.write(to, Usage::transferDestination);
  copy.record([from, to](PassContext& context) { context.copyImage(from, to); });
  graph_.finish();
  rendergraph::ExecuteOptions options;
  options.timing = rendergraph::Timing::inlineTimestamps;
  const double cpuMsBefore = engine::processCpuMs();
  executor_.execute(graph_, options);
  const double cpuMs = engine::processCpuMs() - cpuMsBefore;
  isFilled_ = true;
  const auto& capture = executor_.capture();
  return {.cpuMs = cpuMs, .wallMs = capture.frameWallMs, .gpuMs = std::max(capture.frameGpuMs, 0.0)};
}

}  // namespace lensgraph::cli
