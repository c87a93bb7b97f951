// Pinhole and accumulation against the independently ray-traced pictures, every technique on every shot.
// Skipped where the folder of shots is absent: its data are not part of this project.
#include "samples/host/shot.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

#include "engine/image/image_io.h"
#include "engine/metrics/metrics.h"
#include "tests/support/gpu/gpu_test.h"

namespace lensgraph {

namespace {

namespace fs = std::filesystem;
using support::render;

const fs::path kShots = LENSGRAPH_SHOTS_DIR;

struct Row {
  const char* name;
  double pinholeFloorDb;
  double accumulationFloorDb;
  double multiviewFloorDb;       ///< 256 rays, one view.
  double multiviewViewsFloorDb;  ///< The same over 16 views.
  double multilayerFloorDb;      ///< Defaults.
  double multilayerFineFloorDb;  ///< The same, antialiased by 2x2 points.
  double raytracedFloorDb;       ///< 256 rays a pixel, at a quarter of the size.
  friend void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }
};

// dB reached on lavapipe (64 pixel samples; 256 lens samples) and by the ray tracer, less a half. 35 and 40 are asked for.
constexpr Row kRows[] = {
    {"railings", 58.0, 50.3, 39.0, 42.0, 33.5, 34.7, 44.6},   {"crossing", 54.2, 52.9, 33.3, 39.3, 31.8, 36.0, 47.0},
    {"foliage", 49.3, 48.0, 30.7, 37.3, 29.2, 34.0, 43.2},    {"glass", 66.1, 62.8, 38.9, 45.3, 38.8, 43.2, 55.0},
    {"models_dev", 54.5, 51.2, 38.4, 41.6, 36.2, 39.6, 45.4}, {"sharp", 55.5, 61.4, 31.0, 47.8, 31.0, 37.4, 59.9}};

/// Lens samples of the accumulation: 256, to be quick; LENSGRAPH_SHOT_SAMPLES=1024 makes the table of docs/results.
int64_t lensSamples() {
  const char* wanted = std::getenv("LENSGRAPH_SHOT_SAMPLES");
  return wanted != nullptr ? std::strtoll(wanted, nullptr, 10) : 256;
}

class Shots : public support::GpuTest, public testing::WithParamInterface<Row> {
 protected:
  void SetUp() override {
    if (!fs::exists(kShots)) GTEST_SKIP() << "no shots at " << kShots;
    shot = host::readShot(folder() / "shot.json");
    shot.faces = engine::DrawnFaces::both;  // as the ray tracer saw them
    std::vector<std::string> warnings;
    renderer = std::make_unique<host::Renderer>(support::device(), shot, warnings);
  }
  fs::path folder() const { return kShots / GetParam().name; }
  engine::Metrics against(const engine::FloatImage& picture, const char* truth) const {
    return engine::compareImages(picture, engine::readImage(folder() / truth));
  }
  void report(const char* technique, const engine::Metrics& metrics, const host::Rendering& rendering) const {
    std::printf("%-11s %-16s %6.2f dB  SSIM %.4f  max %.3f  %8.0f ms\n", GetParam().name, technique, metrics.psnr,
                metrics.ssim.value_or(0.0), metrics.maxErrorDisplayed, rendering.wallMs);
    support::keepPicture(rendering.color, std::string(GetParam().name) + "_" + technique);
  }

