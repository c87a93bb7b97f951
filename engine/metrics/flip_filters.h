// The filters of FLIP as rows of weights; each filter is a product of one row and one column.
#pragma once

#include <array>
#include <vector>

namespace lensgraph::engine {

/// Weights of 2 · radius() + 1 neighbouring samples, the middle one being the pixel's own.
struct FilterTaps {
  std::vector<float> weights;

  int radius() const { return static_cast<int>(weights.size() / 2); }
};

struct FlipFilters {
  /// Contrast sensitivity (Andersson et al. 2020, §3.1.1), sum 1: of luminance and of the red-green channel.
  FilterTaps achromatic, redGreen;
  /// The blue-yellow channel's filter is a sum of two Gaussians: the first with the weight blueYellowShares[0], the
  /// second with blueYellowShares[1]; the two add up to 1.
  std::array<FilterTaps, 2> blueYellow;
  std::array<float, 2> blueYellowShares{};
  /// Features (§3.2): a Gaussian, sum 1, across; along, its first derivative (edges) or second derivative (points), whose
  /// positive weights sum to 1 and whose negative ones sum to -1.
  FilterTaps across, edge, point;

  /// The largest radius: how many rows beyond a band its pixels depend on.
  int reach() const;
};

/// Precondition: pixelsPerDegree is above 0.
FlipFilters flipFilters(double pixelsPerDegree);

}  // namespace lensgraph::engine
