// Structural similarity: see ssim.h. The Gaussian window is applied along rows, then along columns.
#include "engine/metrics/ssim.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/error.h"
#include "engine/metrics/bands.h"

namespace lensgraph::engine {
namespace {

constexpr double kSigma = 1.5;       // px
constexpr double kC1 = 0.01 * 0.01;  // (K1 · range)²
constexpr double kC2 = 0.03 * 0.03;  // (K2 · range)²
constexpr int kTaps = 2 * kSsimRadius + 1;
constexpr uint32_t kRowsPerBand = 64;  // The window's halo adds 10 rows to each band: a sixth more work.

using Window = std::array<double, kTaps>;

Window gaussianWindow() {
  Window weights{};
  double sum = 0.0;
  for (int i = -kSsimRadius; i <= kSsimRadius; ++i) {
    sum += weights[static_cast<size_t>(i + kSsimRadius)] = std::exp(-0.5 * i * i / (kSigma * kSigma));
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

// Weighted means along a row. `padded` continues the row by kSsimRadius mirrored values on both sides.
void blurRow(const Window& window, const std::vector<double>& padded, std::span<double> target) {
  for (size_t x = 0; x < target.size(); ++x) {
    double sum = 0.0;
    for (size_t k = 0; k < kTaps; ++k) sum += window[k] * padded[x + k];
    target[x] = sum;
  }
}

// The five means that SSIM needs, blurred along rows.
struct RowMeans {
  std::vector<double> a, b, aa, bb, ab;
  explicit RowMeans(size_t size) : a(size), b(size), aa(size), bb(size), ab(size) {}
};

RowMeans blurAlongRows(const Window& window, std::span<const double> a, std::span<const double> b, int width,
                       int rows) {
  const auto columns = static_cast<size_t>(width);
  RowMeans means(columns * static_cast<size_t>(rows));
  const size_t padding = kSsimRadius;
  std::vector<double> pa(columns + 2 * padding), pb(pa.size()), product(pa.size());
  for (size_t y = 0; y < static_cast<size_t>(rows); ++y) {
    for (size_t x = 0; x < pa.size(); ++x) {
      const auto from = static_cast<size_t>(mirroredIndex(static_cast<int>(x) - kSsimRadius, width));
      pa[x] = a[y * columns + from];
      pb[x] = b[y * columns + from];
    }
    const auto blurInto = [&](std::vector<double>& plane, const std::vector<double>& padded) {
      blurRow(window, padded, std::span(plane).subspan(y * columns, columns));
    };
    blurInto(means.a, pa);
    blurInto(means.b, pb);
    for (size_t x = 0; x < pa.size(); ++x) product[x] = pa[x] * pa[x];
    blurInto(means.aa, product);
    for (size_t x = 0; x < pa.size(); ++x) product[x] = pb[x] * pb[x];
    blurInto(means.bb, product);
    for (size_t x = 0; x < pa.size(); ++x) product[x] = pa[x] * pb[x];
    blurInto(means.ab, product);
  }
  return means;
}

// Weighted means of kTaps rows, the first of which is row `y` of the plane.
void blurColumns(const Window& window, const std::vector<double>& plane, size_t y, std::span<double> target) {
  for (double& value : target) value = 0.0;
  for (size_t k = 0; k < kTaps; ++k) {
    const double* row = plane.data() + (y + k) * target.size();
    for (size_t x = 0; x < target.size(); ++x) target[x] += window[k] * row[x];
  }
}

double ssimOf(double a, double b, double aa, double bb, double ab) {
  const double varianceA = aa - a * a, varianceB = bb - b * b, covariance = ab - a * b;
  return (2.0 * a * b + kC1) * (2.0 * covariance + kC2) / ((a * a + b * b + kC1) * (varianceA + varianceB + kC2));
}

}  // namespace

int mirroredIndex(int i, int size) {
  const int period = 2 * size;
  i = ((i % period) + period) % period;
  return i < size ? i : period - 1 - i;
}

void ssimRows(std::span<const double> a, std::span<const double> b, int width, int rows, std::span<double> values) {
  static const Window window = gaussianWindow();
  const auto columns = static_cast<size_t>(width);
  assert(a.size() == columns * static_cast<size_t>(rows + 2 * kSsimRadius) && b.size() == a.size());
  const RowMeans means = blurAlongRows(window, a, b, width, rows + 2 * kSsimRadius);
  std::vector<double> ma(columns), mb(columns), maa(columns), mbb(columns), mab(columns);
  for (size_t y = 0; y < static_cast<size_t>(rows); ++y) {
    blurColumns(window, means.a, y, ma);
    blurColumns(window, means.b, y, mb);
    blurColumns(window, means.aa, y, maa);
    blurColumns(window, means.bb, y, mbb);
    blurColumns(window, means.ab, y, mab);
    for (size_t x = 0; x < columns; ++x) values[y * columns + x] = ssimOf(ma[x], mb[x], maa[x], mbb[x], mab[x]);
  }
}

FloatImage ssimMap(const FloatImage& a, const FloatImage& b) {
  if (a.isEmpty() || a.width != b.width || a.height != b.height) throw Error("an SSIM map is of pictures of one size");
  if (a.channels != 1 || b.channels != 1) throw Error("an SSIM map is of pictures with one channel");
  FloatImage map(a.width, a.height, 1);
  const auto bands = bandsOf(a.height, kRowsPerBand);
  forEachInParallel(bands.size(), [&](size_t i) {
    const int rows = static_cast<int>(bands[i].end - bands[i].first);
    std::vector<double> wideA, wideB, values(size_t{a.width} * static_cast<size_t>(rows));
    for (int y = -kSsimRadius; y < rows + kSsimRadius; ++y) {
      const int from = mirroredIndex(static_cast<int>(bands[i].first) + y, static_cast<int>(a.height));
      const float *rowA = a.pixel(0, static_cast<uint32_t>(from)), *rowB = b.pixel(0, static_cast<uint32_t>(from));
      wideA.insert(wideA.end(), rowA, rowA + a.width);
      wideB.insert(wideB.end(), rowB, rowB + a.width);
    }
    ssimRows(wideA, wideB, static_cast<int>(a.width), rows, values);
    float* target = map.pixel(0, bands[i].first);
    for (size_t v = 0; v < values.size(); ++v) target[v] = static_cast<float>(values[v]);
  });
  return map;
}

}  // namespace lensgraph::engine
