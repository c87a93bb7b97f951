// Where depth of field goes wrong: masks of pixels, each named after the failure that it catches.
//
// Computed from the signed circle of confusion of the pinhole picture: c, a radius in px, negative for surfaces nearer
// than the focus (c = K (V_f - V), shaders/shared/lens.h), and from the reference picture. Distances are between pixel
// centers. Discs are round: blades, anamorphic ratio and cat's eye of a lens are not looked at.
//
//   nearEdge          A *step* is a pair of pixels side by side or one above the other whose c differ by more than 1 px.
//                     No smooth surface has one unless it cuts the lens: for a plane at distance h from the center of a
//                     lens of radius E, |grad c| ≤ E/h. Since c falls with vergence, the pixel with the smaller c is the
//                     nearer side. Where it has c < -1 px, its blur spreads over what it borders: all pixels within |c|
//                     of it are in the mask. Failures: hard rims and halos of the near field.
//   inFocus           |c| < 0.5 px. Failure: sharp pixels that lose their sharpness or take color from blurred ones.
//   partialOcclusion  Pixels p for which some pixel q has a c more than 1 px away from that of p, while the disc of q
//                     reaches p or that of p reaches q: |p - q| ≤ max(|c_p|, |c_q|). Light of different depths mixes
//                     there, and surfaces hidden in the pinhole picture may show. A smooth surface whose c changes by
//                     more than 1 px within its own blur counts too. Failure: missing or wrong hidden surfaces.
//   highlight         The reference's largest of R, G and B is above 1. Failure: bokeh that is dim, noisy or misshapen.
#pragma once

#include <string_view>
#include <vector>

#include "engine/image/image.h"

namespace lensgraph::engine {

struct FailureMask {
  std::string_view name;  ///< "nearEdge", "inFocus", "partialOcclusion" or "highlight": as in JSON.
  FloatImage pixels;      ///< One channel: 1 inside, 0 outside.
};

/// The four masks, in the order above. `cocRadius`: c of each pixel, one channel. `reference`: linear light, of the same
/// size. Takes time in proportion to the pixels and the length of the steps rather than to the area of the blur. Throws
/// Error: sizes differ, no pixels, several channels of c, c that is not finite.
std::vector<FailureMask> failureMasks(const FloatImage& cocRadius, const FloatImage& reference);

/// One by one. Preconditions: one channel, finite values, at least one pixel.
FloatImage nearEdgeMask(const FloatImage& cocRadius);
FloatImage inFocusMask(const FloatImage& cocRadius);
FloatImage partialOcclusionMask(const FloatImage& cocRadius);
/// Precondition: 1, 3 or 4 channels. NaN is not bright.
FloatImage highlightMask(const FloatImage& reference);

}  // namespace lensgraph::engine
