// Image files: what is written is what is read, what is read is linear, and failures leave nothing behind.
#include "engine/image/image_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "engine/image/srgb.h"
#include "engine/metrics/displayed.h"
#include "image/image_test.h"
#include "raw_png.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph {

namespace {

using engine::FloatImage;
using engine::readDepth;
using engine::readImage;
using engine::writeImage;
using test::errorOf;
using test::PngColor;
using test::rawPng;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

FloatImage awkwardImage(uint32_t channels) {
  FloatImage image(5, 3, channels);
  const float values[] = {0.18f, -2.5f, kNan, kInfinity, -kInfinity, 0.0f, 1e-40f, 3e38f, 65504.0f, 0.3333333f, -0.0f};
  for (size_t i = 0; i < image.samples.size(); ++i) image.samples[i] = values[i % std::size(values)];
  return image;
}

void expectSameBits(const FloatImage& a, const FloatImage& b) {
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  ASSERT_EQ(a.channels, b.channels);
  for (size_t i = 0; i < a.samples.size(); ++i) {
    if (std::isnan(a.samples[i])) {
      EXPECT_TRUE(std::isnan(b.samples[i])) << i;
    } else {
      EXPECT_EQ(std::memcmp(&a.samples[i], &b.samples[i], 4), 0) << i << ": " << a.samples[i] << " " << b.samples[i];
    }
  }
}

class ExrChannels : public testing::TestWithParam<uint32_t> {};

TEST_P(ExrChannels, FloatKeepsEveryBit) {
  const TemporaryFolder folder;
  const FloatImage image = awkwardImage(GetParam());
  writeImage(folder / "a.exr", image);
  expectSameBits(image, readImage(folder / "a.exr"));
  EXPECT_THAT(folder.names(), ElementsAre("a.exr"));
}

INSTANTIATE_TEST_SUITE_P(OneThreeFour, ExrChannels, testing::Values(1u, 3u, 4u));

TEST(ImageIo, HalfExrRoundsToHalf) {
  const TemporaryFolder folder;
  FloatImage image(3, 2, 1);
  image.samples = {1.0f / 3.0f, -2.5f, 65504.0f, 1e6f, kNan, -kInfinity};
  writeImage(folder / "a.exr", image, {.exrSampleType = engine::ExrSampleType::half16});
  const FloatImage read = readImage(folder / "a.exr");
  EXPECT_FLOAT_EQ(read.samples[0], 0.333251953125f);
  EXPECT_EQ(read.samples[1], -2.5f);
  EXPECT_EQ(read.samples[2], 65504.0f);
  EXPECT_EQ(read.samples[3], kInfinity);
  EXPECT_TRUE(std::isnan(read.samples[4]));
  EXPECT_EQ(read.samples[5], -kInfinity);
}

TEST(ImageIo, DepthIsTheChannelZ) {
  const TemporaryFolder folder;
  FloatImage depth(2, 1, 1);
  depth.samples = {2.5f, 1e10f};
  writeImage(folder / "z.exr", depth);
  expectSameBits(depth, readDepth(folder / "z.exr"));
}

// ---- PNG

TEST(ImageIo, PngIsEncodedAfterExposureAndClamped) {
  const TemporaryFolder folder;
  FloatImage image(2, 2, 3);
  image.samples = {0.09f, 0.0f, 2.0f, -1.0f, kNan, kInfinity, 0.5f, 0.25f, 0.001f, 1e-9f, 0.107f, 0.4f};
  writeImage(folder / "a.png", image, {.exposureEv = 1.0});
  const FloatImage shown = engine::displayed(image, 1.0);
  const FloatImage read = readImage(folder / "a.png");
  ASSERT_EQ(read.channels, 3u);
  for (size_t i = 0; i < shown.samples.size(); ++i) {
    EXPECT_NEAR(engine::srgbFromLinear(read.samples[i]), shown.samples[i], 0.5 / 255.0 + 1e-6) << i;
  }
}

TEST(ImageIo, PngColourIsDecodedAndAlphaIsNot) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "a.png", rawPng(1, 1, 8, PngColor::rgba, {188, 255, 0, 51}));
  const FloatImage read = readImage(folder / "a.png");
  ASSERT_EQ(read.channels, 4u);
  EXPECT_NEAR(read.samples[0], 0.2 * 0.502886, 1e-5);  // linear 0.502886, premultiplied in linear light
  EXPECT_NEAR(read.samples[1], 0.2, 1e-6);
  EXPECT_EQ(read.samples[2], 0.0f);
  EXPECT_NEAR(read.samples[3], 0.2, 1e-6);
}

