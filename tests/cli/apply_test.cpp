// lensgraph apply on pictures that people have: which channels it takes, what it makes of depth, what it says.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cmath>
#include <limits>

#include "engine/image/image_io.h"
#include "engine/image/srgb.h"
#include "program.h"

namespace lensgraph {

namespace {

using engine::FloatImage;
using engine::writeImage;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Apply : public cli_test::ProgramTest {
 protected:
  static constexpr uint32_t kWidth = 16, kHeight = 12;

  Apply() {
    FloatImage color(kWidth, kHeight, 3, 0.5f), depth(kWidth, kHeight, 1, 3.0f);
    for (uint32_t y = 0; y < kHeight; ++y) {
      for (uint32_t x = 0; x < kWidth / 2; ++x) {
        color.pixel(x, y)[0] = 4.0f;
        *depth.pixel(x, y) = 1.0f;
      }
    }
    writeImage(folder() / "c.exr", color);
    writeImage(folder() / "z.exr", depth);
  }

  /// Of a run that is right, but for what `more` replaces or adds: options, each with its value.
  static std::vector<std::string> arguments(const std::string& color, const std::string& depth,
                                            const std::vector<std::string>& more = {}) {
    const std::vector<std::string> usual = {
        "--color", color, "--depth", depth,         "--fovy",         "40", "--focus", "2", "--aperture-radius",
        "0.03",    "-o",  "o.exr",   "--technique", "two_pass_filter"};
    std::vector<std::string> all = {"apply"};
    for (size_t i = 0; i < usual.size(); i += 2) {
      if (std::ranges::find(more, usual[i]) == more.end()) all.insert(all.end(), {usual[i], usual[i + 1]});
    }
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  void expectRefused(const std::string& color, const std::string& depth, const std::vector<std::string>& more,
                     const std::vector<std::string>& parts) const {
    SCOPED_TRACE(testing::PrintToString(more));
    expectError(arguments(color, depth, more), 2, parts);
  }
  /// Status 0 and one warning that holds every part; returns stdout.
  std::string expectWarning(const std::vector<std::string>& all, const std::vector<std::string>& parts) const {
    const auto outcome = run(all);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, testing::StartsWith("lensgraph: warning: "));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const auto& part : parts) EXPECT_THAT(outcome.err, HasSubstr(part));
    return outcome.out;
  }
  FloatImage output() const { return engine::readImage(folder() / "o.exr"); }

  /// Writes depth whose pixel i is values[i % count].
  void writeDepth(const std::string& name, const std::vector<float>& values) const {
    FloatImage depth(kWidth, kHeight, 1);
    for (size_t i = 0; i < depth.samples.size(); ++i) depth.samples[i] = values[i % values.size()];
    writeImage(folder() / name, depth);
  }
  /// An 8-bit grey PNG whose bytes are `value` everywhere.
  void writeGreyPng(const std::string& name, int value) const {
    writeImage(folder() / name,
               FloatImage(kWidth, kHeight, 1, engine::linearFromSrgb(static_cast<float>(value) / 255.0f)));
  }
};

TEST_F(Apply, SaysWhatItReads) {
  EXPECT_THAT(runWell(arguments("c.exr", "z.exr")),
              AllOf(HasSubstr("color      c.exr: channels R, G, B\n"),
                    HasSubstr("depth      z.exr: channel Z; metres along the axis\n"), HasSubstr("from 1 to 3 m")));
}

TEST_F(Apply, ColourGivenAsDepthIsRefused) {
  expectRefused("c.exr", "c.exr", {}, {"c.exr", "has no depth channel", "R", "--depth-channel NAME"});
  EXPECT_THAT(runWell(arguments("c.exr", "c.exr", {"--depth-channel", "R"})), HasSubstr("channel R;"));
  expectRefused("c.exr", "z.exr", {"--depth-channel", "Y"}, {"z.exr", "'Y'", "Z"});
  expectRefused("c.exr", "z.exr", {"--color-layer", "beauty"}, {"c.exr", "'beauty'"});
}

TEST_F(Apply, PipesAreRefused) {
  ASSERT_EQ(mkfifo((folder() / "pipe.exr").c_str(), 0600), 0);
  expectRefused("pipe.exr", "z.exr", {}, {"pipe.exr", "is not a file"});
  expectRefused("c.exr", "pipe.exr", {}, {"pipe.exr", "is not a file"});
  expectError({"compare", "pipe.exr", "c.exr"}, 2, {"pipe.exr", "is not a file"});
}

// ---- Depth

TEST_F(Apply, DepthsThatAreNotPositiveAreCounted) {
  writeDepth("holes.exr", {1.0f, 0.0f, 3.0f, -1.0f});
  expectWarning(arguments("c.exr", "holes.exr"), {"--depth: 96 of 192 depths are not positive"});
  writeDepth("sky.exr", {1.0f, std::numeric_limits<float>::infinity(), 3.0f, 1e10f});
  runWell(arguments("c.exr", "sky.exr"));
}

TEST_F(Apply, DepthWithoutAnyPositiveValueIsRefused) {
  writeDepth("negative.exr", {-1.0f, 0.0f, std::numeric_limits<float>::quiet_NaN()});
  expectRefused("c.exr", "negative.exr", {}, {"negative.exr", "--depth", "no positive depth", "--depth-kind"});
}

TEST_F(Apply, IntegersNeedAMeaning) {
  writeGreyPng("z.png", 200);
  expectRefused("c.exr", "z.png", {}, {"z.png", "--depth", "--depth-scale", "--depth-kind"});
  expectRefused("c.exr", "z.png", {"--depth-kind", "ray"}, {"--depth-scale"});
  EXPECT_THAT(runWell(arguments("c.exr", "z.png", {"--depth-scale", "0.01"})),
              AllOf(HasSubstr("channel Y; units of 0.01 m along the axis"), HasSubstr("from 2 to 2 m")));
  const std::vector<std::string> ends = {"--depth-near", "1", "--depth-far", "5"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), ends.begin(), ends.end());
    return runWell(arguments("c.exr", "z.png", more));
  };
  EXPECT_THAT(with({"--depth-kind", "disparity"}),
              AllOf(HasSubstr("disparity, white is near"), HasSubstr("from 1.20")));
  EXPECT_THAT(with({"--depth-kind", "normalized"}), AllOf(HasSubstr("white is far"), HasSubstr("from 4.13")));
  EXPECT_THAT(with({"--depth-kind", "normalized", "--depth-white", "near"}), HasSubstr("from 1.86"));
}

