// `lensgraph compare` as a user runs it: several pictures, FLIP, figures under failure masks, maps, bad input.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/image/image_io.h"
#include "engine/metrics/failure_masks.h"
#include "engine/metrics/flip.h"
#include "engine/metrics/hdr_flip.h"
#include "engine/metrics/metrics.h"
#include "program.h"

namespace lensgraph::cli_test {
namespace {

using engine::FloatImage;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr uint32_t kWidth = 48, kHeight = 36;

class Compare : public ProgramTest {
 protected:
  Compare() {
    writeQuad();
    reference_ = FloatImage(kWidth, kHeight, 3, 0.25f);
    for (uint32_t x = 0; x < kWidth; ++x) *reference_.pixel(x, 5) = 4.0f;  // a highlight
    first_ = second_ = reference_;
    first_.pixel(20, 20)[1] = 0.9f;
    for (uint32_t y = 0; y < kHeight; ++y) second_.pixel(30, y)[2] = 0.8f;
    engine::writeImage(folder() / "reference.exr", reference_);
    engine::writeImage(folder() / "first.exr", first_);
    engine::writeImage(folder() / "second.exr", second_);
  }

  json compared(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"compare", "--json"});
    return json::parse(runWell(arguments));
  }

  FloatImage reference_, first_, second_;
};

TEST_F(Compare, TellsFlipAndHdrFlip) {
  const json measured = compared({"first.exr", "reference.exr"});
  EXPECT_NEAR(measured["flip"].get<double>(), engine::flip(first_, reference_).mean, 1e-9);
  const auto hdr = engine::hdrFlip(first_, reference_);
  EXPECT_NEAR(measured["hdrFlip"].get<double>(), hdr.mean, 1e-9);
  EXPECT_EQ(measured["hdrFlipExposures"]["count"], hdr.exposures.count);
  EXPECT_NEAR(measured["hdrFlipExposures"]["firstEv"].get<double>(), hdr.exposures.firstEv, 1e-9);
  EXPECT_FALSE(measured.contains("masks"));
  EXPECT_THAT(runWell({"compare", "first.exr", "reference.exr"}),
              testing::AllOf(HasSubstr("FLIP           0.0"), HasSubstr("HDR-FLIP       0.")));
}

TEST_F(Compare, SeveralPicturesGiveTheFiguresOfEach) {
  const json both = compared({"first.exr", "second.exr", "reference.exr", "--exposure", "0.5"});
  EXPECT_EQ(both["reference"], "reference.exr");
  EXPECT_EQ(both["exposureEv"], 0.5);
  ASSERT_EQ(both["pictures"].size(), 2u);
  for (const std::string name : {"first.exr", "second.exr"}) {
    json alone = compared({name, "reference.exr", "--exposure", "0.5"});
    EXPECT_EQ(alone["reference"], "reference.exr");
    alone.erase("reference");
    alone.erase("exposureEv");
    EXPECT_EQ(both["pictures"][name == "first.exr" ? 0 : 1], alone);
  }
  const std::string table = runWell({"compare", "first.exr", "second.exr", "reference.exr"});
  EXPECT_THAT(table, testing::AllOf(HasSubstr("PSNR, dB"), HasSubstr("first.exr"), HasSubstr("second.exr")));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
}

// c is 0 in the right half, at the focus of 2 m, and K (1/2 - 1) in the left one, at 1 m.
TEST_F(Compare, AShotAndItsDepthGiveFiguresUnderMasks) {
  json shot = this->shot();
  shot["camera"]["fovyDeg"] = 40;
  shot["lens"] = {{"apertureRadius", 0.1}, {"focusDistance", 2}};
  writeShot(shot);
  FloatImage depth(kWidth, kHeight, 1, 2.0f), coc(kWidth, kHeight, 1);
  const double cocScale = kHeight / (2.0 * std::tan(20.0 * 3.14159265358979 / 180.0)) * 0.1;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth / 2; ++x) {
      *depth.pixel(x, y) = 1.0f;
      *coc.pixel(x, y) = static_cast<float>(cocScale * (0.5 - 1.0));
    }
  }
  engine::writeImage(folder() / "depth.exr", depth);
  const json measured = compared({"second.exr", "reference.exr", "--shot", "shot.json", "--depth", "depth.exr"});
  const auto flip = engine::flip(second_, reference_);
  for (const auto& mask : engine::failureMasks(coc, reference_)) {
    SCOPED_TRACE(mask.name);
    const json& under = measured["masks"][std::string(mask.name)];
    const auto expected = engine::compareImages(second_, reference_, {.mask = &mask.pixels});
    EXPECT_EQ(under["pixels"], expected.pixelCount);
    EXPECT_NEAR(under["share"].get<double>(), static_cast<double>(expected.pixelCount) / (kWidth * kHeight), 1e-9);
    if (std::isfinite(expected.psnr)) {
      EXPECT_NEAR(under["psnr"].get<double>(), expected.psnr, 1e-6);
    }
    EXPECT_NEAR(under["flip"].get<double>(), engine::meanUnderMask(flip.map, mask.pixels), 1e-9);
  }
  EXPECT_EQ(measured["masks"]["highlight"]["pixels"], kWidth);
  // c = -2.47 px in the left half: columns 21 … 25 are within it of column 23, the left half's last.
  EXPECT_EQ(measured["masks"]["nearEdge"]["pixels"], 5 * kHeight);
  EXPECT_EQ(measured["masks"]["inFocus"]["pixels"], kWidth / 2 * kHeight);
}

