// Interpolation on the curve of accumulation: see equal_quality.h.
#include "samples/lensgraph/bench/results/equal_quality.h"

#include <cmath>
#include <limits>

namespace lensgraph::cli {

double ssimDecibels(double ssim) {
  return ssim >= 1.0 ? std::numeric_limits<double>::infinity() : -10.0 * std::log10(1.0 - ssim);
}

std::optional<double> samplesAtQuality(std::span<const CurvePoint> curve, double quality) {
  const CurvePoint* before = nullptr;
  for (const CurvePoint& point : curve) {
    if (!std::isfinite(point.quality)) continue;
    if (point.quality >= quality) {
      if (point.quality == quality) return point.samples;
      if (before == nullptr) return {};
      const double share = (quality - before->quality) / (point.quality - before->quality);
      return before->samples * std::pow(point.samples / before->samples, share);
    }
    before = &point;
  }
  return {};
}

}  // namespace lensgraph::cli
