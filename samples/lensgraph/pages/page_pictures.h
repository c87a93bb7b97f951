// Pictures inside of a page: scaled to a size that a page can carry, encoded as PNG, as data URIs.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "engine/image/image.h"

namespace lensgraph::cli {

/// Longest side of pictures in pages, px. Larger ones are scaled down: a page with thirty pictures of 960×540 px has
/// about 30 MB.
inline constexpr uint32_t kLongestSideInPages = 960;

/// Makes the map of FLIP errors of a picture: one channel, 0…1, the size of the picture. The exposure is in stops.
using FlipMapMaker = std::function<engine::FloatImage(const engine::FloatImage& picture,
                                                      const engine::FloatImage& reference, double exposureEv)>;

/// "data:image/png;base64,…" of the displayed picture: exposure, clamp to [0,1], sRGB; alpha is dropped. A picture whose
/// longer side is above `longestSide` (px) is scaled down by averaging its displayed light.
/// Precondition: the picture has pixels, and 1, 3 or 4 channels.
std::string pictureUri(const engine::FloatImage& picture, double exposureEv,
                       uint32_t longestSide = kLongestSideInPages);

/// The same for one channel of values 0…1 that are no light (error maps, masks): grey v is stored as round(255 v).
std::string mapUri(const engine::FloatImage& map, uint32_t longestSide = kLongestSideInPages);

}  // namespace lensgraph::cli
