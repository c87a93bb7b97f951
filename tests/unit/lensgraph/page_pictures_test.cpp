// Pictures as data URIs: size, values, and that they are the PNG files that the program writes.
#include "samples/lensgraph/pages/page_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/image/image_io.h"
#include "engine/image/srgb.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph {

namespace {

using engine::FloatImage;

/// What a data URI holds, as the 8-bit values of the PNG file.
FloatImage decoded(const std::string& uri) {
  const std::string kPrefix = "data:image/png;base64,";
  EXPECT_EQ(uri.substr(0, kPrefix.size()), kPrefix);
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::byte> bytes;
  uint32_t bits = 0, count = 0;
  for (const char c : uri.substr(kPrefix.size())) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<uint32_t>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> count & 255));
  }
  FloatImage image = engine::readImage(bytes, "uri.png", {}).image;
  for (float& sample : image.samples) sample = std::round(255.0f * engine::srgbFromLinear(sample));
  return image;
}

TEST(PagePictures, ShowThePictureAtItsExposureAsSrgb) {
  FloatImage picture(3, 1, 3, 0.25f);
  picture.samples[3] = 7.0f;
  picture.samples[4] = -1.0f;
  picture.samples[5] = std::numeric_limits<float>::quiet_NaN();
  // 188: sRGB of half of full light, to which one stop more than a quarter comes.
  EXPECT_THAT(decoded(cli::pictureUri(picture, 1.0)).samples,
              testing::ElementsAre(188, 188, 188, 255, 0, 0, 188, 188, 188));
}

TEST(PagePictures, AreScaledDownByTheLightThatTheyShow) {
  FloatImage picture(4, 2, 3);
  for (uint32_t y = 0; y < 2; ++y) {
    for (uint32_t x = 0; x < 4; ++x) {
      // The left column is far above white, and displayed as white.
      for (uint32_t c = 0; c < 3; ++c) picture.pixel(x, y)[c] = x == 0 ? 100.0f : 0.0f;
    }
  }
  const FloatImage small = decoded(cli::pictureUri(picture, 0.0, 2));
  EXPECT_EQ(small.width, 2u);
  EXPECT_EQ(small.height, 1u);
  EXPECT_THAT(small.samples, testing::ElementsAre(188, 188, 188, 0, 0, 0));
}

TEST(PagePictures, WeighPixelsByTheAreaThatTheyCover) {
  FloatImage map(3, 1, 1);
  map.samples = {0.2f, 0.8f, 0.4f};
  // Two pixels of one and a half each: (0.2 + 0.5 * 0.8) / 1.5 and (0.5 * 0.8 + 0.4) / 1.5, times 255.
  EXPECT_THAT(decoded(cli::mapUri(map, 2)).samples, testing::ElementsAre(102, 136));
}

TEST(PagePictures, OfAnySizeFitTheLongestSide) {
  for (const auto& [width, height] : {std::pair{961u, 3u}, {7u, 1000u}, {960u, 960u}, {1u, 1u}}) {
    const FloatImage image = decoded(cli::pictureUri(FloatImage(width, height, 1, 1.0f), 0.0));
    EXPECT_LE(std::max(image.width, image.height), cli::kLongestSideInPages);
    EXPECT_GE(std::min(image.width, image.height), 1u);
    EXPECT_THAT(image.samples, testing::Each(255));
  }
}

TEST(PagePictures, OfMapsKeepTheirValues) {
  FloatImage map(4, 1, 1);
  map.samples = {0.0f, 0.2f, 1.0f, 3.0f};
  const FloatImage image = decoded(cli::mapUri(map));
  EXPECT_EQ(image.channels, 1u);
  EXPECT_THAT(image.samples, testing::ElementsAre(0, 51, 255, 255));
}

TEST(PagePictures, AreThePngFilesThatAreWritten) {
  const test::TemporaryFolder folder;
  FloatImage picture(5, 4, 4, 0.5f);
  picture.samples[2] = 0.1f;
  engine::writeImage(folder / "a.png", picture, {.exposureEv = 0.5});
  EXPECT_EQ(engine::encodePng(picture, 0.5), test::readBytes(folder / "a.png"));
  EXPECT_ANY_THROW(engine::encodePng(FloatImage()));
  EXPECT_ANY_THROW(engine::encodePng(FloatImage(2, 2, 2)));
}

}  // namespace

}  // namespace lensgraph
