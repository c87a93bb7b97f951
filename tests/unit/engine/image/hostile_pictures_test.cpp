// Pictures that claim more than they hold, carry metadata that crash libraries, or are no files: refused or read, soon, and
// without memory for what is not there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>

#include "engine/image/image_io.h"
#include "image/image_test.h"
#include "raw_exr.h"
#include "raw_png.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph {

namespace {

using engine::FloatImage;
using test::errorOf;
using test::ExrAttribute;
using test::ExrPartData;
using test::ExrWriter;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Bytes = std::vector<uint8_t>;

FloatImage read(const Bytes& bytes, const std::string& name) {
  return engine::readImage(std::as_bytes(std::span(bytes)), name, {}).image;
}
std::string errorOfReading(const Bytes& bytes, const std::string& name) {
  return errorOf([&] { read(bytes, name); });
}
Bytes bytesOf(const std::string& text) {
  return {text.begin(), text.end()};
}

/// Runs a test under limits that an honest reader of small files never meets.
class Hostile : public testing::Test {
 protected:
  Hostile() {
    getrlimit(RLIMIT_DATA, &before_);
    rlimit limited = before_;
    limited.rlim_cur = std::min<rlim_t>(rlim_t{2} << 30, before_.rlim_max);
    if (!kHasSanitizer) setrlimit(RLIMIT_DATA, &limited);
  }
  ~Hostile() override {
    setrlimit(RLIMIT_DATA, &before_);
    EXPECT_LT(std::chrono::steady_clock::now() - start_, std::chrono::seconds(60));
  }

 private:
#ifdef __SANITIZE_ADDRESS__
  static constexpr bool kHasSanitizer = true;
#else
  static constexpr bool kHasSanitizer = false;
#endif
  rlimit before_{};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// ---- No files

// Every compression and layout once, attributes that mean nothing here, tiles larger than the picture.
TEST_F(Hostile, WhatFuzzingStartsFromIsRead) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(LENSGRAPH_SOURCE_DIR) + "/tests/fuzz/seeds")) {
    const std::string extension = entry.path().extension();
    if (extension != ".exr" && extension != ".png" && extension != ".hdr") continue;
    SCOPED_TRACE(entry.path().filename());
    const bool isDepth = entry.path().filename().string().starts_with("z_");
    EXPECT_NO_THROW(isDepth ? engine::readDepth(entry.path()) : engine::readImage(entry.path()));
    ++count;
  }
  EXPECT_GE(count, 15);
}

TEST_F(Hostile, PipesAndDevicesAreNotOpened) {
  const test::TemporaryFolder folder;
  for (const std::string name : {"pipe.exr", "pipe.png", "pipe.hdr"}) {
    ASSERT_EQ(mkfifo((folder / name).c_str(), 0600), 0);
    EXPECT_THAT(errorOf([&] { engine::readImage(folder / name); }), HasSubstr("is not a file"));
    EXPECT_THAT(errorOf([&] { engine::readDepth(folder / name); }), HasSubstr("is not a file"));
  }
  for (const std::string name : {"zero.exr", "zero.png", "zero.hdr"}) {
    std::filesystem::create_symlink("/dev/zero", folder / name);
    EXPECT_THAT(errorOf([&] { engine::readImage(folder / name); }), HasSubstr("is not a file"));
  }
}

// ---- EXR

ExrPartData grey(int32_t width, int32_t height) {
  return {.name = "part",
          .channels = {{"R", {1}}, {"G", {1}}, {"B", {1}}},
          .width = width,
          .height = height,
          .attributes = {}};
}
/// A header whose windows claim that size, before the data of two pixels.
Bytes exrThatClaims(int32_t width, int32_t height, std::vector<ExrAttribute> more = {}, uint32_t flags = 0) {
  ExrPartData part = grey(2, 2);
  part.attributes = std::move(more);
  const std::string window = ExrWriter::box(0, 0, width, height);
  part.attributes.push_back({"dataWindow", "box2i", window});
  part.attributes.push_back({"displayWindow", "box2i", window});
  return ExrWriter::file({part}, flags);
}

