// Scrambled (0,2)-sequences, and maps of the unit square.
#include "engine/raytracer/sample_points.h"

#include <cmath>
#include <numbers>

namespace lensgraph::engine {
namespace {

using std::numbers::pi;

uint32_t reversedBits(uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(x);
}

/// A permutation of 32 bits that spreads every bit over all (the finalizer of MurmurHash3).
uint32_t mixed(uint32_t x) {
  x ^= x >> 16;
  x *= 0x85ebca6bu;
  x ^= x >> 13;
  x *= 0xc2b2ae35u;
  return x ^ (x >> 16);
}

/// Each bit of the result depends on itself and on the bits above it (Burley 2020, listings 2 and 3).
uint32_t scrambled(uint32_t x, uint32_t seed) {
  x = reversedBits(x) + seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return reversedBits(x);
}

/// Second dimension of the (0,2)-sequence: Pascal's triangle modulo 2 as direction numbers (Kollig and Keller 2002).
uint32_t secondDimension(uint32_t index) {
  uint32_t bits = 0;
  for (uint32_t direction = 0x80000000u; index != 0; index >>= 1, direction ^= direction >> 1) {
    if ((index & 1u) != 0) bits ^= direction;
  }
  return bits;
}

double unit(uint32_t bits) {
  return (bits + 0.5) * 0x1p-32;
}

/// Inverse of the tent's distribution over (-1, 1).
double tentOffset(double u) {
  return u < 0.5 ? std::sqrt(2.0 * u) - 1.0 : 1.0 - std::sqrt(2.0 - 2.0 * u);
}

}  // namespace

uint32_t streamSeed(uint32_t pixel, uint32_t seed, uint32_t stream) {
  return mixed(pixel + mixed(seed + mixed(stream + 0x9e3779b9u)));
}

glm::dvec2 samplePoint(uint32_t index, uint32_t seed) {
  const uint32_t shuffled = scrambled(index, seed);
  return {unit(scrambled(reversedBits(shuffled), mixed(seed ^ 0xa511e9b3u))),
          unit(scrambled(secondDimension(shuffled), mixed(seed ^ 0x63d83595u)))};
}

glm::dvec2 discPoint(const glm::dvec2& ofSquare) {
  const double a = 2.0 * ofSquare.x - 1.0, b = 2.0 * ofSquare.y - 1.0;
  if (a == 0.0 && b == 0.0) return {0.0, 0.0};
  const bool isWide = std::abs(a) > std::abs(b);
  const double radius = isWide ? a : b;
  const double angle = isWide ? pi / 4.0 * (b / a) : pi / 2.0 - pi / 4.0 * (a / b);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

glm::dvec2 filterOffset(PixelFilter filter, const glm::dvec2& ofSquare) {
  switch (filter) {
    case PixelFilter::box:
      return ofSquare - 0.5;
    case PixelFilter::tent:
      return {tentOffset(ofSquare.x), tentOffset(ofSquare.y)};
    case PixelFilter::gauss: {  // Box and Muller 1958; samplePoint() is never 0.
      const double radius = 0.5 * std::sqrt(-2.0 * std::log(ofSquare.x));
      return {radius * std::cos(2.0 * pi * ofSquare.y), radius * std::sin(2.0 * pi * ofSquare.y)};
    }
    case PixelFilter::point:
      break;
  }
  return {0.0, 0.0};
}

}  // namespace lensgraph::engine
