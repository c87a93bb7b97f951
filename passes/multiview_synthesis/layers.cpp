// Spacing of layers. Intervals are closed ranges of vergence; all arithmetic is in double, the result in float.
#include "passes/multiview_synthesis/layers.h"

#include <algorithm>
#include <cmath>

namespace lensgraph::passes::multiview_synthesis {
namespace {

struct Interval {
  double farVergence, nearVergence;
  double length() const { return nearVergence - farVergence; }
};

/// Closes gaps narrower than `least`, and the smallest ones until no more than `most` intervals are left.
void closeGaps(std::vector<Interval>& intervals, std::size_t most, double least) {
  while (intervals.size() > 1) {
    const auto gap = [&](std::size_t i) { return intervals[i].farVergence - intervals[i + 1].nearVergence; };
    std::size_t best = 0;
    for (std::size_t i = 1; i + 1 < intervals.size(); ++i) {
      if (gap(i) < gap(best)) best = i;
    }
    if (intervals.size() <= most && gap(best) >= least) return;
    intervals[best].farVergence = intervals[best + 1].farVergence;
    intervals.erase(intervals.begin() + static_cast<std::ptrdiff_t>(best) + 1);
  }
}

uint32_t layersOf(const Interval& interval, double thickness) {
  return static_cast<uint32_t>(std::clamp(std::ceil(interval.length() / thickness - 1e-6), 1.0, 1e6));
}

uint64_t layersOf(std::span<const Interval> intervals, double thickness) {
  uint64_t sum = 0;
  for (const auto& interval : intervals) sum += layersOf(interval, thickness);
  return sum;
}

/// The thinnest layers, no thinner than `thickness`, of which no more than `most` are needed.
double thicknessFor(std::span<const Interval> intervals, double thickness, uint32_t most) {
  if (layersOf(intervals, thickness) <= most) return thickness;
  double total = 0.0;
  for (const auto& interval : intervals) total += interval.length();
  double low = thickness, high = std::max(total, thickness);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (layersOf(intervals, middle) <= most ? high : low) = middle;
  }
  return high;
}

/// With room for the rounding of depths that are interpolated and stored; what then touches becomes one.
std::vector<Interval> padded(std::span<const VergenceInterval> occupied, double leastLength) {
  std::vector<Interval> intervals;
  for (const auto& one : occupied) {
    const double pad = std::max(1e-5 * one.nearest, 0.5 * leastLength);
    const Interval wider{std::max(one.farthest - pad, 0.0), one.nearest + pad};
    if (!intervals.empty() && wider.nearVergence >= intervals.back().farVergence) {
      intervals.back().farVergence = wider.farVergence;
    } else {
      intervals.push_back(wider);
    }
  }
  if (intervals.empty()) intervals.push_back({0.0, leastLength});
  return intervals;
}

}  // namespace

std::vector<shared::SceneLayer> sceneLayers(std::span<const VergenceInterval> occupied, const LayerSpacing& spacing) {
  const double wanted = spacing.travel / spacing.pixelsPerVergence;
  // A hundredth of a layer is thin enough to cost nothing and thick enough not to vanish in float.
  auto intervals = padded(occupied, 0.01 * wanted);
  const bool isFixed = spacing.fixedCount > 0;
  const uint32_t most = isFixed ? std::min(spacing.fixedCount, spacing.mostLayers) : spacing.mostLayers;
  closeGaps(intervals, most, isFixed ? 0.0 : spacing.smallestGap / spacing.pixelsPerVergence);
  const double whole = intervals.front().nearVergence - intervals.back().farVergence;
  const double thickness = thicknessFor(intervals, isFixed ? 0.01 * whole / most : wanted, most);

  std::vector<shared::SceneLayer> layers;
  for (const auto& interval : intervals) {
    const uint32_t count = layersOf(interval, thickness);
    const double step = interval.length() / count;
    const double overlap = kLayerOverlap * step;
    for (uint32_t i = 0; i < count; ++i) {
      const double near = interval.nearVergence - i * step;
      const double far = i + 1 == count ? interval.farVergence : interval.nearVergence - (i + 1) * step;
      layers.push_back({.borders = {static_cast<float>(near), static_cast<float>(far)},
                        .nearest = static_cast<float>(near + overlap),
                        .farthest = static_cast<float>(std::max(far - overlap, 0.0))});
    }
  }
  return layers;
}

}  // namespace lensgraph::passes::multiview_synthesis
