// How far a picture is from its reference.
//
// PSNR and SSIM are of the displayed picture: exposure, clamp to [0,1], sRGB encoding, kept in float (no
// 8-bit step). SSIM after Wang, Bovik, Sheikh, Simoncelli 2004 on Rec.709 luma of the encoded values; 11x11
// Gaussian, sigma 1.5, K1 0.01, K2 0.03, population covariance, borders of 5 px left out: scikit-image's
// structural_similarity( gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1). Does
// not do: FLIP, colour spaces other than linear Rec.709.
#pragma once

#include <cstdint>
#include <optional>

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

/// Compares RGB of two pictures of equal size. Displayed, NaN is black and ±infinity is 1 or 0: a NaN counts
/// as an error against a bright reference. In linear light pixels that are not finite in both pictures are
/// left out; the counts say how many. Throws Error: sizes differ, picture without pixels, mask of another
/// size or without a pixel above 0.
Metrics compareImages(const FloatImage& image, const FloatImage& reference, const MetricsOptions& options = {});

/// The displayed picture of a linear one, RGB (one channel stays one), float in [0,1]; alpha is dropped.
FloatImage displayed(const FloatImage& image, double exposureEv);

/// The map whose mean is SSIM: one channel, full size (borders too, mirrored), of two one-channel pictures in
/// [0,1].
FloatImage ssimMap(const FloatImage& a, const FloatImage& b);

/// IEC 61966-2-1. Defined for [0,1]; continued below 0 and above 1 by the same formula.
float srgbFromLinear(float linear);
float linearFromSrgb(float encoded);

}  // namespace lensgraph::engine