TEST_F(Apply, HolesOfIntegersAreCounted) {
  FloatImage depth(kWidth, kHeight, 1, 1.0f);
  depth.samples[0] = 0.0f;
  writeImage(folder() / "holes.png", depth);
  expectWarning(arguments("c.exr", "holes.png", {"--depth-scale", "0.01"}), {"--depth: 1 of 192 depths"});
}

TEST_F(Apply, OtherUnitsGiveTheSamePictureWithTheirScale) {
  runWell(arguments("c.exr", "z.exr"));
  const auto metres = output();
  FloatImage depth = engine::readDepth(folder() / "z.exr");
  for (float& z : depth.samples) z *= 128.0f;
  writeImage(folder() / "large.exr", depth);
  runWell(arguments("c.exr", "large.exr", {"--depth-scale", "0.0078125"}));
  EXPECT_EQ(output().samples, metres.samples);
}

TEST_F(Apply, MeaninglessDepthOptionsAreRefused) {
  const std::pair<std::vector<std::string>, std::string> rows[] = {
      {{"--depth-near", "1"}, "--depth-near"},
      {{"--depth-far", "1"}, "--depth-far"},
      {{"--depth-white", "near"}, "--depth-white"},
      {{"--depth-kind", "ray", "--depth-white", "near"}, "--depth-white"},
      {{"--depth-kind", "disparity"}, "--depth-near"},
      {{"--depth-kind", "disparity", "--depth-near", "1"}, "--depth-far"},
      {{"--depth-kind", "disparity", "--depth-near", "0", "--depth-far", "1"}, "--depth-near"},
      {{"--depth-kind", "disparity", "--depth-near", "3", "--depth-far", "1"}, "--depth-far"},
      {{"--depth-kind", "normalized", "--depth-near", "1", "--depth-far", "inf"}, "--depth-far"},
      {{"--depth-kind", "normalized", "--depth-near", "1", "--depth-far", "nan"}, "--depth-far"},
      {{"--depth-kind", "disparity", "--depth-near", "1", "--depth-far", "2", "--depth-scale", "1"}, "--depth-scale"},
      {{"--depth-kind", "inverse"}, "--depth-kind"},
      {{"--depth-scale", "0"}, "--depth-scale"},
      {{"--depth-scale", "-1"}, "--depth-scale"},
      {{"--depth-scale", "nan"}, "--depth-scale"},
      {{"--depth-scale", "inf"}, "--depth-scale"},
  };
  for (const auto& [more, option] : rows) expectRefused("c.exr", "z.exr", more, {option});
}

TEST_F(Apply, ImplausibleDepthGetsAHint) {
  writeDepth("unit.exr", {0.1f, 0.4f, 1.0f});
  expectWarning(arguments("c.exr", "unit.exr", {"--focus", "30"}), {"--depth", "--focus 30", "--depth-kind"});
  expectWarning(arguments("c.exr", "unit.exr", {"--focus", "inf"}), {"--depth-kind"});
  writeDepth("cm.exr", {80.0f, 300.0f, 600.0f});
  expectWarning(arguments("c.exr", "cm.exr"), {"--depth", "--depth-scale"});
  runWell(arguments("c.exr", "cm.exr", {"--depth-scale", "0.01"}));
  runWell(arguments("c.exr", "z.exr", {"--focus", "inf"}));
}

// ---- Colour