TEST(ImageIo, Png16BitKeepsItsPrecision) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "a.png", rawPng(2, 1, 16, PngColor::rgb, {32768, 32769, 65535, 1, 0, 257}));
  const FloatImage read = readImage(folder / "a.png");
  EXPECT_NEAR(read.samples[0], 0.21404, 1e-4);
  EXPECT_GT(read.samples[1], read.samples[0]);
  EXPECT_EQ(read.samples[2], 1.0f);
  EXPECT_NEAR(read.samples[3], 1.0 / 65535.0 / 12.92, 1e-9);
}

TEST(ImageIo, GreyPngsKeepTheirMeaning) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "grey.png", rawPng(1, 1, 8, PngColor::grey, {188}));
  EXPECT_EQ(readImage(folder / "grey.png").channels, 1u);
  test::writeBytes(folder / "alpha.png", rawPng(1, 1, 8, PngColor::greyAlpha, {255, 51}));
  const FloatImage read = readImage(folder / "alpha.png");
  ASSERT_EQ(read.channels, 4u);
  for (float sample : read.samples) EXPECT_NEAR(sample, 0.2f, 1e-6);
}

TEST(ImageIo, PngAlphaIsWrittenStraight) {
  const TemporaryFolder folder;
  FloatImage image(1, 1, 4);
  image.samples = {0.5f, 0.25f, 0.0f, 0.5f};
  writeImage(folder / "a.png", image);
  const FloatImage read = readImage(folder / "a.png");
  EXPECT_NEAR(read.samples[0], 128 / 255.0, 1e-6);  // straight colour 1
  EXPECT_NEAR(read.samples[1], 0.25, 0.005);
  EXPECT_NEAR(read.samples[3], 128 / 255.0, 1e-6);
}

// ---- HDR

TEST(ImageIo, HdrKeepsRadianceWithinItsPrecision) {
  const TemporaryFolder folder;
  FloatImage image(40, 2, 3);
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    for (size_t c = 0; c < 3; ++c)
      image.samples[3 * i + c] = std::exp2(static_cast<float>(i) / 4.0f - 5.0f) * (1.0f - 0.3f * c);
  }
  writeImage(folder / "a.hdr", image);
  const FloatImage read = readImage(folder / "a.hdr");
  ASSERT_EQ(read.samples.size(), image.samples.size());
  for (size_t i = 0; i < image.samples.size(); ++i) {
    const float largest = image.samples[i / 3 * 3];
    EXPECT_NEAR(read.samples[i], image.samples[i], largest / 120.0f) << i;  // 8 bits of mantissa, shared exponent
  }
}

TEST(ImageIo, HdrRepeatsGreyAndDropsAlpha) {
  const TemporaryFolder folder;
  writeImage(folder / "grey.hdr", FloatImage(9, 2, 1, 0.5f));
  EXPECT_THAT(readImage(folder / "grey.hdr").samples, testing::Each(testing::FloatNear(0.5f, 0.003f)));
  writeImage(folder / "rgba.hdr", FloatImage(9, 2, 4, 0.5f));
  EXPECT_EQ(readImage(folder / "rgba.hdr").channels, 3u);
}

TEST(ImageIo, ExtensionsMayBeUpperCase) {
  const TemporaryFolder folder;
  writeImage(folder / "a.EXR", FloatImage(1, 1, 3, 0.5f));
  EXPECT_EQ(readImage(folder / "a.EXR").width, 1u);
}

// ---- Failures

class EveryFormat : public testing::TestWithParam<const char*> {};

TEST_P(EveryFormat, MissingFile) {
  const TemporaryFolder folder;
  EXPECT_THAT(errorOf([&] { readImage(folder / (std::string("none") + GetParam())); }), HasSubstr("no such file"));
}