TEST_F(Hostile, ExrLargerThanTheLimitsSaysSo) {
  EXPECT_THAT(errorOfReading(exrThatClaims(30000, 30000), "a.exr"),
              AllOf(HasSubstr("is 30000x30000 px, larger than"), Not(HasSubstr("damaged"))));
  EXPECT_THAT(errorOfReading(exrThatClaims(100000, 2), "a.exr"), HasSubstr("65536 px a side"));
  EXPECT_THAT(errorOfReading(exrThatClaims(-5, 2), "a.exr"), HasSubstr("has no pixels"));
  EXPECT_THAT(errorOfReading(exrThatClaims(INT32_MAX, INT32_MAX), "a.exr"), HasSubstr("larger than"));
}

TEST_F(Hostile, ExrOfFewBytesCannotClaimManyPixels) {
  for (char compression = 0; compression < 10; ++compression) {
    SCOPED_TRACE(static_cast<int>(compression));
    EXPECT_THAT(errorOfReading(exrThatClaims(16000, 16000, {{"compression", "compression", {compression}}}), "a.exr"),
                HasSubstr("cannot hold the 16000x16000 pixels"));
  }
  EXPECT_THAT(errorOfReading(exrThatClaims(2, 60000), "a.exr"), HasSubstr("cannot hold"));
  EXPECT_THAT(errorOfReading(exrThatClaims(2, 2, {{"compression", "compression", "\x20"}}), "a.exr"),
              HasSubstr("compression is unknown"));
}

TEST_F(Hostile, ExrPiecesAreBounded) {
  ExrPartData wide = grey(2, 2);
  for (int i = 0; i < 100; ++i) wide.channels.push_back({"more" + std::to_string(i), {1}});
  const std::string window = ExrWriter::box(0, 0, 60000, 256);
  wide.attributes = {
      {"dataWindow", "box2i", window}, {"displayWindow", "box2i", window}, {"compression", "compression", "\x09"}};
  EXPECT_THAT(errorOfReading(ExrWriter::file({wide}), "a.exr"), HasSubstr("103 channels in pieces of 15360000 pixels"));
}

TEST_F(Hostile, ExrTilesAreBounded) {
  const auto tiled = [](uint32_t width, uint32_t height, char mode) {
    return ExrAttribute{"tiles", "tiledesc", ExrWriter::word(width) + ExrWriter::word(height) + mode};
  };
  for (const uint32_t side : {0u, 100000u, 0xffffffffu}) {
    EXPECT_THAT(errorOfReading(exrThatClaims(2, 2, {tiled(side, 16, 0)}, 0x200), "a.exr"), HasSubstr("its tiles are"));
    EXPECT_THAT(errorOfReading(exrThatClaims(2, 2, {tiled(16, side, 0)}, 0x200), "a.exr"), HasSubstr("its tiles are"));
  }
  for (const char mode : {0, 1, 2, 0x11, 0x12}) {
    EXPECT_THAT(errorOfReading(exrThatClaims(4000, 4000, {tiled(1, 1, mode)}, 0x200), "a.exr"),
                HasSubstr("cannot hold"));
  }
  EXPECT_THAT(errorOfReading(exrThatClaims(4, 4, {tiled(1, 1, 7)}, 0x200), "a.exr"), HasSubstr("unknown mode"));
  EXPECT_THAT(errorOfReading(exrThatClaims(4, 4, {}, 0x200), "a.exr"), HasSubstr("'tiles' is missing"));
}

