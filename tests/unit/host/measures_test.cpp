// Circles of confusion from depth, and the figures of one picture with their JSON.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/metrics/flip.h"
#include "engine/metrics/metrics.h"
#include "passes/lens/physical_lens.h"
#include "samples/host/measures/coc_picture.h"
#include "samples/host/measures/quality.h"
#include "samples/host/rendering.h"

namespace lensgraph {
namespace {

using engine::FloatImage;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(CocPicture, IsTheThinLensFormula) {
  passes::Lens lens;
  lens.apertureRadius = 0.05;
  lens.focusDistance = 2.0;
  FloatImage depth(3, 1, 1);
  depth.samples = {1.0f, 2.0f, 4.0f};
  const auto coc = host::cocPicture(depth, passes::lensConstants(lens, 0.7, 100, 0.01));
  const double cocScale = 100.0 / (2.0 * std::tan(0.35)) * 0.05;
  EXPECT_NEAR(coc.samples[0], -0.5 * cocScale, 1e-5);
  EXPECT_NEAR(coc.samples[1], 0.0, 1e-5);
  EXPECT_NEAR(coc.samples[2], 0.25 * cocScale, 1e-5);
}

TEST(CocPicture, TakesWhatIsNotHitAsInfinitelyFarAndStaysFinite) {
  passes::Lens lens;
  lens.apertureRadius = 0.05;
  lens.focusDistance = 2.0;
  FloatImage depth(7, 1, 1);
  depth.samples = {host::kNothingHit, kInfinity, 0.0f, -1.0f, std::nanf(""), 3e38f, 1e-42f};
  const auto constants = passes::lensConstants(lens, 0.7, 100, 0.01);
  const auto coc = host::cocPicture(depth, constants);
  for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(coc.samples[i], constants.cocScale * 0.5f, 1e-4) << i;
  EXPECT_TRUE(std::isfinite(coc.samples[6]));
  EXPECT_LT(coc.samples[6], -1e6f);
}

// A shot's camera has 40 degrees unless it says otherwise; the picture's height counts, not the shot's.
TEST(CocPicture, OfAShotHasTheHeightOfTheDepth) {
  host::Shot shot;
  shot.height = 7;
  shot.lens.apertureRadius = 0.1;
  shot.lens.focusDistance = 1.0;
  const auto coc = host::cocPicture(FloatImage(2, 200, 1, kInfinity), shot);
  EXPECT_NEAR(coc.samples[0], 200.0 / (2.0 * std::tan(20.0 * 3.14159265358979 / 180.0)) * 0.1, 1e-3);
}

TEST(Quality, HoldsTheFiguresOfThePictureAndOfEachMask) {
  FloatImage reference(30, 20, 3, 0.25f), picture = reference;
  for (uint32_t x = 0; x < 30; ++x) picture.pixel(x, 8)[1] = 0.5f;
  std::vector<engine::FailureMask> masks = {{"nearEdge", FloatImage(30, 20, 1)}, {"inFocus", FloatImage(30, 20, 1)}};
  for (uint32_t x = 0; x < 30; ++x) *masks[1].pixels.pixel(x, 8) = 1.0f;
  FloatImage map;
  const auto quality = host::measureQuality(picture, reference, masks, 0.5, &map);
  const auto all = engine::compareImages(picture, reference, {.exposureEv = 0.5});
  EXPECT_EQ(quality.metrics.psnr, all.psnr);
  EXPECT_EQ(quality.metrics.ssim, all.ssim);
  EXPECT_EQ(map.samples, engine::flip(picture, reference, {.exposureEv = 0.5}).map.samples);
  ASSERT_EQ(quality.masks.size(), 2u);
  EXPECT_EQ(quality.masks[0].pixels, 0u);
  EXPECT_EQ(quality.masks[1].pixels, 30u);
  EXPECT_DOUBLE_EQ(quality.masks[1].share, 0.05);
  const auto inFocus = engine::compareImages(picture, reference, {.exposureEv = 0.5, .mask = &masks[1].pixels});
  EXPECT_EQ(quality.masks[1].psnr, inFocus.psnr);
  EXPECT_EQ(quality.masks[1].ssim, inFocus.ssim);
  EXPECT_NEAR(quality.masks[1].flip.value(), engine::meanUnderMask(map, masks[1].pixels), 1e-12);
  EXPECT_GT(quality.masks[1].flip.value(), quality.flip);

  const auto json = host::toJson(quality);
  EXPECT_EQ(json["psnr"], all.psnr);
  EXPECT_EQ(json["maxError"], all.maxErrorDisplayed);
  EXPECT_TRUE(json["masks"]["nearEdge"].is_null());
  EXPECT_EQ(json["masks"]["inFocus"]["pixels"], 30);
}

TEST(Quality, WritesWhatJsonCannotHoldAsText) {
  const FloatImage tiny(2, 2, 3, 0.5f);
  const auto json = host::toJson(host::measureQuality(tiny, tiny, {}, 0.0));
  EXPECT_EQ(json["psnr"], "infinity");
  EXPECT_TRUE(json["ssim"].is_null());
  EXPECT_EQ(json["flip"], 0.0);
  EXPECT_EQ(json["masks"], nlohmann::json::object());
  EXPECT_EQ(host::jsonNumber(-HUGE_VAL), "-infinity");
  EXPECT_EQ(host::jsonNumber(std::nan("")), "nan");
}

}  // namespace
}  // namespace lensgraph
