// Headers of PNG (IHDR) and JPEG (start of frame).
#include "engine/gltf/image_size.h"

#include <algorithm>
#include <initializer_list>

namespace lensgraph::engine::gltf {
namespace {

bool startsWith(std::span<const uint8_t> bytes, std::initializer_list<uint8_t> magic) {
  return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

uint32_t bigEndian(std::span<const uint8_t> bytes) {
  uint32_t value = 0;
  for (uint8_t byte : bytes) value = value << 8 | byte;
  return value;
}

// The first chunk is IHDR; its data begin with width and height.
std::optional<ImageSize> pngSize(std::span<const uint8_t> bytes) {
  if (bytes.size() < 24 || !startsWith(bytes.subspan(12), {'I', 'H', 'D', 'R'})) return std::nullopt;
  return ImageSize{.width = bigEndian(bytes.subspan(16, 4)), .height = bigEndian(bytes.subspan(20, 4))};
}

// Segments are a marker, a length that counts itself, and data; those that start a frame are SOF0…SOF15 without the
// tables DHT, JPG and DAC.
std::optional<ImageSize> jpegSize(std::span<const uint8_t> bytes) {
  bytes = bytes.subspan(2);
  while (bytes.size() >= 9) {
    if (bytes[0] != 0xFF) return std::nullopt;
    const uint8_t marker = bytes[1];
    if (marker == 0xFF) {  // padding
      bytes = bytes.subspan(1);
      continue;
    }
    const bool isFrame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (isFrame) return ImageSize{.width = bigEndian(bytes.subspan(7, 2)), .height = bigEndian(bytes.subspan(5, 2))};
    const size_t length = 2 + bigEndian(bytes.subspan(2, 2));
    if (length > bytes.size()) return std::nullopt;
    bytes = bytes.subspan(length);
  }
  return std::nullopt;
}

}  // namespace

bool isPng(std::span<const uint8_t> bytes) {
  return startsWith(bytes, {0x89, 'P', 'N', 'G'});
}

bool isJpeg(std::span<const uint8_t> bytes) {
  return startsWith(bytes, {0xFF, 0xD8, 0xFF});
}

std::optional<ImageSize> imageSize(std::span<const uint8_t> bytes) {
  return isPng(bytes) ? pngSize(bytes) : isJpeg(bytes) ? jpegSize(bytes) : std::nullopt;
}

}  // namespace lensgraph::engine::gltf
