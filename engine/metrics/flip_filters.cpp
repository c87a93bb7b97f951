// FLIP's filters: see flip_filters.h.
#include "engine/metrics/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lensgraph::engine {
namespace {

// Weights below this share of the largest one change no result in float, and are cut off.
constexpr double kSmallestShare = 1e-9;

// Width of the edge and point detectors in degrees (Andersson et al. 2020, §3.2: from Burr and Morrone).
constexpr double kFeatureWidth = 0.082;

// Contrast sensitivity in space: amplitude · sqrt(π/b) · exp(-π² x²/b), x in degrees (§3.1.1, table 1).
struct Gaussian {
  double amplitude, b;
};
constexpr Gaussian kAchromatic{1.0, 0.0047}, kRedGreen{1.0, 0.0053};
constexpr std::array<Gaussian, 2> kBlueYellow = {{{34.1, 0.04}, {13.5, 0.025}}};

// exp(-π² x²/b) at the pixels within the radius, three standard deviations of the widest Gaussian; b in square degrees.
std::vector<double> sampled(double b, double pixelsPerDegree) {
  constexpr double pi = std::numbers::pi;
  const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(kBlueYellow[0].b / (2.0 * pi * pi)) * pixelsPerDegree));
  std::vector<double> weights;
  for (int i = -radius; i <= radius; ++i) {
    const double degrees = i / pixelsPerDegree;
    weights.push_back(std::exp(-pi * pi * degrees * degrees / b));
  }
  return weights;
}

double sumOf(const std::vector<double>& weights) {
  double sum = 0.0;
  for (const double weight : weights) sum += weight;
  return sum;
}

// Without the outermost weights that count for nothing.
FilterTaps trimmed(const std::vector<double>& weights) {
  const double largest = std::abs(
      *std::max_element(weights.begin(), weights.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  size_t cut = 0;
  while (cut < weights.size() / 2 && std::abs(weights[cut]) < kSmallestShare * largest) ++cut;
  FilterTaps taps;
  for (size_t i = cut; i < weights.size() - cut; ++i) taps.weights.push_back(static_cast<float>(weights[i]));
  return taps;
}

FilterTaps normalizedSum(std::vector<double> weights) {
  const double sum = sumOf(weights);
  for (double& weight : weights) weight /= sum;
  return trimmed(weights);
}

// Positive weights sum to 1, negative ones to -1.
FilterTaps normalizedBySign(std::vector<double> weights) {
  double positive = 0.0, negative = 0.0;
  for (const double weight : weights) (weight > 0.0 ? positive : negative) += weight;
  for (double& weight : weights) {
    if (weight != 0.0) weight /= weight > 0.0 ? positive : -negative;
  }
  return trimmed(weights);
}

void setFeatureFilters(double pixelsPerDegree, FlipFilters& filters) {
  const double sigma = 0.5 * kFeatureWidth * pixelsPerDegree;  // px
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  std::vector<double> across, edge, point;
  for (int x = -radius; x <= radius; ++x) {
    const double gauss = std::exp(-x * x / (2.0 * sigma * sigma));
    across.push_back(gauss);
    edge.push_back(-x * gauss);
    point.push_back((x * x / (sigma * sigma) - 1.0) * gauss);
  }
  filters.across = normalizedSum(across);
  filters.edge = normalizedBySign(edge);
  filters.point = normalizedBySign(point);
}

}  // namespace

int FlipFilters::reach() const {
  return std::max({achromatic.radius(), redGreen.radius(), blueYellow[0].radius(), blueYellow[1].radius(),
                   across.radius(), edge.radius(), point.radius()});
}

FlipFilters flipFilters(double pixelsPerDegree) {
  FlipFilters filters;
  filters.achromatic = normalizedSum(sampled(kAchromatic.b, pixelsPerDegree));
  filters.redGreen = normalizedSum(sampled(kRedGreen.b, pixelsPerDegree));
  // The two-dimensional weight of each Gaussian in the sum, before the sum is normalized.
  std::array<double, 2> mass{};
  for (size_t i = 0; i < 2; ++i) {
    const auto weights = sampled(kBlueYellow[i].b, pixelsPerDegree);
    const double sum = sumOf(weights);
    mass[i] = kBlueYellow[i].amplitude * std::sqrt(std::numbers::pi / kBlueYellow[i].b) * sum * sum;
    filters.blueYellow[i] = normalizedSum(weights);
  }
  for (size_t i = 0; i < 2; ++i) filters.blueYellowShares[i] = static_cast<float>(mass[i] / (mass[0] + mass[1]));
  setFeatureFilters(pixelsPerDegree, filters);
  return filters;
}

}  // namespace lensgraph::engine
