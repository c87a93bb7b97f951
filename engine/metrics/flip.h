// FLIP: how visible the difference between two pictures is to someone who flips between them on a display.
//
// Source: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for Alternating
// Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020 (LDR-FLIP); with their published errata: filters of two
// Gaussians are normalized as one, and borders repeat the outermost pixels. One pass in colour (contrast sensitivity
// filters, L*a*b* with Hunt's effect, HyAB distance) and one in features (edges and points); see flip_band.cpp. Unlike
// PSNR, FLIP depends on how far away the display is. FLIP of scenes brighter than a display is in hdr_flip.h.
#pragma once

#include "engine/image/image.h"

namespace lensgraph::engine {

/// Pixels per degree of visual angle: a display 0.7 m wide with 3840 pixels, seen from 0.7 m. The paper's choice.
inline constexpr double kFlipPixelsPerDegree = 67.0206;

struct FlipOptions {
  double exposureEv = 0.0;                        ///< Stops by which both pictures are brightened before display.
  double pixelsPerDegree = kFlipPixelsPerDegree;  ///< 1…1000.
};

struct Flip {
  FloatImage map;     ///< One channel, 0 (the same) to 1 (as different as blue and green); never NaN.
  double mean = 0.0;  ///< Of the map.
};

/// FLIP of the displayed pictures: brightened, clamped to [0,1]. NaN counts as black, as displayed() has it. The order of
/// the two does not matter. Works in bands of rows on all processors; beside the map it takes about 40 MB a thread for
/// pictures 8192 px wide. Throws Error: as requireComparable(); pixelsPerDegree out of range.
Flip flip(const FloatImage& image, const FloatImage& reference, const FlipOptions& options = {});

/// The mean of a map over the pixels where the mask (one channel, same size) is above 0; 0 where there are none.
/// Precondition: equal sizes.
double meanUnderMask(const FloatImage& map, const FloatImage& mask);

}  // namespace lensgraph::engine
