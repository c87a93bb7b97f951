// Texels of each kind of format, decoded.
#include "samples/host/texels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "engine/error.h"

namespace lensgraph {

namespace {

using testing::ElementsAre;
using testing::FloatNear;

template <class T>
std::vector<float> decoded(VkFormat format, const std::vector<T>& words,
                           VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT) {
  return host::pictureOf(std::as_bytes(std::span(words)), format, aspect, {1, 1}).samples;
}

TEST(Texels, EveryKindOfComponentIsDecoded) {
  EXPECT_THAT(decoded<float>(VK_FORMAT_R32G32B32A32_SFLOAT, {1.5f, -2.0f, 0.0f, 1.0f}),
              ElementsAre(1.5f, -2.0f, 0.0f, 1.0f));
  EXPECT_THAT(decoded<float>(VK_FORMAT_R32_SFLOAT, {0.25f}), ElementsAre(0.25f));
  EXPECT_THAT(decoded<float>(VK_FORMAT_R32G32_SFLOAT, {0.25f, 3.0f}), ElementsAre(0.25f, 3.0f, 0.0f))
      << "files have no two channels";
  EXPECT_THAT(decoded<uint32_t>(VK_FORMAT_R32_UINT, {70000}), ElementsAre(70000.0f));
  EXPECT_THAT(decoded<int32_t>(VK_FORMAT_R32_SINT, {-3}), ElementsAre(-3.0f));
  EXPECT_THAT(decoded<uint16_t>(VK_FORMAT_R16G16B16A16_SFLOAT, {0x3c00, 0xc000, 0x0000, 0x3800}),
              ElementsAre(1.0f, -2.0f, 0.0f, 0.5f));
  EXPECT_THAT(decoded<uint16_t>(VK_FORMAT_R16_UNORM, {65535}), ElementsAre(1.0f));
  EXPECT_THAT(decoded<int16_t>(VK_FORMAT_R16_SNORM, {-32768}), ElementsAre(-1.0f));
  EXPECT_THAT(decoded<uint8_t>(VK_FORMAT_R8G8B8A8_UNORM, {255, 0, 51, 255}), ElementsAre(1.0f, 0.0f, 0.2f, 1.0f));
  EXPECT_THAT(decoded<uint8_t>(VK_FORMAT_B8G8R8A8_UNORM, {255, 0, 51, 0}), ElementsAre(0.2f, 0.0f, 1.0f, 0.0f));
  EXPECT_THAT(decoded<uint8_t>(VK_FORMAT_R8G8B8A8_SRGB, {255, 0, 188, 51}),
              ElementsAre(1.0f, 0.0f, FloatNear(0.5029f, 1e-4f), 0.2f))
      << "alpha is not encoded";
  EXPECT_THAT(decoded<uint8_t>(VK_FORMAT_R8_UINT, {200}), ElementsAre(200.0f));
  EXPECT_THAT(decoded<uint32_t>(VK_FORMAT_B10G11R11_UFLOAT_PACK32, {0x3c0u | (0x380u << 11) | (0x200u << 22)}),
              ElementsAre(1.0f, 0.5f, 2.0f));
}

TEST(Texels, DepthAndStencilAreDecoded) {
  EXPECT_THAT(decoded<float>(VK_FORMAT_D32_SFLOAT, {0.75f}, VK_IMAGE_ASPECT_DEPTH_BIT), ElementsAre(0.75f));
  EXPECT_THAT(decoded<float>(VK_FORMAT_D32_SFLOAT_S8_UINT, {0.75f}, VK_IMAGE_ASPECT_DEPTH_BIT), ElementsAre(0.75f));
  EXPECT_THAT(decoded<uint16_t>(VK_FORMAT_D16_UNORM, {65535}, VK_IMAGE_ASPECT_DEPTH_BIT), ElementsAre(1.0f));
  EXPECT_THAT(decoded<uint32_t>(VK_FORMAT_D24_UNORM_S8_UINT, {0xff000000u}, VK_IMAGE_ASPECT_DEPTH_BIT),
              ElementsAre(0.0f))
      << "the upper bits are none of depth";
  EXPECT_THAT(decoded<uint8_t>(VK_FORMAT_S8_UINT, {7}, VK_IMAGE_ASPECT_STENCIL_BIT), ElementsAre(7.0f));
}

TEST(Texels, FormatsThatAreNoPictureAreRefused) {
  EXPECT_THROW(decoded<uint64_t>(VK_FORMAT_BC1_RGB_UNORM_BLOCK, {0}), engine::Error);
  EXPECT_THROW(decoded<double>(VK_FORMAT_R64_SFLOAT, {0.0}), engine::Error);
}

}  // namespace

}  // namespace lensgraph
