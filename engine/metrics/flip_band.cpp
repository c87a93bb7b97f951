// FLIP of a band of rows: Andersson et al. 2020, §3 and figure 2.
//
// Both pictures are brought into the opponent space, filtered along rows (with the rows that the filters reach above and
// below), then along columns, and compared pixel by pixel. Beyond the border the outermost pixel is repeated.
#include "engine/metrics/flip_band.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/metrics/flip_color.h"

namespace lensgraph::engine {
namespace {

// Exponents of the colour and the feature difference, and the break of the colour difference's mapping to [0,1] (§3.1.3,
// §3.2, §3.3): differences up to kBreak of the largest take the range up to kBreakValue.
constexpr float kColorExponent = 0.7f, kFeatureExponent = 0.5f;
constexpr float kBreak = 0.4f, kBreakValue = 0.95f;

using Plane = std::vector<float>;

// A row of samples of each channel, continued by `reach` repeated samples on both sides.
struct PaddedRow {
  Plane luminance, redGreen, blueYellow;
  explicit PaddedRow(size_t size) : luminance(size), redGreen(size), blueYellow(size) {}
};

// Adds the row, weighted by the taps and by `share`, to `target`. Loops over pixels inside, so that compilers vectorize.
void addRow(const FilterTaps& taps, float share, const Plane& padded, size_t reach, std::span<float> target) {
  const size_t start = reach - static_cast<size_t>(taps.radius());
  for (size_t k = 0; k < taps.weights.size(); ++k) {
    const float weight = share * taps.weights[k];
    const float* source = padded.data() + start + k;
    for (size_t x = 0; x < target.size(); ++x) target[x] += weight * source[x];
  }
}

// The rows of one picture that a band depends on, filtered along rows.
class FilteredRows {
 public:
  FilteredRows(const FlipFilters& filters, const FloatImage& image, const DisplayLight& light, Band band)
      : filters_(filters), width_(image.width), reach_(static_cast<size_t>(filters.reach())) {
    const size_t rows = band.end - band.first + 2 * reach_;
    for (Plane* plane : {&achromatic_, &redGreen_, &blueYellow_[0], &blueYellow_[1], &across_, &edge_, &point_}) {
      plane->assign(rows * width_, 0.0f);
    }
    PaddedRow padded(width_ + 2 * reach_);
    for (size_t y = 0; y < rows; ++y) {
      const int64_t wanted = int64_t{band.first} + static_cast<int64_t>(y) - static_cast<int64_t>(reach_);
      fill(padded, image, light, static_cast<size_t>(std::clamp<int64_t>(wanted, 0, int64_t{image.height} - 1)));
      filterRow(padded, y);
    }
  }

  /// What the filters say about one row of the band: colours, and the strength of edges and points.
  struct Row {
    std::vector<float> luminance, redGreen, blueYellow, edgeX, edgeY, pointX, pointY;
  };
  void filterColumns(size_t row, Row& result) const {
    const auto apply = [&](const FilterTaps& taps, float share, const Plane& plane, std::vector<float>& target) {
      const size_t first = row + reach_ - static_cast<size_t>(taps.radius());
      for (size_t k = 0; k < taps.weights.size(); ++k) {
        const float weight = share * taps.weights[k];
        const float* source = plane.data() + (first + k) * width_;
        for (size_t x = 0; x < width_; ++x) target[x] += weight * source[x];
      }
    };
    for (auto* target : {&result.luminance, &result.redGreen, &result.blueYellow, &result.edgeX, &result.edgeY,
                         &result.pointX, &result.pointY}) {
      target->assign(width_, 0.0f);
    }
    apply(filters_.achromatic, 1.0f, achromatic_, result.luminance);
    apply(filters_.redGreen, 1.0f, redGreen_, result.redGreen);
    for (size_t i = 0; i < 2; ++i) {
      apply(filters_.blueYellow[i], filters_.blueYellowShares[i], blueYellow_[i], result.blueYellow);
    }
    apply(filters_.across, 1.0f, edge_, result.edgeX);
    apply(filters_.edge, 1.0f, across_, result.edgeY);
    apply(filters_.across, 1.0f, point_, result.pointX);
    apply(filters_.point, 1.0f, across_, result.pointY);
  }

