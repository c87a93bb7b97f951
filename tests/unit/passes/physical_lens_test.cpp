// A physical lens against the thin-lens formulas in long double, over the extremes that pictures are asked
// for.
#include "passes/lens/physical_lens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace lensgraph {

namespace {

using passes::FovModel;
using passes::Lens;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kFovy = 40.0 * std::numbers::pi / 180.0;

std::vector<std::string> badFields(const Lens& lens) {
  std::vector<std::string> fields;
  for (const auto& problem : passes::validate(lens)) {
    EXPECT_FALSE(problem.reason.empty());
    EXPECT_FALSE(problem.remedy.empty());
    fields.push_back(problem.field);
  }
  return fields;
}

// c = K (1/d_f - 1/d) without rounding: what the float chain through the depth buffer is held to.
long double exactCoc(const Lens& lens, double fovy, int height, double depth) {
  const long double s = 0.5L * height / std::tan(0.5L * fovy);
  const long double aperture = lens.focalLengthMm * 1e-3L / (2.0L * lens.fStop);
  return s * aperture * (1.0L / lens.focusDistance - 1.0L / depth);
}

float depthBuffer(double nearPlane, double depth) {
  return static_cast<float>(nearPlane / depth);
}

float cocThroughDepthBuffer(const shared::LensConstants& constants, double nearPlane, double depth) {
  return shared::signedCocRadius(constants, shared::vergenceFromDepthBuffer(constants, depthBuffer(nearPlane, depth)));
}

TEST(Lens, DefaultsAreValid) {
  EXPECT_TRUE(passes::validate(Lens{}).empty());
}

TEST(Lens, EveryBadFieldIsNamed) {
  const auto with = [](auto member, auto value) {
    Lens lens;
    lens.*member = value;
    return badFields(lens);
  };
  using testing::ElementsAre;
  for (const double bad : {0.0, -1.0, kNaN, -kInfinity}) {
    EXPECT_THAT(with(&Lens::focusDistance, bad), ElementsAre("focusDistance")) << bad;
  }
  for (const double bad : {-1.0, kNaN, kInfinity}) EXPECT_THAT(with(&Lens::fStop, bad), ElementsAre("fStop")) << bad;
  for (const double bad : {0.0, -50.0, kNaN, kInfinity}) {
    EXPECT_THAT(with(&Lens::focalLengthMm, bad), ElementsAre("focalLengthMm")) << bad;
    EXPECT_THAT(with(&Lens::sensorWidthMm, bad), ElementsAre("sensorWidthMm")) << bad;
    EXPECT_THAT(with(&Lens::sensorHeightMm, bad), ElementsAre("sensorHeightMm")) << bad;
    EXPECT_THAT(with(&Lens::metersPerUnit, bad), ElementsAre("metersPerUnit")) << bad;
  }
  for (const double bad : {kNaN, kInfinity}) {
    EXPECT_THAT(with(&Lens::apertureRadius, bad), ElementsAre("apertureRadius"));
    EXPECT_THAT(with(&Lens::bladeRotation, bad), ElementsAre("bladeRotation"));
    EXPECT_THAT(with(&Lens::bladeCurvature, bad), ElementsAre("bladeCurvature"));
    EXPECT_THAT(with(&Lens::maxCocRadius, bad), ElementsAre("maxCocRadius"));
  }
  for (const int bad : {-1, 1, 2, 17}) EXPECT_THAT(with(&Lens::bladeCount, bad), ElementsAre("bladeCount")) << bad;
  EXPECT_THAT(with(&Lens::bladeCurvature, 1.01), ElementsAre("bladeCurvature"));
  EXPECT_THAT(with(&Lens::anamorphicRatio, 0.2), ElementsAre("anamorphicRatio"));
  EXPECT_THAT(with(&Lens::opticalVignetting, -0.1), ElementsAre("opticalVignetting"));
  EXPECT_THAT(with(&Lens::sphericalAberration, 1.1), ElementsAre("sphericalAberration"));
  EXPECT_THAT(with(&Lens::maxCocRadius, -0.1), ElementsAre("maxCocRadius"));
}

TEST(Lens, LegalExtremesAreAccepted) {
  Lens lens;
  for (const double focus : {1e-3, 0.05, 1e7, kInfinity}) {
    lens.focusDistance = focus;
    EXPECT_TRUE(passes::validate(lens).empty()) << focus;
  }
  lens = {};
  lens.fStop = 0.0;
  lens.bladeCount = 3;
  EXPECT_TRUE(passes::validate(lens).empty());
}

TEST(Lens, FocusWithinTheFocalLengthIsAnErrorOnlyWhenBreathing) {
  for (const double focus : {0.05, 0.04}) {
    Lens lens;
    lens.focusDistance = focus;
    EXPECT_TRUE(passes::validate(lens).empty());
    lens.fovModel = FovModel::breathing;
    EXPECT_THAT(badFields(lens), testing::ElementsAre("focusDistance"));
  }
}

TEST(Lens, TheApertureIsARadius) {
  Lens lens;
  lens.focalLengthMm = 85.0;
  lens.fStop = 1.4;
  EXPECT_DOUBLE_EQ(passes::apertureRadius(lens), 0.085 / 1.4 / 2.0);  // Not the diameter F/N.
  lens.fStop = 0.0;
  EXPECT_EQ(passes::apertureRadius(lens), 0.0);
  lens.apertureRadius = 0.01;  // Given: replaces both, fStop 0 too.
  EXPECT_EQ(passes::apertureRadius(lens), 0.01);
  lens.apertureRadius = 0.0;
  lens.fStop = 1.4;
  EXPECT_EQ(passes::apertureRadius(lens), 0.0);
}

TEST(Lens, AnApertureOfZeroIsExactlyOff) {
  Lens lens;
  lens.fStop = 0.0;
  EXPECT_EQ(passes::lensConstants(lens, kFovy, 1080, 0.1).cocScale, 0.0f);
}

TEST(Lens, FocusAtInfinityIsVergenceZeroAndTheSkyIsSharp) {
  Lens lens;
  lens.focusDistance = kInfinity;
  const auto constants = passes::lensConstants(lens, kFovy, 1080, 0.1);
  EXPECT_EQ(constants.focusVergence, 0.0f);
  EXPECT_EQ(shared::signedCocRadius(constants, shared::vergenceFromDepthBuffer(constants, 0.0f)), 0.0f);
}

TEST(Lens, TheCocIsNegativeInFrontAndPositiveBehind) {
  Lens lens;
  lens.focusDistance = 3.0;
  const auto constants = passes::lensConstants(lens, kFovy, 1080, 0.1);
  EXPECT_LT(cocThroughDepthBuffer(constants, 0.1, 2.0), 0.0f);
  EXPECT_GT(cocThroughDepthBuffer(constants, 0.1, 4.0), 0.0f);
}

// 85 mm f/1.4 at 3 m, sky, 1080 lines, 24 mm sensor: image distance · E · V_f over the pixel, by hand.
TEST(Lens, TheBlurOfAnEightyFiveMillimeterLensIsAsWorkedOutByHand) {
  Lens lens;
  lens.focalLengthMm = 85.0;
  lens.fStop = 1.4;
  lens.focusDistance = 3.0;
  const double fovy = 2.0 * std::atan(24.0 / (2.0 * 85.0));
  const auto pinhole = passes::lensConstants(lens, fovy, 1080, 0.1);
  const double radiusOnSensor = 85.0 * (85.0 / 2.8) / 3000.0;  // mm, with the sensor at F
  EXPECT_NEAR(shared::signedCocRadius(pinhole, 0.0f), radiusOnSensor / 24.0 * 1080.0, 1e-4);
  lens.fovModel = FovModel::breathing;
  const auto breathing = passes::lensConstants(lens, fovy, 1080, 0.1);
  EXPECT_NEAR(static_cast<double>(breathing.cocScale) / static_cast<double>(pinhole.cocScale), 3.0 / (3.0 - 0.085),
              1e-6);  // 2.9 %
}

TEST(Lens, BreathingIsFiniteAtInfinityAndIgnoresFovy) {
  Lens lens;
  lens.fovModel = FovModel::breathing;
  lens.focusDistance = kInfinity;
  EXPECT_DOUBLE_EQ(passes::pixelsPerTangent(lens, 0.1, 1000), 0.05 * 1000 / 0.024);
  EXPECT_EQ(passes::pixelsPerTangent(lens, 0.1, 1000), passes::pixelsPerTangent(lens, 1.0, 1000));
}

TEST(Lens, FovyBelongsToTheWholeHeight) {
  EXPECT_NEAR(passes::pixelsPerTangent(Lens{}, std::numbers::pi / 2.0, 1000), 500.0, 1e-9);
}

TEST(Lens, ALimitIsAFractionOfTheHeightAndOffByDefault) {
  Lens lens;
  EXPECT_EQ(passes::lensConstants(lens, kFovy, 1000, 0.1).maxCocRadius, 1e30f);
  lens.maxCocRadius = 0.01;
  const auto constants = passes::lensConstants(lens, kFovy, 1000, 0.1);
  EXPECT_EQ(constants.maxCocRadius, 10.0f);
  EXPECT_EQ(shared::signedCocRadius(constants, 1e4f), -10.0f);
}

// A host in centimetres: its depth buffer holds near/depth, a ratio; only its near plane needs metres.
TEST(Lens, SceneUnitsMeetTheLensAtTheNearPlane) {
  Lens lens;
  lens.metersPerUnit = 0.01;
  lens.focusDistance = 3.0;
  const double nearUnits = 10.0, depthUnits = 450.0;
  const auto constants = passes::lensConstants(lens, kFovy, 1080, passes::metersFromSceneUnits(lens, nearUnits));
  const float z = static_cast<float>(nearUnits / depthUnits);
  EXPECT_NEAR(shared::vergenceFromDepthBuffer(constants, z), 1.0f / 4.5f, 1e-6f);
  EXPECT_NEAR(shared::signedCocRadius(constants, shared::vergenceFromDepthBuffer(constants, z)),
              static_cast<double>(exactCoc(lens, kFovy, 1080, 4.5)), 1e-4);
}

// Relative to the larger of the two terms of V_f - V, float keeps its digits at every extreme.
TEST(Lens, TheDepthBufferGivesTheCocOverAllExtremes) {
  int checked = 0;
  for (const double focus : {1e-3, 0.05, 0.3, 1.0, 3.0, 100.0, 1e7, kInfinity}) {
    for (const double nearPlane : {1e-4, 0.01, 0.3}) {
      for (const double fStop : {0.5, 2.8, 1e4}) {
        Lens lens;
        lens.focusDistance = focus;
        lens.fStop = fStop;
        const auto constants = passes::lensConstants(lens, kFovy, 1080, nearPlane);
        for (double depth = nearPlane; depth < 1e9; depth *= 1.7) {
          const long double exact = exactCoc(lens, kFovy, 1080, depth);
          const long double larger =
              static_cast<long double>(constants.cocScale) * std::max(1.0L / lens.focusDistance, 1.0L / depth);
          const auto coc = static_cast<long double>(cocThroughDepthBuffer(constants, nearPlane, depth));
          ASSERT_LE(std::abs(coc - exact), 4.0L * 0x1p-23L * larger) << focus << ' ' << nearPlane << ' ' << depth;
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 1000);
}

// lens.h's promise near focus: below 2·K·V_f·2^-23 px for |d/d_f - 1| ≤ 2 %, z correctly rounded.
TEST(Lens, NearFocusTheErrorStaysBelowItsBound) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  long double worst = 0.0L;
  for (int i = 0; i < 200000; ++i) {
    Lens lens;
    lens.focusDistance = std::pow(10.0, -3.0 + 10.0 * unit(random));
    const double nearPlane = std::min(lens.focusDistance * 0.5, std::pow(10.0, -4.0 + 3.0 * unit(random)));
    const double depth = lens.focusDistance * (0.98 + 0.04 * unit(random));
    const auto constants = passes::lensConstants(lens, kFovy, 1080, nearPlane);
    const long double scale = 0.5L * 1080 / std::tan(0.5L * kFovy) * passes::apertureRadius(lens);
    const auto coc = static_cast<long double>(cocThroughDepthBuffer(constants, nearPlane, depth));
    worst =
        std::max(worst, std::abs(coc - exactCoc(lens, kFovy, 1080, depth)) / (scale / lens.focusDistance * 0x1p-23L));
  }
  EXPECT_LT(worst, 2.0L);
  EXPECT_GT(worst, 0.5L) << "the bound would be idle";
  RecordProperty("worst", std::to_string(static_cast<double>(worst)));
}

TEST(Lens, NoExtremeMakesNaNOrInfinity) {
  for (const double focus : {1e-300, 1e-3, 1e7, kInfinity}) {
    for (const double fStop : {1e-300, 1e-6, 0.5, 1e300}) {
      for (const double nearPlane : {1e-4, 1e9}) {
        Lens lens;
        lens.focusDistance = focus;
        lens.fStop = fStop;
        ASSERT_TRUE(passes::validate(lens).empty());
        const auto constants = passes::lensConstants(lens, kFovy, 16384, nearPlane);
        for (const float z : {0.0f, 1e-38f, 0.5f, 1.0f}) {
          EXPECT_TRUE(std::isfinite(shared::signedCocRadius(constants, shared::vergenceFromDepthBuffer(constants, z))));
        }
      }
    }
  }
}

TEST(Lens, TheApertureShapeIsTaken) {
  Lens lens;
  lens.bladeCount = 7;
  lens.bladeRotation = 0.25 + 4.0 * std::numbers::pi;
  lens.bladeCurvature = 0.5;
  lens.anamorphicRatio = 1.5;
  lens.opticalVignetting = 0.3;
  lens.sphericalAberration = -0.5;
  const auto shape = passes::apertureShape(lens);
  EXPECT_EQ(shape.bladeCount, 7u);
  EXPECT_NEAR(shape.bladeRotation, 0.25f, 1e-6f);
  EXPECT_EQ(shape.bladeCurvature, 0.5f);
  EXPECT_EQ(shape.anamorphicRatio, 1.5f);
  EXPECT_EQ(shape.opticalVignetting, 0.3f);
  EXPECT_EQ(shape.sphericalAberration, -0.5f);
  EXPECT_EQ(shape.gaussian, 0u);
}

}  // namespace

}  // namespace lensgraph
