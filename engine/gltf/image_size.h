// The size of a picture, from its first bytes alone. Private to engine/gltf.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace lensgraph::engine::gltf {

struct ImageSize {
  uint32_t width = 0, height = 0;  ///< px
};

bool isPng(std::span<const uint8_t> bytes);
bool isJpeg(std::span<const uint8_t> bytes);

/// Of a PNG or JPEG file; none when it is damaged before the size stands there.
std::optional<ImageSize> imageSize(std::span<const uint8_t> bytes);

}  // namespace lensgraph::engine::gltf
