// Where a picture differs from its reference, as colours.
#pragma once

#include <array>

#include "engine/image/image.h"

namespace lensgraph::cli {

/// Largest difference of a channel of the displayed pictures that the map still tells apart; above it stays
/// the last colour. A quarter of full scale: most of what depth of field gets wrong lies below.
inline constexpr float kErrorMapEnd = 0.25f;

/// sRGB-encoded colour of an error from 0 (black) over purple and orange to kErrorMapEnd and above (pale
/// yellow).
std::array<float, 3> errorColor(float error);

/// The largest difference of a channel of the displayed pictures, as colours: a linear picture to be written as PNG.
/// `exposureEv`: stops by which both are brightened first. Precondition: both have the same size, and 1, 3 or 4 channels.
engine::FloatImage errorMap(const engine::FloatImage& picture, const engine::FloatImage& reference,
                            double exposureEv = 0.0);

}  // namespace lensgraph::cli