TEST_F(Compare, WithoutDepthTheShotIsRendered) {
  json shot = this->shot();
  // The right half of the picture is background, beside the edge of the quad.
  shot["camera"]["position"] = {20, 0, 0};
  shot["camera"]["target"] = {20, 0, -1};
  shot["lens"] = {{"apertureRadius", 0.2}, {"focusDistance", 2}};
  writeShot(shot);
  const std::string size = std::to_string(kWidth) + "x" + std::to_string(kHeight);
  runWell({"render", "shot.json", "--technique", "pinhole", "--size", size, "--depth-out", "depth.exr", "-o", "p.exr"});
  const std::vector<std::string> arguments = {"first.exr", "reference.exr", "--shot", "shot.json"};
  auto withDepth = arguments;
  withDepth.insert(withDepth.end(), {"--depth", "depth.exr"});
  const json rendered = compared(arguments);
  EXPECT_EQ(rendered, compared(withDepth));
  EXPECT_GT(rendered["masks"]["partialOcclusion"]["pixels"], 0);
}

TEST_F(Compare, MapsAreWritten) {
  writeShot(shot());
  engine::writeImage(folder() / "depth.exr", FloatImage(kWidth, kHeight, 1, 2.0f));
  const json measured = compared({"first.exr", "second.exr", "reference.exr", "--shot", "shot.json", "--depth",
                                  "depth.exr", "--maps", "new/maps"});
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder() / "new/maps")) {
    names.insert(entry.path().filename().string());
  }
  EXPECT_THAT(names, ElementsAre("first.difference.png", "first.flip.exr", "first.flip.png", "first.hdr_flip.exr",
                                 "first.hdr_flip.png", "mask.highlight.png", "mask.inFocus.png", "mask.nearEdge.png",
                                 "mask.partialOcclusion.png", "second.difference.png", "second.flip.exr",
                                 "second.flip.png", "second.hdr_flip.exr", "second.hdr_flip.png"));
  const FloatImage map = engine::readImage(folder() / "new/maps/second.flip.exr");
  double sum = 0.0;
  for (const float value : map.samples) sum += value;
  EXPECT_NEAR(sum / static_cast<double>(map.pixelCount()), measured["pictures"][1]["flip"].get<double>(), 1e-6);
  const FloatImage highlights = engine::readImage(folder() / "new/maps/mask.highlight.png");
  EXPECT_EQ(*highlights.pixel(3, 5), 1.0f);
  EXPECT_EQ(*highlights.pixel(3, 6), 0.0f);
}

TEST_F(Compare, BadInputIsOneLine) {
  writeShot(shot());
  engine::writeImage(folder() / "small.exr", FloatImage(4, 4, 3));
  engine::writeImage(folder() / "depth.exr", FloatImage(8, 4, 1));
  write("file", "x");
  expectError({"compare", "first.exr", "small.exr", "reference.exr"}, 2,
              {"small.exr", "4x4", "48x36", "differ in size"});
  expectError({"compare", "first.exr", "reference.exr", "--shot", "shot.json", "--depth", "depth.exr"}, 2,
              {"depth.exr", "--depth", "8x4", "48x36"});
  expectError({"compare", "first.exr", "missing.exr", "reference.exr", "--maps", "maps"}, 2, {"missing.exr"});
  expectError({"compare", "first.exr", "missing.exr"}, 2, {"missing.exr"});
  expectError({"compare", "first.exr", "reference.exr", "--shot", "missing.json"}, 2, {"missing.json"});
  expectError({"compare", "first.exr", "reference.exr", "--depth", "depth.exr"}, 2, {"--depth", "--shot"});
  expectError({"compare", "first.exr", "reference.exr", "--maps", "file"}, 2, {"--maps", "file"});
  expectError({"compare", "first.exr"}, 2, {"compare"});
}

TEST_F(Compare, MapsReplaceNoPictureThatIsCompared) {
  engine::writeImage(folder() / "a.flip.exr", reference_);
  engine::writeImage(folder() / "a.png", reference_);
  const auto outcome = run({"compare", "a.png", "a.flip.exr", "--maps", "."});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("a.flip.exr"));
}

}  // namespace
}  // namespace lensgraph::cli_test
