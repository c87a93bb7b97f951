// Patterns in [0, 1)^4 and their way to the aperture; see lens_samples.h for the sources.
#include "passes/lens/lens_samples.h"

#include <algorithm>
#include <cmath>

namespace lensgraph::passes {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// Blades straighter than this are straight: the arc is then nearer than 5e-5 lens radii to its chord, and
/// larger radii lose digits in the sector's area.
constexpr double kMinCurvature = 1e-4;

// ---- Patterns
// -------------------------------------------------------------------------------------------------------

/// One dimension of Sobol's sequence: a primitive polynomial and its first direction numbers (Joe and Kuo,
/// new-joe-kuo-6, dimensions 2 to 4).
struct SobolDimension {
  uint32_t degree;
  uint32_t coefficients;
  std::array<uint32_t, 3> first;
};
constexpr std::array<SobolDimension, 3> kSobolDimensions = {{{1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}}};

using SobolMatrix = std::array<uint32_t, 32>;  ///< Direction numbers, bit 31 is 1/2.

constexpr SobolMatrix sobolMatrix(const SobolDimension& dimension) {
  SobolMatrix m{};
  for (uint32_t k = 0; k < 32; ++k) {
    if (k < dimension.degree) {
      m[k] = dimension.first[k] << (31 - k);
      continue;
    }
    const uint32_t oldest = m[k - dimension.degree];
    m[k] = oldest ^ (oldest >> dimension.degree);
    for (uint32_t j = 1; j < dimension.degree; ++j) {
      if ((dimension.coefficients >> (dimension.degree - 1 - j)) & 1u) m[k] ^= m[k - j];
    }
  }
  return m;
}

constexpr SobolMatrix vanDerCorputMatrix() {
  SobolMatrix m{};
  for (uint32_t k = 0; k < 32; ++k) m[k] = 1u << (31 - k);
  return m;
}

constexpr std::array<SobolMatrix, 4> kSobol = {vanDerCorputMatrix(), sobolMatrix(kSobolDimensions[0]),
                                               sobolMatrix(kSobolDimensions[1]), sobolMatrix(kSobolDimensions[2])};

/// Scramble seeds of the four dimensions: fixed, so that a picture can be made again. Any odd-looking numbers
/// do.
constexpr std::array<uint32_t, 4> kScrambleSeeds = {0x9c1d3a75u, 0x2f6be4d1u, 0xe58a0c93u, 0x74d2915fu};

constexpr uint32_t reverseBits(uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
}

/// Nested uniform scrambling by a hash in which every bit depends only on itself and the bits above it (Laine
/// and Karras 2011; Vegdahl's constants). Keeps the stratification of the sequence.
constexpr uint32_t owenScramble(uint32_t x, uint32_t seed) {
  x = reverseBits(x);
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return reverseBits(x);
}

double sobol(uint32_t index, std::size_t dimension) {
  uint32_t x = 0;
  for (std::size_t bit = 0; bit < 32; ++bit) {
    if ((index >> bit) & 1u) x ^= kSobol[dimension][bit];
  }
  return (owenScramble(x, kScrambleSeeds[dimension]) + 0.5) * 0x1p-32;
}

/// Digits of index + 1 (0 would be the corner of the square) mirrored at the point.
double radicalInverse(uint32_t index, uint32_t base) {
  double value = 0.0, digitWeight = 1.0 / base;
  for (uint64_t rest = uint64_t{index} + 1; rest != 0; rest /= base, digitWeight /= base) {
    value += static_cast<double>(rest % base) * digitWeight;
  }
  return std::min(value, 1.0 - 0x1p-53);
}

/// Steps of the recurrence as 64-bit fixed point, exact at any index. Lens: 1/ρ and 1/ρ², ρ the plastic
/// number (Roberts 2018, R2). Pixel: √7 and √11 without their whole parts; of the roots and of Roberts' own
/// four-dimensional steps these tell least about the lens point, and the latter double the error of the lens.
constexpr std::array<uint64_t, 4> kRecurrenceSteps = {
    static_cast<uint64_t>(0.75487766624669276 * 0x1p64), static_cast<uint64_t>(0.56984029099805327 * 0x1p64),
    static_cast<uint64_t>(0.64575131106459059 * 0x1p64), static_cast<uint64_t>(0.31662479035539985 * 0x1p64)};

double recurrence(uint32_t index, std::size_t dimension) {
  const uint64_t fixed = (uint64_t{1} << 63) + (uint64_t{index} + 1) * kRecurrenceSteps[dimension];
  return static_cast<double>(fixed >> 11) * 0x1p-53;
}

// ---- Aperture
// -------------------------------------------------------------------------------------------------------

struct Polar {
  double radius;  ///< 0…1; its square is uniform.
  double angle;   ///< rad, y up; uniform.
};

/// Shirley and Chiu 1997: squares around the centre become circles.
Polar concentric(double u0, double u1) {
  const double a = 2.0 * u0 - 1.0, b = 2.0 * u1 - 1.0;
  if (a == 0.0 && b == 0.0) return {0.0, 0.0};
  Polar polar = std::abs(a) > std::abs(b) ? Polar{a, kPi / 4.0 * (b / a)} : Polar{b, kPi / 2.0 - kPi / 4.0 * (a / b)};
  if (polar.radius < 0.0) polar = {-polar.radius, polar.angle + kPi};
  return polar;
}

struct Point {
  double x, y;
};

/// Point of one blade's edge, the blade's axis being x: the one whose sector from the axis has share `t`
/// (-1…1) of the area of half the wedge. So equal steps of t sweep equal areas, whatever the edge's form.
Point bladeEdge(double t, double halfWedge, double curvature) {
  const double a = std::cos(halfWedge), s = std::sin(halfWedge);
  if (curvature < kMinCurvature) return {a, s * t};
  // Arc of radius R about (centre, 0); the sector up to arc angle β has area (R²β + centre·R·sin β)/2.
  const double arcRadius = 1.0 / curvature;
  const double centre = a - std::sqrt(arcRadius * arcRadius - s * s);
  const double lastAngle = std::asin(s * curvature);
  const auto twiceArea = [&](double beta) { return arcRadius * (arcRadius * beta + centre * std::sin(beta)); };
  const double target = t * twiceArea(lastAngle);
  double beta = t * lastAngle;
  for (int i = 0; i < 6; ++i) {  // Newton on a nearly linear function: 4 steps reach the last digit.
    beta -= (twiceArea(beta) - target) / (arcRadius * (arcRadius + centre * std::cos(beta)));
  }
  return {centre + arcRadius * std::cos(beta), arcRadius * std::sin(beta)};
}

Point polygonPoint(const shared::ApertureShape& shape, const Polar& polar) {
  const double halfWedge = kPi / shape.bladeCount;
  const double blade = std::round(polar.angle / (2.0 * halfWedge));
  const double t = std::clamp(polar.angle / halfWedge - 2.0 * blade, -1.0, 1.0);
  const Point edge = bladeEdge(t, halfWedge, static_cast<double>(shape.bladeCurvature));
  const double axis = static_cast<double>(shape.bladeRotation) + kPi / 2.0 + (2.0 * blade + 1.0) * halfWedge;
  const double cosine = std::cos(axis), sine = std::sin(axis);
  return {polar.radius * (cosine * edge.x - sine * edge.y), polar.radius * (sine * edge.x + cosine * edge.y)};
}

}  // namespace

