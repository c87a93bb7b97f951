// Accumulation and ray tracing, which share the scene and the lens' numbers alone, give the same picture of every lens;
// and a lens that differs by 2 % does not. So a wrong constant in either is found here.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>

#include "engine/metrics/metrics.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph {

namespace {

constexpr double kFloorDb = 50.0;
constexpr double kShapedFloorDb = 46.0;  ///< Of aperture shapes, whose samples are fewer or weighted.

/// A wall of bars as wide as their blur's radius is where a change of the radius shows most: the contrast of a square wave
/// of period 2r falls fastest there. Before it a bar in front of the focus, a blended pane, and a checker in focus.
engine::Scene barScene() {
  engine::Scene scene;
  const uint32_t white = support::addMaterial(scene, {0.9f, 0.8f, 0.7f, 1.0f});
  const uint32_t red = support::addMaterial(scene, {0.8f, 0.1f, 0.05f, 1.0f});
  const uint32_t pane = support::addMaterial(scene, {0.1f, 0.3f, 0.9f, 0.4f});
  for (int i = -12; i < 12; ++i) support::addFacingQuad(scene, 8.0, 1.5 * i + 0.3, 0.0, 0.375, 12.0, white);
  for (int i = 0; i < 4; ++i) support::addFacingQuad(scene, 2.0, 0.16 * i - 0.5, 0.08 * i - 0.3, 0.06, 0.06, red);
  support::addFacingQuad(scene, 1.6, 0.45, -0.4, 0.05, 0.3, red);
  support::addFacingQuad(scene, 3.0, -0.5, 0.7, 0.4, 0.3, pane);
  return scene;
}

class RaytracedLens : public support::GpuTest {
 protected:
  RaytracedLens() : shot_(support::smallShot(48, 32)), renderer_(support::device(), barScene(), std::nullopt) {
    shot_.lens.apertureRadius = 0.25;
    shot_.background = {0.1f, 0.12f, 0.15f};
  }
  host::Rendering accumulated() {
    return support::render(renderer_, shot_, "accumulation",
                           {{"lensSamples", int64_t{1024}}, {"viewsPerFrame", int64_t{64}}});
  }
  host::Rendering raytraced() { return support::render(renderer_, shot_, "raytraced", {{"samples", int64_t{2048}}}); }
  /// PSNR of the two with the lens as it is now.
  double agreement(const char* name) {
    const auto one = accumulated(), other = raytraced();
    support::keepPicture(one.color, std::string("accumulated_") + name);
    support::keepPicture(other.color, std::string("raytraced_") + name);
    const double psnr = engine::compareImages(one.color, other.color).psnr;
    std::printf("%-20s %6.2f dB\n", name, psnr);
    return psnr;
  }

  host::Shot shot_;
  host::Renderer renderer_;
};

TEST_F(RaytracedLens, ARoundApertureAgreesAndALensWrongByTwoPercentDoesNot) {
  EXPECT_GE(agreement("round"), kFloorDb);
  const auto truth = accumulated();
  const auto expectBelow = [&](double passes::Lens::*member, double factor) {
    const double right = shot_.lens.*member;
    shot_.lens.*member = right * factor;
    const double psnr = engine::compareImages(raytraced().color, truth.color).psnr;
    std::printf("%-20s %6.2f dB\n", factor > 1.0 ? "2 % more" : "2 % less", psnr);
    EXPECT_LT(psnr, kFloorDb - 2.0);
    shot_.lens.*member = right;
  };
  expectBelow(&passes::Lens::apertureRadius, 1.02);
  expectBelow(&passes::Lens::focusDistance, 0.98);
}

TEST_F(RaytracedLens, FocusAtInfinityAgrees) {
  shot_.lens.focusDistance = std::numeric_limits<double>::infinity();
  shot_.lens.apertureRadius = 0.5;
  EXPECT_GE(agreement("infinity"), kFloorDb);
}

TEST_F(RaytracedLens, ABreathingFieldOfViewAgrees) {
  shot_.lens.fovModel = passes::FovModel::breathing;
  shot_.lens.focalLengthMm = 400.0;
  shot_.lens.sensorHeightMm = 250.0;
  EXPECT_GE(agreement("breathing"), kFloorDb);
}

TEST_F(RaytracedLens, FocalLengthAndFNumberAgreeInASceneOfOtherUnits) {
  shot_.lens.metersPerUnit = 0.5;
  shot_.lens.focusDistance = 1.0;
  shot_.lens.apertureRadius = -1.0;
  shot_.lens.focalLengthMm = 250.0;
  shot_.lens.fStop = 1.0;
  EXPECT_GE(agreement("half_metres"), kFloorDb);
}

TEST_F(RaytracedLens, CurvedBladesAgree) {
  shot_.lens.bladeCount = 5;
  shot_.lens.bladeRotation = 0.3;
  shot_.lens.bladeCurvature = 0.6;
  EXPECT_GE(agreement("curved_blades"), kShapedFloorDb);
}

TEST_F(RaytracedLens, AnAnamorphicLensWithACatsEyeAndAberrationAgrees) {
  shot_.lens.anamorphicRatio = 1.8;
  shot_.lens.opticalVignetting = 0.7;
  shot_.lens.sphericalAberration = 0.8;
  shot_.lens.bladeCount = 6;
  EXPECT_GE(agreement("all"), kShapedFloorDb);
}

TEST_F(RaytracedLens, DepthIsThatOfThePinholePicture) {
  host::RenderOptions options;
  options.wantDepth = true;
  options.technique = "pinhole";
  const auto drawn = renderer_.render(shot_, options).depth;
  options.technique = "raytraced";
  options.parameters = {{"samples", int64_t{1}}};
  const auto traced = renderer_.render(shot_, options).depth;
  std::size_t different = 0;
  for (std::size_t i = 0; i < drawn.pixelCount(); ++i) {
    const double a = drawn.samples[i], b = traced.samples[i];
    if (std::abs(a - b) > 1e-5 * b) ++different;
  }
  EXPECT_LE(different, drawn.pixelCount() / 100);  // Pixel centers on edges.
}

}  // namespace

}  // namespace lensgraph
