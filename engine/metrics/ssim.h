// Structural similarity (SSIM) after Wang, Bovik, Sheikh, Simoncelli 2004, of pictures with one channel in [0,1].
//
// 11x11 Gaussian window, sigma 1.5 px, K1 0.01, K2 0.03, population covariance: scikit-image's structural_similarity(
// gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1). Its mean leaves out a border of
// kSsimRadius pixels. Windows over the border are filled by mirroring about the pixel edges (d c b a | a b c d).
#pragma once

#include <span>

#include "engine/image/image.h"

namespace lensgraph::engine {

/// px. scikit-image's int(truncate 3.5 · sigma 1.5 + 0.5): the window is 2 · 5 + 1 wide.
inline constexpr int kSsimRadius = 5;

/// The row, or column, that stands for row `i` of a picture of `size` rows: i itself inside, mirrored outside.
int mirroredIndex(int i, int size);

/// SSIM of some rows. `a` and `b` hold the values of `rows` + 2 · kSsimRadius rows of `width` values, kSsimRadius rows
/// above those wanted and as many below (mirroredIndex() tells which they are at the border); `values` has room for
/// rows · width. All in double: variances are differences of nearly equal numbers.
void ssimRows(std::span<const double> a, std::span<const double> b, int width, int rows, std::span<double> values);

/// The map whose mean, without its border, is SSIM: one channel, full size. Throws Error: sizes differ, pictures without
/// pixels or with more than one channel.
FloatImage ssimMap(const FloatImage& a, const FloatImage& b);

}  // namespace lensgraph::engine
