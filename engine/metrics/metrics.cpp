// PSNR, SSIM and linear errors as metrics.h defines them, band by band. All sums are double.
#include "engine/metrics/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "engine/error.h"
#include "engine/metrics/bands.h"
#include "engine/metrics/displayed.h"
#include "engine/metrics/ssim.h"

namespace lensgraph::engine {
namespace {

// Rows measured at a time; SSIM's window adds 10 rows to each band. 8192 columns then take 60 MB for each thread.
constexpr uint32_t kRowsPerBand = 64;

// What one band adds to the figures under one mask.
struct Sums {
  uint64_t pixels = 0, nonFinitePixels = 0, nonFiniteReference = 0;
  double squaredError = 0.0, squaredReference = 0.0, maxErrorLinear = 0.0;
  double squaredErrorDisplayed = 0.0, maxErrorDisplayed = 0.0;
  double ssim = 0.0;
  uint64_t ssimPixels = 0;

  void add(const Sums& other) {
    pixels += other.pixels;
    nonFinitePixels += other.nonFinitePixels;
    nonFiniteReference += other.nonFiniteReference;
    squaredError += other.squaredError;
    squaredReference += other.squaredReference;
    maxErrorLinear = std::max(maxErrorLinear, other.maxErrorLinear);
    squaredErrorDisplayed += other.squaredErrorDisplayed;
    maxErrorDisplayed = std::max(maxErrorDisplayed, other.maxErrorDisplayed);
    ssim += other.ssim;
    ssimPixels += other.ssimPixels;
  }
};

// R, G, B of a pixel; grey pictures give it three times.
std::array<float, 3> rgbOf(const FloatImage& image, size_t pixel) {
  const float* p = image.samples.data() + pixel * image.channels;
  if (image.channels == 1) return {p[0], p[0], p[0]};
  return {p[0], p[1], p[2]};
}

bool isFinite(const std::array<float, 3>& rgb) {
  return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

void addLinear(const std::array<float, 3>& a, const std::array<float, 3>& b, Sums& sums) {
  ++sums.pixels;
  if (!isFinite(a)) ++sums.nonFinitePixels;
  if (!isFinite(b)) ++sums.nonFiniteReference;
  if (!isFinite(a) || !isFinite(b)) return;
  for (size_t c = 0; c < 3; ++c) {
    const double difference = double{a[c]} - double{b[c]};
    sums.squaredError += difference * difference;
    sums.squaredReference += double{b[c]} * double{b[c]};
    sums.maxErrorLinear = std::max(sums.maxErrorLinear, std::fabs(difference));
  }
}

void addDisplayed(const float* a, const float* b, Sums& sums) {
  for (size_t c = 0; c < 3; ++c) {
    const double difference = double{a[c]} - double{b[c]};
    sums.squaredErrorDisplayed += difference * difference;
    sums.maxErrorDisplayed = std::max(sums.maxErrorDisplayed, std::fabs(difference));
  }
}

// Displayed rows of a band with kSsimRadius more above and below it, mirrored at the picture's border.
struct DisplayedBand {
  std::vector<float> rgb;
  std::vector<double> luma;

  DisplayedBand(const FloatImage& image, double exposureEv, Band band) {
    const size_t width = image.width;
    const int first = static_cast<int>(band.first) - kSsimRadius, end = static_cast<int>(band.end) + kSsimRadius;
    rgb.resize(3 * width * static_cast<size_t>(end - first));
    luma.resize(rgb.size() / 3);
    for (int y = first; y < end; ++y) {
      const auto row = static_cast<uint32_t>(mirroredIndex(y, static_cast<int>(image.height)));
      displayRow(image, exposureEv, row, std::span(rgb).subspan(3 * width * static_cast<size_t>(y - first), 3 * width));
    }
    for (size_t i = 0; i < luma.size(); ++i) {
      luma[i] = 0.2126 * rgb[3 * i] + 0.7152 * rgb[3 * i + 1] + 0.0722 * rgb[3 * i + 2];
    }
  }
};

struct Comparison {
  const FloatImage& image;
  const FloatImage& reference;
  double exposureEv;
  std::span<const FloatImage* const> masks;

  bool isTooSmallForSsim() const { return std::min(image.width, image.height) <= 2 * kSsimRadius; }

  /// Whether SSIM's window around the pixel lies inside the picture.
  bool countsForSsim(uint32_t x, uint32_t y) const {
    constexpr uint32_t border = kSsimRadius;
    return !isTooSmallForSsim() && x >= border && y >= border && x < image.width - border && y < image.height - border;
  }

  /// The sums of one band, for each mask.
  std::vector<Sums> measure(Band band) const {
    const DisplayedBand shown(image, exposureEv, band), shownReference(reference, exposureEv, band);
    const size_t width = image.width;
    std::vector<double> ssim;
    if (!isTooSmallForSsim()) {
      ssim.resize(width * (band.end - band.first));
      ssimRows(shown.luma, shownReference.luma, static_cast<int>(width), static_cast<int>(band.end - band.first), ssim);
    }
    std::vector<Sums> sums(masks.size());
    for (uint32_t y = band.first; y < band.end; ++y) {
      for (uint32_t x = 0; x < width; ++x) {
        const size_t pixel = y * width + x, inBand = (y - band.first) * width + x;
        const size_t inShown = 3 * (inBand + kSsimRadius * width);
        for (size_t m = 0; m < masks.size(); ++m) {
          if (masks[m] != nullptr && !(masks[m]->samples[pixel] > 0.0f)) continue;
          addLinear(rgbOf(image, pixel), rgbOf(reference, pixel), sums[m]);
          addDisplayed(shown.rgb.data() + inShown, shownReference.rgb.data() + inShown, sums[m]);
          if (!countsForSsim(x, y)) continue;
          sums[m].ssim += ssim[inBand];
          ++sums[m].ssimPixels;
        }
      }
    }
    return sums;
  }
};

Metrics metricsFrom(const Sums& sums) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Metrics metrics;
  metrics.pixelCount = sums.pixels;
  metrics.nonFinitePixels = sums.nonFinitePixels;
  metrics.nonFiniteReference = sums.nonFiniteReference;
  metrics.maxErrorLinear = sums.maxErrorLinear;
  metrics.maxErrorDisplayed = sums.maxErrorDisplayed;
  if (sums.squaredError > 0.0) {
    metrics.relativeRmse =
        sums.squaredReference == 0.0 ? infinity : std::sqrt(sums.squaredError / sums.squaredReference);
  }
  metrics.psnr = sums.squaredErrorDisplayed == 0.0
                     ? infinity
                     : 10.0 * std::log10(3.0 * static_cast<double>(sums.pixels) / sums.squaredErrorDisplayed);
  if (sums.ssimPixels > 0) metrics.ssim = sums.ssim / static_cast<double>(sums.ssimPixels);
  return metrics;
}

}  // namespace

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

std::vector<std::optional<Metrics>> compareUnderMasks(const FloatImage& image, const FloatImage& reference,
                                                      double exposureEv, std::span<const FloatImage* const> masks) {
  requireComparable(image, reference);
  for (const FloatImage* mask : masks) {
    if (mask != nullptr && (mask->width != image.width || mask->height != image.height || mask->channels != 1)) {
      throw Error("the mask must have one channel and the size of the pictures");
    }
  }
  const Comparison comparison{image, reference, exposureEv, masks};
  const auto bands = bandsOf(image.height, kRowsPerBand);
  std::vector<std::vector<Sums>> ofBands(bands.size());
  forEachInParallel(bands.size(), [&](size_t i) { ofBands[i] = comparison.measure(bands[i]); });
  std::vector<std::optional<Metrics>> results;
  for (size_t m = 0; m < masks.size(); ++m) {
    Sums sums;
    for (const auto& ofBand : ofBands) sums.add(ofBand[m]);
    results.push_back(sums.pixels == 0 ? std::nullopt : std::optional(metricsFrom(sums)));
  }
  return results;
}

Metrics compareImages(const FloatImage& image, const FloatImage& reference, const MetricsOptions& options) {
  const FloatImage* const masks[] = {options.mask};
  const auto metrics = compareUnderMasks(image, reference, options.exposureEv, masks);
  if (!metrics.front()) throw Error("the mask selects no pixel");
  return *metrics.front();
}

}  // namespace lensgraph::engine
