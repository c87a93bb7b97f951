// HDR-FLIP: FLIP of scenes brighter than a display, as the largest error over a range of exposures.
//
// Source: Andersson, Nilsson, Shirley, Akenine-Möller, "Visualizing Errors in Rendered High Dynamic Range Images",
// Eurographics 2021 short papers. Every exposure is tone-mapped with the ACES fit of Narkowicz 2015. The range follows
// from the reference alone (§3): at the first exposure its brightest pixel, at the last its median pixel is mapped to
// 0.85; exposures between are at most one stop apart, two at least.
#pragma once

#include <cstdint>

#include "engine/image/image.h"
#include "engine/metrics/flip.h"

namespace lensgraph::engine {

/// Which exposures are looked at. Stops; spaced evenly.
struct ExposureRange {
  double firstEv = 0.0;
  double lastEv = 0.0;
  uint32_t count = 1;
};

/// No more exposures than this are looked at; further apart than a stop where the range asks for more. Only pictures
/// whose brightest pixel is 2^64 times the median reach it.
inline constexpr uint32_t kMostExposures = 64;

/// The range for a reference. Pixels with a sample that is not finite do not count, negative samples count as 0. Where
/// half of the picture is black, the median of the pixels that are not is taken (the paper leaves this case open); a
/// reference without light is looked at with one exposure, 0.
ExposureRange hdrFlipExposures(const FloatImage& reference);

struct HdrFlip {
  FloatImage map;           ///< One channel, 0…1; never NaN.
  double mean = 0.0;        ///< Of the map.
  ExposureRange exposures;  ///< Looked at.
};

/// HDR-FLIP of two pictures in linear light. NaN and negative samples count as black, +infinity as white. It takes
/// `exposures.count` times as long as flip(). Throws Error: as flip().
HdrFlip hdrFlip(const FloatImage& image, const FloatImage& reference, double pixelsPerDegree = kFlipPixelsPerDegree);

}  // namespace lensgraph::engine
