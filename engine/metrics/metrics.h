// How far a picture is from its reference, in the figures that papers quote: PSNR, SSIM, maximum error, relative RMSE.
//
// PSNR, SSIM and the maximum error are of the displayed pictures (displayed.h). SSIM (ssim.h) is of the Rec.709 luma of
// the encoded values. FLIP is in flip.h and hdr_flip.h. Does not do: colour spaces other than linear Rec.709.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/image/image.h"

namespace lensgraph::engine {

struct MetricsOptions {
  double exposureEv = 0.0;           ///< Stops by which both pictures are brightened before they are displayed.
  const FloatImage* mask = nullptr;  ///< One channel, same size: only pixels above 0 are measured. Null: all.
};

/// Only RGB is compared; alpha is not. A picture of one channel counts as grey.
struct Metrics {
  double psnr = 0.0;               ///< dB, peak 1, over R, G and B of the displayed pictures; infinity when equal.
  std::optional<double> ssim;      ///< None when the picture, or the mask inside its borders, is too small to say.
  double maxErrorDisplayed = 0.0;  ///< Largest difference of a channel of the displayed pictures, 0…1.
  double maxErrorLinear = 0.0;     ///< Largest difference of a channel in linear light (no exposure), finite samples.
  /// sqrt(sum (a-b)²) / sqrt(sum b²) in linear light over finite samples, b the reference: highlights count.
  /// 0 when equal, infinity when the reference is black and the picture is not.
  double relativeRmse = 0.0;
  uint64_t pixelCount = 0;          ///< Pixels measured.
  uint64_t nonFinitePixels = 0;     ///< Pixels of the picture with a NaN or infinite R, G or B.
  uint64_t nonFiniteReference = 0;  ///< The same for the reference.
};

/// Throws Error unless both have pixels, the same size, and 1, 3 or 4 channels: what every comparison requires.
void requireComparable(const FloatImage& image, const FloatImage& reference);

/// Compares RGB of two pictures of equal size. Displayed, NaN is black and ±infinity is 1 or 0: a NaN counts
/// as an error against a bright reference. In linear light pixels that are not finite in both pictures are
/// left out; the counts say how many. Works in bands of rows, so that it needs little memory beside the pictures.
/// Throws Error: as requireComparable(); a mask of another size or without a pixel above 0.
Metrics compareImages(const FloatImage& image, const FloatImage& reference, const MetricsOptions& options = {});

/// The same for several masks in one go over the pictures: one result for each mask, in their order. A null mask selects
/// all pixels; a mask that selects none gives no result. Throws Error: as requireComparable(); a mask of another size.
std::vector<std::optional<Metrics>> compareUnderMasks(const FloatImage& image, const FloatImage& reference,
                                                      double exposureEv, std::span<const FloatImage* const> masks);

}  // namespace lensgraph::engine
