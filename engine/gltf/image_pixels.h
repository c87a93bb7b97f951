// Pixels of PNG and JPEG files. The only user of stb_image. Private to engine/gltf.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/gltf/image_size.h"

namespace lensgraph::engine::gltf {

/// RGBA8, top row first, 16 bits rounded to 8; empty when the file is damaged or of another size than its header says.
/// Precondition: `bytes` are at most INT_MAX, `size` is that of imageSize().
std::vector<uint8_t> decodeRgba(std::span<const uint8_t> bytes, const ImageSize& size);

}  // namespace lensgraph::engine::gltf
