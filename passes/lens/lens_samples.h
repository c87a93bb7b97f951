// Points of the lens and of the pixel that sampling techniques look through: low-discrepancy patterns mapped
// to the shape of the aperture.
//
// Sources: Sobol direction numbers after Joe and Kuo 2008, hashed Owen scrambling after Laine and Karras
// 2011; Halton; the R2 sequence (Roberts 2018); concentric map of square to disc after Shirley and Chiu 1997.
// Patterns have four dimensions, two for the lens and two for the pixel, so neither predicts the other.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "shaders/shared/aperture.h"

namespace lensgraph::passes {

enum class LensPattern : uint8_t {
  sobol,   ///< Owen-scrambled Sobol; best at powers of two. Lens points are a (0,2)-sequence in base 2.
  halton,  ///< Bases 2, 3 for the lens and 5, 7 for the pixel.
  r2,      ///< Additive recurrence R2 for the lens, of square roots for the pixel.
};
inline constexpr std::array<std::string_view, 3> kLensPatternNames = {"sobol", "halton", "r2"};

struct LensSample {
  shared::vec2 v;            ///< Lens point in units of the lens radius E; x right, y down.
  float weight = 1.0f;       ///< apertureRingWeight, scaled to mean 1 over the set. Without the cat's eye, which
                             ///< depends on the pixel: multiply by apertureVignette() there.
  shared::vec2 pixelOffset;  ///< px, each in [-0.5, 0.5).
};

/// Point `index` of a pattern in [0, 1)^4: 0 and 1 are for the lens, 2 and 3 for the pixel.
std::array<double, 4> patternPoint(LensPattern pattern, uint32_t index);

/// Uniform point of the aperture for a uniform point of the unit square; continuous, without holes or folds.
/// For a Gaussian aperture: normal, σ = √q and 1/√q in x and y (q the anamorphic ratio). Precondition: 0 ≤
/// u0, u1 < 1.
shared::vec2 aperturePoint(const shared::ApertureShape& shape, double u0, double u1);

/// Sample `index` by itself, with its weight not normalised: for who divides by the sum of weights.
LensSample lensSample(const shared::ApertureShape& shape, LensPattern pattern, uint32_t index, bool pixelJitter);

/// Samples 0 … count - 1. Lens points and pixel offsets of sample i do not depend on `count`, so a set can be
/// continued; weights do, by their normalisation. Without `pixelJitter` every offset is 0 (the pixel's
/// centre).
std::vector<LensSample> lensSamples(const shared::ApertureShape& shape, LensPattern pattern, uint32_t count,
                                    bool pixelJitter);

}  // namespace lensgraph::passes
