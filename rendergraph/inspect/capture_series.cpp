// Which frames are alike, and their medians.
#include "rendergraph/capture_series.h"

#include <algorithm>
#include <tuple>

namespace lensgraph::rendergraph {

namespace {

bool sameCosts(const CapturedPass& a, const CapturedPass& b) {
  const auto facts = [](const CapturedPass& pass) {
    return std::tie(pass.name, pass.kind, pass.queue, pass.bytesRead, pass.bytesWritten, pass.imageBarriers,
                    pass.bufferBarriers, pass.barrierBatches, pass.resolution.width, pass.resolution.height, pass.uses);
  };
  return facts(a) == facts(b);
}

/// Everything but the times and how the plan was found.
bool sameStructure(const Capture& a, const Capture& b) {
  const auto facts = [](const Capture& capture) {
    return std::tie(capture.timing, capture.resources, capture.heaps, capture.culled, capture.barrierBatches,
                    capture.imageBarriersAtEnd, capture.bufferBarriersAtEnd, capture.memory);
  };
  return facts(a) == facts(b) && std::ranges::equal(a.passes, b.passes, sameCosts);
}

template <class Value>
Spread spreadOver(const std::vector<Capture>& frames, Value value) {
  std::vector<double> values;
  for (const Capture& frame : frames) values.push_back(value(frame));
  return spreadOf(std::move(values));
}

}  // namespace

Spread spreadOf(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !(value >= 0.0); });
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  const double median = values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  return {.median = median, .min = values.front(), .max = values.back()};
}

bool CaptureSeries::add(const Capture& capture) {
  const bool alike = frames_.empty() || sameStructure(frames_.back(), capture);
  if (!alike) frames_.clear();
  frames_.push_back(capture);
  return alike;
}

Spread CaptureSeries::frameGpuMs() const {
  return spreadOver(frames_, [](const Capture& frame) { return frame.frameGpuMs; });
}

Spread CaptureSeries::frameWallMs() const {
  return spreadOver(frames_, [](const Capture& frame) { return frame.frameWallMs; });
}

Spread CaptureSeries::passSumMs() const {
  return spreadOver(frames_, [](const Capture& frame) {
    double sum = -1.0;
    for (const CapturedPass& pass : frame.passes) {
      if (pass.gpuMs >= 0.0) sum = std::max(sum, 0.0) + pass.gpuMs;
    }
    return sum;
  });
}

Spread CaptureSeries::gpuMs(uint32_t step) const {
  return spreadOver(frames_, [=](const Capture& frame) { return frame.passes[step].gpuMs; });
}

Spread CaptureSeries::recordMs(uint32_t step) const {
  return spreadOver(frames_, [=](const Capture& frame) { return frame.passes[step].recordMs; });
}

uint32_t CaptureSeries::plansReused() const {
  return static_cast<uint32_t>(std::ranges::count_if(frames_, &Capture::planReused));
}

}  // namespace lensgraph::rendergraph
