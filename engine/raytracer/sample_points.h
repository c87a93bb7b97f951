// Points of the unit square in a low-discrepancy order, scrambled anew for every pixel; and their way to the disc and to
// the pixel filter.
//
// Sources: the (0,2)-sequence of van der Corput and Sobol (Kollig and Keller 2002, "Efficient multidimensional
// sampling"); nested uniform scrambling of index and coordinates by a hash (Burley 2020, "Practical hash-based Owen
// scrambling", JCGT 9(4), with the constants of its listing 2); the concentric map (Shirley and Chiu 1997).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string_view>

namespace lensgraph::engine {

/// A hash of three numbers, to be used as the seed of one stream of points.
uint32_t streamSeed(uint32_t pixel, uint32_t seed, uint32_t stream);

/// Point `index` of the stream, in [0, 1)². The first 2^k points of a stream lie one in each cell of every grid of 2^k
/// equal rectangles. Streams of different seeds are independent of each other.
glm::dvec2 samplePoint(uint32_t index, uint32_t seed);

/// Uniform on the unit disc for a uniform point of the unit square.
glm::dvec2 discPoint(const glm::dvec2& ofSquare);

/// What a pixel integrates over: samples are distributed as the filter weighs, so each counts the same.
enum class PixelFilter : uint8_t {
  box,    ///< The pixel's square, 1 px wide.
  tent,   ///< Falls linearly to 0 at 1 px from the center, in x and y.
  gauss,  ///< σ = 0.5 px, not cut off.
  point,  ///< The pixel's center alone.
};
inline constexpr std::array<std::string_view, 4> kPixelFilterNames = {"box", "tent", "gauss", "point"};

/// Offset from the pixel's center in px for a uniform point of the unit square.
glm::dvec2 filterOffset(PixelFilter filter, const glm::dvec2& ofSquare);

}  // namespace lensgraph::engine
