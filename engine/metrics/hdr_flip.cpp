// HDR-FLIP: see hdr_flip.h.
#include "engine/metrics/hdr_flip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "engine/metrics/flip_band.h"
#include "engine/metrics/metrics.h"

namespace lensgraph::engine {
namespace {

// Narkowicz 2015: t(x) = x (a x + b) / (x (c x + d) + e), here with the 0.6 that his exposure cancels already in it.
constexpr double kA = 0.6 * 0.6 * 2.51, kB = 0.6 * 0.03, kC = 0.6 * 0.6 * 2.43, kD = 0.6 * 0.59, kE = 0.14;

// The tone-mapped value of the brightest pixel at the first, and of the median pixel at the last exposure (§3).
constexpr double kTarget = 0.85;

// Tone-mapped, everything above about 8 is 1; light is limited to this, so that its square stays finite.
constexpr double kCertainlyWhite = 1e4;

// Input x with t(x) = kTarget: the positive root of (a - t c) x² + (b - t d) x - t e = 0.
double lightAtTarget() {
  const double p = (kB - kTarget * kD) / (kA - kTarget * kC), q = -kTarget * kE / (kA - kTarget * kC);
  return -0.5 * p + std::sqrt(0.25 * p * p - q);
}

DisplayLight toneMapped(double exposureEv) {
  return [gain = std::exp2(exposureEv)](std::span<const float> samples, std::span<float> target) {
    for (size_t i = 0; i < samples.size(); ++i) {
      const double exposed = samples[i] * gain;
      const double x = exposed > 0.0 ? std::min(exposed, kCertainlyWhite) : 0.0;  // NaN becomes 0
      target[i] = static_cast<float>(std::min(x * (kA * x + kB) / (x * (kC * x + kD) + kE), 1.0));
    }
  };
}

// Luminance of a pixel, negative samples taken as 0; none when a sample is not finite.
std::optional<float> luminanceOf(const FloatImage& picture, size_t pixel) {
  constexpr double weights[3] = {0.2126, 0.7152, 0.0722};
  double luminance = 0.0;
  for (uint32_t c = 0; c < 3; ++c) {
    const float sample = picture.samples[pixel * picture.channels + (picture.channels == 1 ? 0 : c)];
    if (!std::isfinite(sample)) return std::nullopt;
    luminance += weights[c] * std::max(sample, 0.0f);
  }
  return static_cast<float>(std::min<double>(luminance, std::numeric_limits<float>::max()));
}

// The middle value, or the mean of the two in the middle. Reorders the values. Precondition: not empty.
double medianOf(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (double{*middle} + double{*std::max_element(values.begin(), middle)});
}

}  // namespace

ExposureRange hdrFlipExposures(const FloatImage& reference) {
  std::vector<float> luminances;
  luminances.reserve(reference.pixelCount());
  for (size_t i = 0; i < reference.pixelCount(); ++i) {
    if (const auto luminance = luminanceOf(reference, i)) luminances.push_back(*luminance);
  }
  const double brightest = luminances.empty() ? 0.0 : *std::max_element(luminances.begin(), luminances.end());
  if (!(brightest > 0.0)) return {};
  double median = medianOf(luminances);
  if (!(median > 0.0)) {
    std::erase_if(luminances, [](float luminance) { return !(luminance > 0.0f); });
    median = medianOf(luminances);
  }
  ExposureRange range{std::log2(lightAtTarget() / brightest), std::log2(lightAtTarget() / median), 2};
  const double stops = std::ceil(range.lastEv - range.firstEv);
  range.count = static_cast<uint32_t>(std::clamp(stops, 2.0, double{kMostExposures}));
  return range;
}

HdrFlip hdrFlip(const FloatImage& image, const FloatImage& reference, double pixelsPerDegree) {
  requireComparable(image, reference);
  requirePixelsPerDegree(pixelsPerDegree);
  const FlipFilters filters = flipFilters(pixelsPerDegree);
  HdrFlip result{FloatImage(image.width, image.height, 1), 0.0, hdrFlipExposures(reference)};
  const ExposureRange& range = result.exposures;
  const double step = range.count > 1 ? (range.lastEv - range.firstEv) / (range.count - 1) : 0.0;
  const auto bands = bandsOf(image.height, kFlipRowsPerBand);
  forEachInParallel(bands.size(), [&](size_t i) {
    const size_t first = size_t{bands[i].first} * image.width;
    std::vector<float> values(size_t{bands[i].end - bands[i].first} * image.width);
    for (uint32_t e = 0; e < range.count; ++e) {
      flipBand(filters, image, reference, toneMapped(range.firstEv + e * step), bands[i], values);
      for (size_t v = 0; v < values.size(); ++v) {
        result.map.samples[first + v] = std::max(result.map.samples[first + v], values[v]);
      }
    }
  });
  result.mean = meanOf(result.map);
  return result;
}

}  // namespace lensgraph::engine
