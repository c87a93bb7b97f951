// LDR-FLIP of displayed pictures: see flip.h.
#include "engine/metrics/flip.h"

#include <algorithm>
#include <cmath>

#include "engine/metrics/flip_band.h"
#include "engine/metrics/metrics.h"

namespace lensgraph::engine {

Flip flip(const FloatImage& image, const FloatImage& reference, const FlipOptions& options) {
  requireComparable(image, reference);
  requirePixelsPerDegree(options.pixelsPerDegree);
  const FlipFilters filters = flipFilters(options.pixelsPerDegree);
  // The sRGB encoding that a display undoes is left out. The comparison turns NaN into 0.
  const double gain = std::exp2(options.exposureEv);
  const DisplayLight light = [gain](std::span<const float> samples, std::span<float> target) {
    for (size_t i = 0; i < samples.size(); ++i) {
      const double exposed = samples[i] * gain;
      target[i] = exposed > 0.0 ? static_cast<float>(std::min(exposed, 1.0)) : 0.0f;
    }
  };
  Flip result{FloatImage(image.width, image.height, 1), 0.0};
  const auto bands = bandsOf(image.height, kFlipRowsPerBand);
  forEachInParallel(bands.size(), [&](size_t i) {
    const auto rows = std::span(result.map.samples).subspan(size_t{bands[i].first} * image.width);
    flipBand(filters, image, reference, light, bands[i], rows);
  });
  result.mean = meanOf(result.map);
  return result;
}

double meanUnderMask(const FloatImage& map, const FloatImage& mask) {
  double sum = 0.0;
  size_t count = 0;
  for (size_t i = 0; i < map.samples.size(); ++i) {
    if (!(mask.samples[i] > 0.0f)) continue;
    sum += map.samples[i];
    ++count;
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace lensgraph::engine
