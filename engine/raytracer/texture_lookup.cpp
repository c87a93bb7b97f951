// Bilinear and nearest lookups; sRGB is decoded texel by texel (IEC 61966-2-1).
#include "engine/raytracer/texture_lookup.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lensgraph::engine {
namespace {

std::array<float, 256> decodingTable(bool srgb) {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double v = static_cast<double>(i) / 255.0;
    table[i] = static_cast<float>(!srgb ? v : v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
  }
  return table;
}

const std::array<float, 256>& decoding(ColorEncoding encoding) {
  static const std::array<std::array<float, 256>, 2> tables = {decodingTable(false), decodingTable(true)};
  return tables[encoding == ColorEncoding::srgb ? 1 : 0];
}

int64_t wrapped(int64_t i, int64_t size, Wrap wrap) {
  if (i >= 0 && i < size) return i;  // Divisions would cost more than the rest of a lookup.
  switch (wrap) {
    case Wrap::clampToEdge:
      break;
    case Wrap::repeat:
      return (i % size + size) % size;
    case Wrap::mirroredRepeat: {
      const int64_t period = 2 * size, place = (i % period + period) % period;
      return place < size ? place : period - 1 - place;
    }
  }
  return std::clamp<int64_t>(i, 0, size - 1);
}

/// Texel coordinates beyond this have lost their fraction in float; the limit keeps them integers of 64 bits.
constexpr float kFarthestTexel = 1e15f;

float bounded(float texels) {
  return std::isfinite(texels) ? std::clamp(texels, -kFarthestTexel, kFarthestTexel) : 0.0f;
}

}  // namespace

TextureLookup::TextureLookup(const Scene& scene, const TextureUse& use) : uvSet_(use.uvSet) {
  origin_ = transformUv(use, {0.0f, 0.0f});
  u_ = transformUv(use, {1.0f, 0.0f}) - origin_;
  v_ = transformUv(use, {0.0f, 1.0f}) - origin_;
  if (!use.isUsed()) return;
  const Texture& texture = scene.textures[use.texture];
  image_ = &scene.images[texture.image];
  decoding_ = &decoding(image_->encoding);
  wrapS_ = texture.wrapS;
  wrapT_ = texture.wrapT;
  isNearest_ = texture.magFilter == Filter::nearest;
}

glm::vec2 TextureLookup::transformed(const std::array<glm::vec2, 2>& uvs) const {
  const glm::vec2& uv = uvs[uvSet_];
  return origin_ + u_ * uv.x + v_ * uv.y;
}

std::size_t TextureLookup::column(int64_t x) const {
  return static_cast<std::size_t>(wrapped(x, image_->width, wrapS_));
}

std::size_t TextureLookup::row(int64_t y) const {
  return static_cast<std::size_t>(wrapped(y, image_->height, wrapT_));
}

glm::vec4 TextureLookup::texel(std::size_t column, std::size_t row) const {
  const uint8_t* bytes = image_->rgba.data() + (row * image_->width + column) * 4;
  const auto& color = *decoding_;
  return {color[bytes[0]], color[bytes[1]], color[bytes[2]], static_cast<float>(bytes[3]) / 255.0f};
}

glm::vec4 TextureLookup::at(const std::array<glm::vec2, 2>& uvs) const {
  if (image_ == nullptr) return glm::vec4(1.0f);
  const glm::vec2 uv = transformed(uvs);
  const float x = bounded(uv.x * static_cast<float>(image_->width));
  const float y = bounded(uv.y * static_cast<float>(image_->height));
  if (isNearest_) {
    return texel(column(static_cast<int64_t>(std::floor(x))), row(static_cast<int64_t>(std::floor(y))));
  }
  const float left = std::floor(x - 0.5f), top = std::floor(y - 0.5f);
  const float across = x - 0.5f - left, down = y - 0.5f - top;
  const auto x0 = static_cast<int64_t>(left), y0 = static_cast<int64_t>(top);
  const std::size_t column0 = column(x0), column1 = column(x0 + 1), row0 = row(y0), row1 = row(y0 + 1);
  const glm::vec4 upper = texel(column0, row0) * (1.0f - across) + texel(column1, row0) * across;
  const glm::vec4 lower = texel(column0, row1) * (1.0f - across) + texel(column1, row1) * across;
  return upper * (1.0f - down) + lower * down;
}

}  // namespace lensgraph::engine