 private:
  void fill(PaddedRow& padded, const FloatImage& image, const DisplayLight& light, size_t row) {
    const std::span<const float> samples(image.samples.data() + row * width_ * image.channels, width_ * image.channels);
    light_.resize(samples.size());
    light(samples, light_);
    for (size_t i = 0; i < padded.luminance.size(); ++i) {
      const size_t x = std::clamp(i, reach_, reach_ + width_ - 1) - reach_;
      const float* p = light_.data() + x * image.channels;
      const Opponent color =
          image.channels == 1 ? opponentOf(relativeXyz(p[0], p[0], p[0])) : opponentOf(relativeXyz(p[0], p[1], p[2]));
      padded.luminance[i] = color.luminance;
      padded.redGreen[i] = color.redGreen;
      padded.blueYellow[i] = color.blueYellow;
    }
  }

  void filterRow(const PaddedRow& padded, size_t y) {
    const auto rowOf = [&](Plane& plane) { return std::span(plane).subspan(y * width_, width_); };
    addRow(filters_.achromatic, 1.0f, padded.luminance, reach_, rowOf(achromatic_));
    addRow(filters_.redGreen, 1.0f, padded.redGreen, reach_, rowOf(redGreen_));
    for (size_t i = 0; i < 2; ++i) {
      addRow(filters_.blueYellow[i], 1.0f, padded.blueYellow, reach_, rowOf(blueYellow_[i]));
    }
    addRow(filters_.across, 1.0f, padded.luminance, reach_, rowOf(across_));
    addRow(filters_.edge, 1.0f, padded.luminance, reach_, rowOf(edge_));
    addRow(filters_.point, 1.0f, padded.luminance, reach_, rowOf(point_));
  }

  const FlipFilters& filters_;
  size_t width_, reach_;
  Plane achromatic_, redGreen_, across_, edge_, point_;
  std::array<Plane, 2> blueYellow_;
  Plane light_;  ///< Scratch: the light of one row.
};

// The largest colour difference, between pure blue and pure green, to the power of kColorExponent.
float largestColorDifference() {
  const HuntLab green = huntLab(opponentOf(relativeXyz(0.0f, 1.0f, 0.0f)));
  const HuntLab blue = huntLab(opponentOf(relativeXyz(0.0f, 0.0f, 1.0f)));
  return std::pow(hyab(green, blue), kColorExponent);
}

float colorDifference(const HuntLab& a, const HuntLab& b) {
  static const float largest = largestColorDifference();
  const float difference = std::pow(hyab(a, b), kColorExponent);
  const float atBreak = kBreak * largest;
  if (difference < atBreak) return difference / atBreak * kBreakValue;
  return kBreakValue + (difference - atBreak) / (largest - atBreak) * (1.0f - kBreakValue);
}

float featureDifference(float edgeA, float edgeB, float pointA, float pointB) {
  const float difference = std::max(std::fabs(edgeA - edgeB), std::fabs(pointA - pointB));
  return std::min(std::pow(difference / std::sqrt(2.0f), kFeatureExponent), 1.0f);
}

float length(float x, float y) {
  return std::sqrt(x * x + y * y);
}

}  // namespace

void flipBand(const FlipFilters& filters, const FloatImage& image, const FloatImage& reference,
              const DisplayLight& light, Band band, std::span<float> values) {
  const FilteredRows filteredA(filters, image, light, band), filteredB(filters, reference, light, band);
  FilteredRows::Row a, b;
  for (size_t y = 0; y < band.end - band.first; ++y) {
    filteredA.filterColumns(y, a);
    filteredB.filterColumns(y, b);
    float* target = values.data() + y * image.width;
    for (size_t x = 0; x < image.width; ++x) {
      const float color = colorDifference(huntLab({a.luminance[x], a.redGreen[x], a.blueYellow[x]}),
                                          huntLab({b.luminance[x], b.redGreen[x], b.blueYellow[x]}));
      const float feature = featureDifference(length(a.edgeX[x], a.edgeY[x]), length(b.edgeX[x], b.edgeY[x]),
                                              length(a.pointX[x], a.pointY[x]), length(b.pointX[x], b.pointY[x]));
      target[x] = std::clamp(std::pow(color, 1.0f - feature), 0.0f, 1.0f);
    }
  }
}

double meanOf(const FloatImage& map) {
  double sum = 0.0;
  for (const float value : map.samples) sum += value;
  return sum / static_cast<double>(map.samples.size());
}

void requirePixelsPerDegree(double pixelsPerDegree) {
  if (pixelsPerDegree >= 1.0 && pixelsPerDegree <= 1000.0) return;
  throw Error({.file = {},
               .field = "pixels per degree",
               .reason = "is " + std::to_string(pixelsPerDegree) + ", must be from 1 to 1000",
               .remedy = {}});
}

}  // namespace lensgraph::engine
