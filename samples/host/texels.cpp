// Decoding of texels. Vulkan numbers its plain formats in runs, by number of components and then by their type, which
// spares a table of a hundred lines.
#include "samples/host/texels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "engine/error.h"

namespace lensgraph::host {
namespace {

/// How one component is stored.
enum class Store : uint8_t {
  unorm8,
  snorm8,
  uint8,
  sint8,
  srgb8,
  unorm16,
  snorm16,
  uint16,
  sint16,
  half,
  uint32,
  sint32,
  float32,
  depth24,
  packed11,
  packed9
};

struct Layout {
  Store store;
  uint32_t components = 1;
  bool swapsRedAndBlue = false;
};

/// Types of the runs of 8- and 16-bit formats: unorm, snorm, uscaled, sscaled, uint, sint, srgb or sfloat.
constexpr Store kStores8[] = {Store::unorm8, Store::snorm8, Store::uint8, Store::sint8,
                              Store::uint8,  Store::sint8,  Store::srgb8};
constexpr Store kStores16[] = {Store::unorm16, Store::snorm16, Store::uint16, Store::sint16,
                               Store::uint16,  Store::sint16,  Store::half};
constexpr Store kStores32[] = {Store::uint32, Store::sint32, Store::float32};

[[noreturn]] void refuse(VkFormat format) {
  throw engine::Error(
      {.file = {},
       .field = "format",
       .reason = "Vulkan format " + std::to_string(static_cast<int>(format)) + " cannot be written as a picture",
       .remedy = {}});
}

Layout depthLayout(VkFormat format) {
  switch (format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_D16_UNORM_S8_UINT:
      return {Store::unorm16};
    case VK_FORMAT_X8_D24_UNORM_PACK32:
    case VK_FORMAT_D24_UNORM_S8_UINT:
      return {Store::depth24};
    default:
      return {Store::float32};
  }
}

Layout colorLayout(VkFormat format) {
  const auto in = [&](VkFormat first, VkFormat last) { return first <= format && format <= last; };
  const auto at = [&](VkFormat first) { return static_cast<uint32_t>(format - first); };
  constexpr uint32_t kComponents8[] = {1, 2, 3, 3, 4, 4, 4};  // R, RG, RGB, BGR, RGBA, BGRA, ABGR in one word
  if (in(VK_FORMAT_R8_UNORM, VK_FORMAT_A8B8G8R8_SRGB_PACK32)) {
    const uint32_t run = at(VK_FORMAT_R8_UNORM) / 7;
    return {kStores8[at(VK_FORMAT_R8_UNORM) % 7], kComponents8[run], run == 3 || run == 5};
  }
  if (in(VK_FORMAT_R16_UNORM, VK_FORMAT_R16G16B16A16_SFLOAT)) {
    return {kStores16[at(VK_FORMAT_R16_UNORM) % 7], at(VK_FORMAT_R16_UNORM) / 7 + 1};
  }
  if (in(VK_FORMAT_R32_UINT, VK_FORMAT_R32G32B32A32_SFLOAT)) {
    return {kStores32[at(VK_FORMAT_R32_UINT) % 3], at(VK_FORMAT_R32_UINT) / 3 + 1};
  }
  if (format == VK_FORMAT_B10G11R11_UFLOAT_PACK32) return {Store::packed11, 3};
  if (format == VK_FORMAT_E5B9G9R9_UFLOAT_PACK32) return {Store::packed9, 3};
  refuse(format);
}

/// Reads components one after the other.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  T take() {
    T value;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
    return value;
  }
  template <class T>
  float normalised() {
    const float value = static_cast<float>(take<T>()) / static_cast<float>(std::numeric_limits<T>::max());
    return std::is_signed_v<T> ? std::max(value, -1.0f) : value;
  }

 private:
  std::span<const std::byte> bytes_;
};

float linearOfSrgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float component(Reader& reader, Store store) {
  switch (store) {
    case Store::unorm8:
      return reader.normalised<uint8_t>();
    case Store::snorm8:
      return reader.normalised<int8_t>();
    case Store::uint8:
      return reader.take<uint8_t>();
    case Store::sint8:
      return reader.take<int8_t>();
    case Store::srgb8:
      return linearOfSrgb(reader.normalised<uint8_t>());
    case Store::unorm16:
      return reader.normalised<uint16_t>();
    case Store::snorm16:
      return reader.normalised<int16_t>();
    case Store::uint16:
      return reader.take<uint16_t>();
    case Store::sint16:
      return reader.take<int16_t>();
    case Store::half:
      return glm::unpackHalf1x16(reader.take<uint16_t>());
    case Store::uint32:
      return static_cast<float>(reader.take<uint32_t>());
    case Store::sint32:
      return static_cast<float>(reader.take<int32_t>());
    case Store::depth24:
      return static_cast<float>(reader.take<uint32_t>() & 0xffffffu) / 16777215.0f;
    default:
      return reader.take<float>();
  }
}

void readTexel(Reader& reader, const Layout& layout, float* texel) {
  if (layout.store == Store::packed11 || layout.store == Store::packed9) {
    const auto word = reader.take<uint32_t>();
    const glm::vec3 color = layout.store == Store::packed11 ? glm::unpackF2x11_1x10(word) : glm::unpackF3x9_E1x5(word);
    for (int i = 0; i < 3; ++i) texel[i] = color[i];
    return;
  }
  for (uint32_t i = 0; i < layout.components; ++i) {
    // sRGB formats encode their colours, not their alpha.
    const bool isAlpha = i == 3;
    texel[i] = component(reader, isAlpha && layout.store == Store::srgb8 ? Store::unorm8 : layout.store);
  }
  if (layout.swapsRedAndBlue) std::swap(texel[0], texel[2]);
}

}  // namespace

engine::FloatImage pictureOf(std::span<const std::byte> bytes, VkFormat format, VkImageAspectFlags aspect,
                             VkExtent2D extent) {
  const Layout layout = aspect == VK_IMAGE_ASPECT_STENCIL_BIT ? Layout{Store::uint8}
                        : aspect == VK_IMAGE_ASPECT_DEPTH_BIT ? depthLayout(format)
                                                              : colorLayout(format);
  engine::FloatImage picture(extent.width, extent.height, layout.components == 2 ? 3 : layout.components);
  Reader reader(bytes);
  for (uint32_t y = 0; y < extent.height; ++y) {
    for (uint32_t x = 0; x < extent.width; ++x) readTexel(reader, layout, picture.pixel(x, y));
  }
  return picture;
}

}  // namespace lensgraph::host
