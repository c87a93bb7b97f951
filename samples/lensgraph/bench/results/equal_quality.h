// How many views accumulation needs for a given quality, read off its own curve.
#pragma once

#include <optional>
#include <span>

namespace lensgraph::cli {

struct CurvePoint {
  double samples = 0.0;  ///< Views, > 0.
  double quality = 0.0;  ///< Larger is better.
};

/// SSIM on a scale on which the error of a mean of samples is a straight line over log(samples), as PSNR is:
/// -10 log10(1 - SSIM). Infinity for 1.
double ssimDecibels(double ssim);

/// Views at which the curve first reaches the quality, interpolated linearly over log(samples). Nothing below the first
/// point and above the best one: the curve does not tell there. Points in ascending order of samples; those that are not
/// finite are left out.
std::optional<double> samplesAtQuality(std::span<const CurvePoint> curve, double quality);

}  // namespace lensgraph::cli
