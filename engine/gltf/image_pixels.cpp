// Decodes with stb_image, compiled here, so that none of its symbols leaves this file, with the two formats alone.
#include "engine/gltf/image_pixels.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#include <stb/stb_image.h>

#include <memory>

namespace lensgraph::engine::gltf {
namespace {

struct Free {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

}  // namespace

std::vector<uint8_t> decodeRgba(std::span<const uint8_t> bytes, const ImageSize& size) {
  const int length = static_cast<int>(bytes.size());
  const size_t count = size_t{4} * size.width * size.height;
  int width = 0, height = 0, channels = 0;
  const auto isExpected = [&](const auto& pixels) {
    return pixels && static_cast<uint32_t>(width) == size.width && static_cast<uint32_t>(height) == size.height;
  };
  if (stbi_is_16_bit_from_memory(bytes.data(), length) == 0) {
    const std::unique_ptr<stbi_uc, Free> pixels(
        stbi_load_from_memory(bytes.data(), length, &width, &height, &channels, 4));
    if (!isExpected(pixels)) return {};
    return {pixels.get(), pixels.get() + count};
  }
  const std::unique_ptr<stbi_us, Free> pixels(
      stbi_load_16_from_memory(bytes.data(), length, &width, &height, &channels, 4));
  if (!isExpected(pixels)) return {};
  std::vector<uint8_t> rgba(count);
  for (size_t i = 0; i < count; ++i) rgba[i] = static_cast<uint8_t>((uint32_t{pixels.get()[i]} * 255 + 32767) / 65535);
  return rgba;
}

}  // namespace lensgraph::engine::gltf