// What OpenImageIO makes of them: a division by 0, a walk through untrusted text, a count of samples to allocate.
TEST_F(Hostile, ExrMetadataAreNotInterpreted) {
  const std::string zero = ExrWriter::word(0), huge = ExrWriter::word(0x7fffffff);
  const std::vector<ExrAttribute> all = {{"RowsPerStrip", "int", zero},
                                         {"ImageDescription", "string", std::string(100000, '<')},
                                         {"XResolution", "rational", zero + zero},
                                         {"FramesPerSecond", "rational", huge + zero},
                                         {"timeCode", "timecode", huge + huge},
                                         {"keyCode", "keycode", std::string(28, '\xff')},
                                         {"preview", "preview", huge + huge},
                                         {"chromaticities", "chromaticities", std::string(32, '\xff')},
                                         {"multiView", "stringvector", huge + "x"},
                                         {"envmap", "envmap", "\x7f"},
                                         {"wrapmodes", "string", std::string(3, '\0')},
                                         {"xmp", "string", "<rdf:li><rdf:li>"},
                                         {"ICCProfile", "bytes", std::string(10, '\1')},
                                         {"worldToCamera", "m44f", "short"},
                                         {"nobodyKnows", "thisType", "value"},
                                         {"pixelAspectRatio", "float", zero},
                                         {"screenWindowWidth", "float", ExrWriter::number(-1.0f)},
                                         {"screenWindowCenter", "v2f", std::string(8, '\xff')}};
  ExrPartData every = grey(2, 2);
  for (const auto& attribute : all) {
    SCOPED_TRACE(attribute.name);
    ExrPartData one = grey(2, 2);
    one.attributes = {attribute};
    EXPECT_EQ(read(ExrWriter::file({one}), "a.exr").samples.size(), 12u);
    every.attributes.push_back(attribute);
  }
  ExrPartData other = every;
  other.name = "other";
  other.channels = {{"Z", {1}}};
  EXPECT_EQ(read(ExrWriter::file({every, other}), "a.exr").samples.size(), 12u);
}

TEST_F(Hostile, ExrHeadersThatContradictThemselvesAreRefused) {
  ExrPartData twice = grey(2, 2);
  twice.attributes = {{"lineOrder", "int", ExrWriter::word(0)}};
  EXPECT_THAT(errorOfReading(ExrWriter::file({twice}), "a.exr"), HasSubstr("'lineOrder'"));
  for (const std::string name : {"channels", "compression", "dataWindow", "displayWindow", "lineOrder"}) {
    ExrPartData without = grey(2, 2);
    without.attributes = {{name, "nothing", ""}};
    EXPECT_THAT(errorOfReading(ExrWriter::file({without}), "a.exr"), HasSubstr(name));
  }
  ExrPartData none = grey(2, 2);
  none.channels.clear();
  EXPECT_THAT(errorOfReading(ExrWriter::file({none}), "a.exr"), HasSubstr("has no channels"));
}

TEST_F(Hostile, ExrCutAnywhereIsRefusedInOneLine) {
  const auto bytes = ExrWriter::file({grey(5, 4), grey(3, 2)});
  for (size_t length = 1; length < bytes.size(); length += 3) {
    EXPECT_THAT(errorOfReading(Bytes(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(length)), "a.exr"),
                StartsWith("a.exr: "))
        << length;
  }
}

TEST_F(Hostile, OfManyChannelsOnlyThoseWantedAreRead) {
  ExrPartData many{.name = "", .channels = {}, .width = 256, .height = 256, .attributes = {}};
  for (int i = 0; i < 300; ++i) many.channels.push_back({"layer" + std::to_string(i) + ".V", {1}});
  many.channels.push_back({"Z", {5}});
  const auto bytes = ExrWriter::file({many});  // 79 MB; all channels would be as much again
  many = {};
  EXPECT_EQ(engine::readDepth(std::as_bytes(std::span(bytes)), "a.exr", {}).image.samples.at(1000), 5.0f);
}

// ---- HDR

TEST_F(Hostile, HdrOfFewBytesCannotClaimManyPixels) {
  const auto hdr = [](const std::string& size) {
    return bytesOf("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n12345678");
  };
  EXPECT_THAT(errorOfReading(hdr("-Y 4 +X 32000"), "a.hdr"), HasSubstr("cannot hold 32000x4 pixels"));
  EXPECT_THAT(errorOfReading(hdr("-Y 16000 +X 16000"), "a.hdr"), HasSubstr("cannot hold"));
  EXPECT_THAT(errorOfReading(hdr("-Y 4 +X 88888888"), "a.hdr"), HasSubstr("is 88888888x4 px, larger than"));
  EXPECT_THAT(errorOfReading(hdr("-Y 99999999999999999999 +X 4"), "a.hdr"), HasSubstr("no picture size"));
  EXPECT_THAT(errorOfReading(hdr("-Y -4 +X 4"), "a.hdr"), StartsWith("a.hdr: "));
  EXPECT_THAT(errorOfReading(hdr("-Y 0 +X 4"), "a.hdr"), StartsWith("a.hdr: "));
  EXPECT_THAT(errorOfReading(bytesOf("#?RADIANCE\n" + std::string(100000, 'x')), "a.hdr"),
              HasSubstr("no picture size"));
}

