// PSNR, SSIM and linear errors as metrics.h defines them. All sums are double.
#include "engine/image/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/error.h"

namespace lensgraph::engine {
namespace {

constexpr int kSsimRadius = 5;           // px: scikit-image's int(truncate 3.5 · sigma 1.5 + 0.5), an 11x11 window
constexpr double kSsimSigma = 1.5;       // px
constexpr double kSsimC1 = 0.01 * 0.01;  // (K1 · range)²
constexpr double kSsimC2 = 0.03 * 0.03;

void requireComparable(const FloatImage& image, const FloatImage& reference) {
  if (image.isEmpty() || reference.isEmpty()) throw Error("a picture to compare has no pixels");
  if (image.width != reference.width || image.height != reference.height) {
    throw Error("pictures differ in size: " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                " and " + std::to_string(reference.width) + "x" + std::to_string(reference.height));
  }
  const auto channelsKnown = [](const FloatImage& i) { return i.channels == 1 || i.channels == 3 || i.channels == 4; };
  if (!channelsKnown(image) || !channelsKnown(reference)) {
    throw Error("pictures to compare must have 1, 3 or 4 channels");
  }
}

// Mask as one byte per pixel; all ones without a mask.
std::vector<uint8_t> selectedPixels(const FloatImage& image, const FloatImage* mask) {
  std::vector<uint8_t> selected(image.pixelCount(), 1);
  if (mask == nullptr) return selected;
  if (mask->width != image.width || mask->height != image.height || mask->channels != 1) {
    throw Error("the mask must have one channel and the size of the pictures");
  }
  for (size_t i = 0; i < selected.size(); ++i) selected[i] = mask->samples[i] > 0.0f ? 1 : 0;
  if (std::find(selected.begin(), selected.end(), 1) == selected.end()) throw Error("the mask selects no pixel");
  return selected;
}

// R, G, B of a pixel; grey pictures give it three times.
std::array<float, 3> rgbOf(const FloatImage& image, size_t pixel) {
  const float* p = image.samples.data() + pixel * image.channels;
  if (image.channels == 1) return {p[0], p[0], p[0]};
  return {p[0], p[1], p[2]};
}

bool isFinite(const std::array<float, 3>& rgb) {
  return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

double lumaOf(const std::array<float, 3>& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

std::array<double, 2 * kSsimRadius + 1> gaussianWindow() {
  std::array<double, 2 * kSsimRadius + 1> weights{};
  double sum = 0.0;
  for (int i = -kSsimRadius; i <= kSsimRadius; ++i) {
    sum += weights[static_cast<size_t>(i + kSsimRadius)] = std::exp(-0.5 * i * i / (kSsimSigma * kSsimSigma));
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

// Mirrors about the pixel edges (d c b a | a b c d), as scipy's mode 'reflect'.
int mirrored(int i, int size) {
  const int period = 2 * size;
  i = ((i % period) + period) % period;
  return i < size ? i : period - 1 - i;
}

std::vector<double> blurred(const std::vector<double>& source, int width, int height) {
  static const auto kWindow = gaussianWindow();
  std::vector<double> rows(source.size()), result(source.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0.0;
      for (int k = -kSsimRadius; k <= kSsimRadius; ++k) {
        sum += kWindow[static_cast<size_t>(k + kSsimRadius)] *
               source[static_cast<size_t>(y) * width + mirrored(x + k, width)];
      }
      rows[static_cast<size_t>(y) * width + x] = sum;
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int k = -kSsimRadius; k <= kSsimRadius; ++k) {
      const double weight = kWindow[static_cast<size_t>(k + kSsimRadius)];
      const double* row = rows.data() + static_cast<size_t>(mirrored(y + k, height)) * width;
      double* target = result.data() + static_cast<size_t>(y) * width;
      for (int x = 0; x < width; ++x) target[x] += weight * row[x];
    }
  }
  return result;
}

std::vector<double> ssimValues(const std::vector<double>& a, const std::vector<double>& b, int width, int height) {
  std::vector<double> aa(a.size()), bb(a.size()), ab(a.size());
  for (size_t i = 0; i < a.size(); ++i) {
    aa[i] = a[i] * a[i];
    bb[i] = b[i] * b[i];
    ab[i] = a[i] * b[i];
  }
  const auto meanA = blurred(a, width, height), meanB = blurred(b, width, height);
  const auto meanAa = blurred(aa, width, height), meanBb = blurred(bb, width, height),
             meanAb = blurred(ab, width, height);
  std::vector<double> values(a.size());
  for (size_t i = 0; i < a.size(); ++i) {
    const double varianceA = meanAa[i] - meanA[i] * meanA[i];
    const double varianceB = meanBb[i] - meanB[i] * meanB[i];
    const double covariance = meanAb[i] - meanA[i] * meanB[i];
    values[i] = (2.0 * meanA[i] * meanB[i] + kSsimC1) * (2.0 * covariance + kSsimC2) /
                ((meanA[i] * meanA[i] + meanB[i] * meanB[i] + kSsimC1) * (varianceA + varianceB + kSsimC2));
  }
  return values;
}

std::vector<double> lumaPlane(const FloatImage& picture) {
  std::vector<double> plane(picture.pixelCount());
  for (size_t i = 0; i < plane.size(); ++i) plane[i] = lumaOf(rgbOf(picture, i));
  return plane;
}

std::optional<double> meanSsim(const FloatImage& a, const FloatImage& b, const std::vector<uint8_t>& selected) {
  const int width = static_cast<int>(a.width), height = static_cast<int>(a.height);
  if (width <= 2 * kSsimRadius || height <= 2 * kSsimRadius) return std::nullopt;
  const std::vector<double> values = ssimValues(lumaPlane(a), lumaPlane(b), width, height);
  double sum = 0.0;
  uint64_t count = 0;
  for (int y = kSsimRadius; y < height - kSsimRadius; ++y) {
    for (int x = kSsimRadius; x < width - kSsimRadius; ++x) {
      const size_t i = static_cast<size_t>(y) * width + x;
      if (!selected[i]) continue;
      sum += values[i];
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

void measureLinear(const FloatImage& image, const FloatImage& reference, const std::vector<uint8_t>& selected,
                   Metrics& metrics) {
  double squaredError = 0.0, squaredReference = 0.0;
  for (size_t i = 0; i < selected.size(); ++i) {
    if (!selected[i]) continue;
    ++metrics.pixelCount;
    const auto a = rgbOf(image, i), b = rgbOf(reference, i);
    if (!isFinite(a)) ++metrics.nonFinitePixels;
    if (!isFinite(b)) ++metrics.nonFiniteReference;
    if (!isFinite(a) || !isFinite(b)) continue;
    for (size_t c = 0; c < 3; ++c) {
      const double difference = double{a[c]} - double{b[c]};
      squaredError += difference * difference;
      squaredReference += double{b[c]} * double{b[c]};
      metrics.maxErrorLinear = std::max(metrics.maxErrorLinear, std::fabs(difference));
    }
  }
  if (squaredError == 0.0) {
    metrics.relativeRmse = 0.0;
  } else if (squaredReference == 0.0) {
    metrics.relativeRmse = std::numeric_limits<double>::infinity();
  } else {
    metrics.relativeRmse = std::sqrt(squaredError / squaredReference);
  }
}

void measureDisplayed(const FloatImage& a, const FloatImage& b, const std::vector<uint8_t>& selected,
                      Metrics& metrics) {
  double squaredError = 0.0;
  for (size_t i = 0; i < selected.size(); ++i) {
    if (!selected[i]) continue;
    const auto pa = rgbOf(a, i), pb = rgbOf(b, i);
    for (size_t c = 0; c < 3; ++c) {
      const double difference = double{pa[c]} - double{pb[c]};
      squaredError += difference * difference;
      metrics.maxErrorDisplayed = std::max(metrics.maxErrorDisplayed, std::fabs(difference));
    }
  }
  metrics.psnr = squaredError == 0.0 ? std::numeric_limits<double>::infinity()
                                     : 10.0 * std::log10(3.0 * static_cast<double>(metrics.pixelCount) / squaredError);
}

}  // namespace

// In double: 1 maps to 1 exactly, and a sum over a picture sees no rounding of the curve.
float srgbFromLinear(float linear) {
  const double x = linear;
  return static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
}

float linearFromSrgb(float encoded) {
  const double x = encoded;
  return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

FloatImage displayed(const FloatImage& image, double exposureEv) {
  const double gain = std::exp2(exposureEv);
  const uint32_t channels = image.channels >= 3 ? 3 : 1;
  FloatImage result(image.width, image.height, channels);
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    for (uint32_t c = 0; c < channels; ++c) {
      const double exposed = image.samples[i * image.channels + c] * gain;
      // The comparison is written so that NaN becomes 0: what a display would show.
      const double clamped = exposed > 0.0 ? std::min(exposed, 1.0) : 0.0;
      result.samples[i * channels + c] = srgbFromLinear(static_cast<float>(clamped));
    }
  }
  return result;
}

FloatImage ssimMap(const FloatImage& a, const FloatImage& b) {
  requireComparable(a, b);
  if (a.channels != 1 || b.channels != 1) throw Error("an SSIM map is of pictures with one channel");
  const std::vector<double> values =
      ssimValues(lumaPlane(a), lumaPlane(b), static_cast<int>(a.width), static_cast<int>(a.height));
  FloatImage map(a.width, a.height, 1);
  std::transform(values.begin(), values.end(), map.samples.begin(), [](double v) { return static_cast<float>(v); });
  return map;
}

Metrics compareImages(const FloatImage& image, const FloatImage& reference, const MetricsOptions& options) {
  requireComparable(image, reference);
  const std::vector<uint8_t> selected = selectedPixels(image, options.mask);
  Metrics metrics;
  measureLinear(image, reference, selected, metrics);
  const FloatImage shown = displayed(image, options.exposureEv);
  const FloatImage shownReference = displayed(reference, options.exposureEv);
  measureDisplayed(shown, shownReference, selected, metrics);
  metrics.ssim = meanSsim(shown, shownReference, selected);
  return metrics;
}

}  // namespace lensgraph::engine