  host::Shot shot;
  std::unique_ptr<host::Renderer> renderer;
};

TEST_P(Shots, PinholeEqualsTheRayTracedPicture) {
  const auto rendering = render(*renderer, shot, "pinhole", {{"pixelSamples", int64_t{64}}});
  const auto metrics = against(rendering.color, "pinhole.exr");
  report("pinhole", metrics, rendering);
  EXPECT_GE(metrics.psnr, GetParam().pinholeFloorDb);
}

TEST_P(Shots, AccumulationEqualsTheRayTracedPicture) {
  const auto rendering = render(*renderer, shot, "accumulation", {{"lensSamples", lensSamples()}});
  const auto metrics = against(rendering.color, "dof.exr");
  report("accumulation", metrics, rendering);
  EXPECT_GE(metrics.psnr, lensSamples() >= 256 ? GetParam().accumulationFloorDb : 40.0);
}

/// Means of 2x2 pixels: what a box filter of twice the width gives.
engine::FloatImage halved(const engine::FloatImage& from) {
  engine::FloatImage to(from.width / 2, from.height / 2, from.channels);
  for (uint32_t y = 0; y < to.height; ++y) {
    for (uint32_t x = 0; x < to.width; ++x) {
      for (uint32_t i = 0; i < to.channels; ++i) {
        to.pixel(x, y)[i] = 0.25f * (from.pixel(2 * x, 2 * y)[i] + from.pixel(2 * x + 1, 2 * y)[i] +
                                     from.pixel(2 * x, 2 * y + 1)[i] + from.pixel(2 * x + 1, 2 * y + 1)[i]);
      }
    }
  }
  return to;
}

// At a quarter of the size, to be quick; the table of engine/raytracer/README.md is of the whole size.
TEST_P(Shots, RaytracedEqualsTheRayTracedPicture) {
  shot.width /= 4;
  shot.height /= 4;
  const auto rendering = render(*renderer, shot, "raytraced", {{"samples", int64_t{256}}});
  const auto metrics = engine::compareImages(rendering.color, halved(halved(engine::readImage(folder() / "dof.exr"))));
  report("raytraced", metrics, rendering);
  EXPECT_GE(metrics.psnr, GetParam().raytracedFloorDb);
}

TEST_P(Shots, TwoPassFilterRendersAndIsFinite) {
  const auto rendering = render(*renderer, shot, "two_pass_filter");
  report("two_pass_filter", against(rendering.color, "dof.exr"), rendering);
  EXPECT_EQ(support::nonFiniteCount(rendering.color), 0u);
}

// The bar is 8 dB above the peer on railings and crossing (34.65, 38.13), 3 dB on foliage and models_dev (31.49, 38.10), and
// SSIM 0.985 where nothing is transparent: reached with views, which antialias what is in focus.
TEST_P(Shots, MultiviewSynthesisComesNearTheRayTracedPicture) {
  const auto one = render(*renderer, shot, "multiview_synthesis", {{"lensSamples", int64_t{256}}});
  const auto metrics = against(one.color, "dof.exr");
  report("multiview", metrics, one);
  EXPECT_GE(metrics.psnr, GetParam().multiviewFloorDb);
  const auto views =
      render(*renderer, shot, "multiview_synthesis", {{"lensSamples", int64_t{256}}, {"views", int64_t{16}}});
  const auto ofViews = against(views.color, "dof.exr");
  report("multiview_views", ofViews, views);
  EXPECT_GE(ofViews.psnr, GetParam().multiviewViewsFloorDb);
  EXPECT_GE(*ofViews.ssim, 0.985);
}

// Better than FidelityFX DoF 1.1 at half resolution (railings 26.65 dB / .897, crossing 30.13 / .956, foliage 28.49 / .943, glass 34.60 / .969,
// models_dev 35.10 / .975), and within SSIM 0.95, 0.93 with transparency.
TEST_P(Shots, MultilayerFilteringIsBetterThanThePeer) {
  const auto plain = render(*renderer, shot, "multilayer_filtering");
  const auto metrics = against(plain.color, "dof.exr");
  report("multilayer", metrics, plain);
  EXPECT_GE(metrics.psnr, GetParam().multilayerFloorDb);
  EXPECT_GE(*metrics.ssim, 0.95);
  const auto fine = render(*renderer, shot, "multilayer_filtering", {{"antialiasing", std::string("2x2")}});
  const auto ofFine = against(fine.color, "dof.exr");
  report("multilayer_fine", ofFine, fine);
  EXPECT_GE(ofFine.psnr, GetParam().multilayerFineFloorDb);
  EXPECT_GE(*ofFine.ssim, 0.97);
}

TEST_P(Shots, DepthEqualsTheRayTracedDepth) {
  host::RenderOptions options;
  options.technique = "pinhole";
  options.wantDepth = true;
  const auto depth = renderer->render(shot, options).depth;
  const auto truth = engine::readDepth(folder() / "depth.exr");
  // Edges of one pixel may fall to either side; everything else agrees to 1e-3.
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < truth.pixelCount(); ++i) {
    const double a = depth.samples[i], b = truth.samples[i];
    if (std::abs(a - b) > 1e-3 * b && !(a > 1e9 && b > 1e9)) ++wrong;
  }
  std::printf("%-11s depth differs in %.3f %% of pixels\n", GetParam().name, 100.0 * wrong / truth.pixelCount());
  EXPECT_LT(wrong, truth.pixelCount() / 50);
}

INSTANTIATE_TEST_SUITE_P(RayTraced, Shots, testing::ValuesIn(kRows),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace

}  // namespace lensgraph