TEST_P(EveryFormat, EmptyFile) {
  const TemporaryFolder folder;
  const auto path = folder / (std::string("empty") + GetParam());
  test::writeBytes(path, {});
  EXPECT_EQ(errorOf([&] { readImage(path); }), path.string() + ": is empty (0 bytes)");
}

TEST_P(EveryFormat, TruncatedAtEveryLength) {
  const TemporaryFolder folder;
  const auto path = folder / (std::string("whole") + GetParam());
  FloatImage image(31, 17, 3);
  for (size_t i = 0; i < image.samples.size(); ++i) image.samples[i] = static_cast<float>(i * 7919 % 1000) / 1000.0f;
  writeImage(path, image);
  const std::vector<uint8_t> bytes = test::readBytes(path);
  const auto cut = folder / (std::string("cut") + GetParam());
  // Half and less can never be a picture; the last bytes of a file may be padding or checksums.
  for (size_t length = 1; length < bytes.size() / 2; length += 1 + bytes.size() / 60) {
    test::writeBytes(cut, std::span(bytes).first(length));
    EXPECT_THAT(errorOf([&] { readImage(cut); }), testing::StartsWith(cut.string() + ": ")) << length;
  }
}

TEST_P(EveryFormat, NotAnImage) {
  const TemporaryFolder folder;
  const auto path = folder / (std::string("text") + GetParam());
  const std::string text =
      "this is a text, whatever its name says; it goes on for a while to be longer than any header";
  test::writeBytes(path, std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
  EXPECT_THAT(errorOf([&] { readImage(path); }), testing::StartsWith(path.string() + ": "));
}

TEST_P(EveryFormat, FolderThatDoesNotExist) {
  const TemporaryFolder folder;
  const auto path = folder / "none" / (std::string("a") + GetParam());
  EXPECT_THAT(errorOf([&] { writeImage(path, FloatImage(2, 2, 3)); }), HasSubstr("cannot be written"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST_P(EveryFormat, FolderInPlaceOfTheFile) {
  const TemporaryFolder folder;
  const auto path = folder / (std::string("a") + GetParam());
  std::filesystem::create_directory(path);
  EXPECT_THAT(errorOf([&] { writeImage(path, FloatImage(2, 2, 3)); }), HasSubstr("is a folder"));
  EXPECT_THAT(errorOf([&] { readImage(path); }), HasSubstr("is a folder"));
  EXPECT_THAT(folder.names(), ElementsAre(path.filename().string()));
}

TEST_P(EveryFormat, FileInPlaceOfTheFolder) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "file", std::vector<uint8_t>{1});
  const auto path = folder / "file" / (std::string("a") + GetParam());
  EXPECT_THAT(errorOf([&] { writeImage(path, FloatImage(2, 2, 3)); }), HasSubstr("cannot be written"));
  EXPECT_THAT(folder.names(), ElementsAre("file"));
}

INSTANTIATE_TEST_SUITE_P(All, EveryFormat, testing::Values(".exr", ".png", ".hdr"));

TEST(ImageIo, UnknownExtensionNamesTheKnownOnes) {
  const TemporaryFolder folder;
  EXPECT_THAT(errorOf([&] { writeImage(folder / "a.tga", FloatImage(1, 1, 3)); }),
              HasSubstr("'.tga'; use .exr, .png or .hdr"));
  EXPECT_THAT(errorOf([&] { readImage(folder / "a"); }), HasSubstr("no extension"));
}

TEST(ImageIo, RefusesPicturesThatNoFormatHolds) {
  const TemporaryFolder folder;
  EXPECT_THAT(errorOf([&] { writeImage(folder / "a.exr", FloatImage{}); }), HasSubstr("no pixels"));
  EXPECT_THAT(errorOf([&] { writeImage(folder / "a.exr", FloatImage(2, 2, 2)); }), HasSubstr("2 channels"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(ImageIo, AFailedWriteKeepsTheOldFile) {
  const TemporaryFolder folder;
  writeImage(folder / "a.exr", FloatImage(1, 1, 1, 4.0f));
  errorOf([&] { writeImage(folder / "a.exr", FloatImage(1, 1, 2)); });
  EXPECT_THAT(readImage(folder / "a.exr").samples, ElementsAre(4.0f));
}

}  // namespace

}  // namespace lensgraph
