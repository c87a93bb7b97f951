// The picture that a display shows of a linear one: exposure, clamp to [0,1], sRGB encoding, kept in float (no step of 8
// bits). PSNR, SSIM and maximum error are measured on it.
#pragma once

#include <cstdint>
#include <span>

#include "engine/image/image.h"

namespace lensgraph::engine {

/// The displayed picture, RGB (one channel stays one), float in [0,1]; alpha is dropped. `exposureEv`: stops by which the
/// picture is brightened first. NaN becomes 0, infinity 1, -infinity 0.
FloatImage displayed(const FloatImage& image, double exposureEv);

/// One row of the displayed picture, always three channels: grey gives R = G = B. `rgb` has room for 3 · image.width
/// values. Preconditions: row < image.height; the picture has 1 channel, or at least 3.
void displayRow(const FloatImage& image, double exposureEv, uint32_t row, std::span<float> rgb);

}  // namespace lensgraph::engine