std::array<double, 4> patternPoint(LensPattern pattern, uint32_t index) {
  constexpr std::array<uint32_t, 4> haltonBases = {2, 3, 5, 7};
  std::array<double, 4> point{};
  for (std::size_t d = 0; d < point.size(); ++d) {
    switch (pattern) {
      case LensPattern::sobol:
        point[d] = sobol(index, d);
        break;
      case LensPattern::halton:
        point[d] = radicalInverse(index, haltonBases[d]);
        break;
      case LensPattern::r2:
        point[d] = recurrence(index, d);
        break;
    }
  }
  return point;
}

shared::vec2 aperturePoint(const shared::ApertureShape& shape, double u0, double u1) {
  Polar polar = concentric(u0, u1);
  if (shape.gaussian != 0u) {
    // 1 - ρ² is uniform; its logarithm makes the radius that of a normal distribution. The bound keeps it
    // finite.
    const double rest = std::max(1.0 - polar.radius * polar.radius, 0x1p-53);
    polar.radius = std::sqrt(-2.0 * std::log(rest));
  }
  const bool polygon = shape.bladeCount >= 3 && shape.gaussian == 0u;
  const Point point = polygon ? polygonPoint(shape, polar)
                              : Point{polar.radius * std::cos(polar.angle), polar.radius * std::sin(polar.angle)};
  const double stretch = std::sqrt(static_cast<double>(shape.anamorphicRatio));
  return {static_cast<float>(point.x * stretch), static_cast<float>(-point.y / stretch)};
}

LensSample lensSample(const shared::ApertureShape& shape, LensPattern pattern, uint32_t index, bool pixelJitter) {
  // A float below 0.5; u - 0.5 may round up to 0.5, which is the neighbour's pixel.
  const float last = std::nextafter(0.5f, 0.0f);
  const auto u = patternPoint(pattern, index);
  LensSample sample{};
  sample.v = aperturePoint(shape, u[0], u[1]);
  sample.weight = shared::apertureRingWeight(shape, sample.v);
  if (pixelJitter) {
    sample.pixelOffset = {std::min(static_cast<float>(u[2] - 0.5), last),
                          std::min(static_cast<float>(u[3] - 0.5), last)};
  }
  return sample;
}

std::vector<LensSample> lensSamples(const shared::ApertureShape& shape, LensPattern pattern, uint32_t count,
                                    bool pixelJitter) {
  std::vector<LensSample> samples;
  samples.reserve(count);
  double sum = 0.0;
  for (uint32_t i = 0; i < count; ++i) {
    samples.push_back(lensSample(shape, pattern, i, pixelJitter));
    sum += static_cast<double>(samples.back().weight);
  }
  // A lone sample where the aberration leaves no light still makes a picture.
  for (auto& sample : samples) {
    sample.weight = sum > 0.0 ? static_cast<float>(static_cast<double>(sample.weight) * count / sum) : 1.0f;
  }
  return samples;
}

}  // namespace lensgraph::passes