TEST_F(Apply, BrokenColoursAreCounted) {
  FloatImage color(kWidth, kHeight, 3, 0.5f);
  color.samples[0] = std::numeric_limits<float>::quiet_NaN();
  writeImage(folder() / "nan.exr", color);
  expectWarning(arguments("nan.exr", "z.exr"), {"--color: 1 of 192 pixels are not finite"});
  color.samples[0] = 2e30f;
  writeImage(folder() / "bright.exr", color);
  expectWarning(arguments("bright.exr", "z.exr"), {"--color: 1 of 192 pixels are beyond 1e+30"});
}

TEST_F(Apply, AlphaIsBlurredAndWritten) {
  FloatImage color(kWidth, kHeight, 4);
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      for (uint32_t c = 0; c < 4; ++c) color.pixel(x, y)[c] = x < kWidth / 2 ? 0.0f : 1.0f;
    }
  }
  writeImage(folder() / "alpha.exr", color);
  writeDepth("near.exr", {1.2f});
  runWell(arguments("alpha.exr", "near.exr", {"--aperture-radius", "0.5"}));
  const auto blurred = output();
  ASSERT_EQ(blurred.channels, 4u);
  bool isSoft = false;
  for (size_t i = 0; i < blurred.samples.size(); i += 4) {
    EXPECT_EQ(blurred.samples[i + 3], blurred.samples[i]) << "red and alpha were the same";
    isSoft = isSoft || (blurred.samples[i + 3] > 0.1f && blurred.samples[i + 3] < 0.9f);
  }
  EXPECT_TRUE(isSoft);
  runWell(arguments("alpha.exr", "near.exr", {"--aperture-radius", "0"}));
  EXPECT_EQ(output().samples, color.samples);
}

TEST_F(Apply, WithoutAlphaTheResultIsOpaque) {
  runWell(arguments("c.exr", "z.exr"));
  const auto image = output();
  ASSERT_EQ(image.channels, 4u);
  for (size_t i = 3; i < image.samples.size(); i += 4) ASSERT_EQ(image.samples[i], 1.0f);
}

// ---- Pictures that failed

class ApplyToCases : public Apply {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(cases())) GTEST_SKIP() << "no " << cases();
  }
  static std::filesystem::path cases() {
    return std::filesystem::path(LENSGRAPH_SHOTS_DIR).parent_path() / "cases/pictures";
  }
  static std::string file(const std::string& name) { return cases() / name; }
  static std::vector<std::string> applied(const std::string& color, const std::string& depth) {
    return arguments(file(color), file(depth), {"--focus", "3"});
  }
};

TEST_F(ApplyToCases, DepthIsTheRightChannel) {
  runWell(applied("exr_rgbaz.exr", "exr_rgbaz.exr"));
  const auto reference = output();
  EXPECT_THAT(
      runWell(applied("exr_blender_depth_normal.exr", "exr_blender_depth_normal.exr")),
      AllOf(HasSubstr("layer ViewLayer.Combined, channels R, G, B, A"), HasSubstr("layer ViewLayer.Depth, channel Z")));
  EXPECT_EQ(output().samples, reference.samples);
  EXPECT_THAT(runWell(applied("10_rgb_depthZ_normalXYZ.exr", "10_rgb_depthZ_normalXYZ.exr")),
              HasSubstr("layer depth, channel Z"));
  EXPECT_THAT(runWell(applied("11_multipart_rgba_depth.exr", "11_multipart_rgba_depth.exr")),
              AllOf(HasSubstr("part rgba, channels R, G, B, A"), HasSubstr("part depth, channel Z")));
  expectError(applied("13_color_given_as_depth.exr", "13_color_given_as_depth.exr"), 2,
              {"13_color_given_as_depth.exr", "--depth-channel"});
}

TEST_F(ApplyToCases, HolesAreCounted) {
  expectWarning(applied("exr_rgbaz.exr", "depth_holes_zero.exr"), {"--depth: 284 of 14400 depths"});
}

TEST_F(ApplyToCases, AlphaIsKept) {
  runWell(applied("color_premultiplied_alpha.exr", "exr_rgbaz.exr"));
  const auto input = engine::readImage(file("color_premultiplied_alpha.exr")), blurred = output();
  double before = 0.0, after = 0.0;
  for (size_t i = 3; i < input.samples.size(); i += 4) {
    before += static_cast<double>(input.samples[i]);
    after += static_cast<double>(blurred.samples[i]);
  }
  EXPECT_NEAR(after / before, 1.0, 0.05);
  EXPECT_LT(after, 0.9 * static_cast<double>(input.pixelCount()));
}

TEST_F(ApplyToCases, PicturesThatCrashedTheLibraryEndSoon) {
  for (const std::string name : {"01_rowsperstrip-zero.exr", "03_xmp-list-blowup.png"}) {
    EXPECT_THAT(runWell({"compare", file(name), file(name)}), HasSubstr("PSNR           inf dB"));
  }
  for (const std::string name : {"05_crash-res.hdr", "06_bad_ihdr_crc.png"}) {
    expectError({"compare", file(name), file(name)}, 2, {name});
  }
}

}  // namespace

}  // namespace lensgraph
