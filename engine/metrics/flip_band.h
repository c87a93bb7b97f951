// FLIP of a few rows, from the light that a display would send: what flip.h and hdr_flip.h have in common.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "engine/image/image.h"
#include "engine/metrics/bands.h"
#include "engine/metrics/flip_filters.h"

namespace lensgraph::engine {

/// Rows of a band at FLIP: the filters reach 10 rows beyond it (at 67 pixels per degree).
inline constexpr uint32_t kFlipRowsPerBand = 64;

/// The linear light, in [0,1], that a display sends for one sample of a picture, whatever the sample is.
using DisplayLight = std::function<void(std::span<const float> samples, std::span<float> light)>;

/// FLIP of the rows of a band, into `values`, row by row. `light` maps samples of both pictures. Preconditions: as
/// requireComparable(); `values` has room for the band.
void flipBand(const FlipFilters& filters, const FloatImage& image, const FloatImage& reference,
              const DisplayLight& light, Band band, std::span<float> values);

/// The mean of a map without NaN; sums in double, row by row. Precondition: not empty.
double meanOf(const FloatImage& map);

/// Throws Error unless 1 ≤ pixelsPerDegree ≤ 1000.
void requirePixelsPerDegree(double pixelsPerDegree);

}  // namespace lensgraph::engine