// ---- PNG

/// A PNG with chunks put between its header and its pixels.
Bytes pngWith(const std::vector<std::pair<std::string, Bytes>>& chunks) {
  Bytes png = test::rawPng(2, 1, 8, test::PngColor::rgb, {255, 0, 0, 0, 255, 0});
  Bytes more;
  for (const auto& [type, data] : chunks) test::appendChunk(more, type, data);
  png.insert(png.begin() + 33, more.begin(), more.end());
  return png;
}

TEST_F(Hostile, PngMetadataAreSkippedUnread) {
  std::string deep = "XML:com.adobe.xmp";
  deep += std::string(5, '\0');
  for (int i = 0; i < 20000; ++i) deep += "<rdf:li>";
  testing::internal::CaptureStderr();
  const FloatImage image = read(pngWith({{"iTXt", bytesOf(deep)},
                                         {"tEXt", bytesOf("no end")},
                                         {"zTXt", bytesOf("key")},
                                         {"eXIf", bytesOf("MM")},
                                         {"iCCP", bytesOf("broken")},
                                         {"cHRM", bytesOf("short")},
                                         {"pHYs", Bytes(9, 0)},
                                         {"tIME", Bytes(1, 0)},
                                         {"sPLT", Bytes(3, 1)},
                                         {"hIST", Bytes(3, 1)},
                                         {"bKGD", Bytes(1, 1)},
                                         {"sBIT", Bytes(9, 9)},
                                         {"gAMA", Bytes(4, 0)},
                                         {"sRGB", Bytes(1, 99)},
                                         {"abCd", Bytes(1000, 7)}}),
                                "a.png");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(image.samples.at(0), 1.0f);
}

TEST_F(Hostile, DamagedPngSaysNothingByItself) {
  const Bytes good = test::rawPng(2, 2, 8, test::PngColor::rgb, std::vector<uint16_t>(12, 99));
  testing::internal::CaptureStderr();
  for (size_t i = 8; i < good.size(); ++i) {
    Bytes bad = good;
    bad[i] ^= 0x41;
    const std::string error = errorOfReading(bad, "a.png");
    EXPECT_THAT(error, testing::AnyOf(StartsWith("a.png: "), testing::Eq("no error"))) << i;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(Hostile, PngWithoutAHeaderIsRefused) {
  Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  test::appendChunk(png, "IEND", {});
  EXPECT_THAT(errorOfReading(png, "a.png"), HasSubstr("no header"));
}

TEST_F(Hostile, PngLargerThanTheLimitsSaysSo) {
  for (const auto& [width, height] : {std::pair{30000u, 30000u}, {70000u, 1u}, {1u, 2000000000u}}) {
    const auto bytes = test::rawPng(width, height, 8, test::PngColor::grey, {});
    EXPECT_THAT(errorOfReading(bytes, "a.png"),
                AllOf(HasSubstr("is " + std::to_string(width) + "x" + std::to_string(height) + " px, larger than"),
                      Not(HasSubstr("damaged"))));
  }
  EXPECT_THAT(errorOfReading(test::rawPng(16000, 16000, 16, test::PngColor::rgba, {}), "a.png"),
              HasSubstr("cannot hold 16000x16000 pixels"));
}

// ---- Pictures that failed

TEST_F(Hostile, CasePicturesEndSoon) {
  if (!std::filesystem::exists(test::casePicture(""))) GTEST_SKIP() << "no " << test::casePicture("");
  testing::internal::CaptureStderr();
  EXPECT_EQ(engine::readImage(test::casePicture("01_rowsperstrip-zero.exr")).channels, 3u);
  EXPECT_FALSE(engine::readImage(test::casePicture("03_xmp-list-blowup.png")).isEmpty());
  EXPECT_THAT(errorOf([] { engine::readImage(test::casePicture("05_crash-res.hdr")); }),
              HasSubstr("05_crash-res.hdr: "));
  EXPECT_THAT(errorOf([] { engine::readImage(test::casePicture("06_bad_ihdr_crc.png")); }), HasSubstr("CRC"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace

}  // namespace lensgraph
