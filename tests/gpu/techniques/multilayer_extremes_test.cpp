// The multi-layer filtering at its extremes: room, blur, focus, counts, time.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "engine/metrics/metrics.h"
#include "multilayer_filtering_fixture.h"
#include "tests/support/gpu/spot.h"

namespace lensgraph {

namespace {

using namespace multilayer_test;

// A focus pull from before everything to behind everything: neighbouring frames change evenly, although levels come and go.
TEST_F(MultilayerFiltering, FocusPullsDoNotPop) {
  host::Renderer renderer(support::device(), support::layeredScene(), std::nullopt);
  auto shot = support::smallShot(96, 54);
  shot.lens.apertureRadius = 0.05;
  const auto largest = [&](const char* technique, const ParameterSet& parameters) {
    std::vector<engine::FloatImage> frames;
    double change = 0.0;
    for (int step = 0; step < 60; ++step) {
      shot.lens.focusDistance = 1.0 / (1.6 - 1.55 * step / 59.0);
      frames.push_back(render(renderer, shot, technique, parameters).color);
      if (frames.size() < 3) continue;
      for (std::size_t i = 0; i < frames[0].samples.size(); ++i) {
        const auto at = [&](std::size_t frame) { return std::min(double(frames[frame].samples[i]), 1.0); };
        change = std::max(change, std::abs(at(2) - 2.0 * at(1) + at(0)));
      }
      frames.erase(frames.begin());
    }
    return change;
  };
  const double reference = largest("accumulation", {{"lensSamples", int64_t{64}}, {"viewsPerFrame", int64_t{64}}});
  const double blended = largest(kName, {}), stepped = largest(kName, {{"interpolateLevels", false}});
  std::printf("focus pull, largest second difference: %.3f, without interpolation %.3f, accumulation %.3f\n", blended,
              stepped, reference);
  EXPECT_LE(blended, 0.25);
  EXPECT_LE(blended, reference);
  EXPECT_GE(stepped, 0.6);
}

TEST_F(MultilayerFiltering, TheLensesLimitOfBlurIsKeptAndCounted) {
  auto shot = support::smallShot(96, 96);
  shot.lens.apertureRadius = 0.5;
  shot.lens.maxCocRadius = 5.0 / 96.0;
  const auto limited =
      rendering(support::lightScene(6.0, 4.0, support::pixelsPerTangent(shot)), shot, {{"mipSteps", int64_t{0}}});
  const auto spot = support::measureSpot(limited.color);
  EXPECT_NEAR(std::sqrt(spot.varianceX), std::sqrt(0.25 * 25.0 + 16.0 / 12.0), 0.1);
  EXPECT_EQ(limited.statistics.clampedCoc, 16u);
  shot.lens.maxCocRadius = 0.0;
  const auto free =
      rendering(support::lightScene(6.0, 4.0, support::pixelsPerTangent(shot)), shot, {{"mipSteps", int64_t{0}}});
  EXPECT_GT(support::measureSpot(free.color).varianceX, 2.0 * spot.varianceX);
  EXPECT_EQ(free.statistics.clampedCoc, 0u);
}

// Room for a hundredth of what there is: every pixel keeps its nearest surface, what is missing is counted, and the next
// frame has room for all.
TEST_F(MultilayerFiltering, TooLittleRoomKeepsTheNearest) {
  host::Renderer renderer(support::device(), support::layeredScene(), std::nullopt);
  const auto shot = support::smallShot(160, 90);
  host::RenderOptions options;
  options.technique = kName;
  const auto whole = renderer.render(shot, options);
  const double pixels = 160.0 * 90.0;
  const auto nodes = static_cast<float>(whole.statistics.fragmentNodes / pixels);

  options.fixedRoom = host::ListRoom{.fragmentNodes = 0.01f * nodes, .listFragments = 9.0f};
  const auto few = renderer.render(shot, options);
  EXPECT_EQ(few.statistics.fragmentNodes, whole.statistics.fragmentNodes);
  EXPECT_GT(few.statistics.fragmentNodesDropped, whole.statistics.fragmentNodes * 9u / 10u);
  EXPECT_EQ(support::nonFiniteCount(few.color), 0u);
  // Only what is hidden is missing: that is all of the technique with lists of one fragment.
  options.fixedRoom.reset();
  options.parameters = {{"listLength", int64_t{1}}};
  const auto nearest = renderer.render(shot, options);
  support::keepPicture(few.color, "multilayer_few_nodes");
  EXPECT_GE(engine::compareImages(few.color, nearest.color).psnr, 30.0);

  options.parameters = {};
  options.fixedRoom = host::ListRoom{
      .fragmentNodes = 9.0f, .listFragments = 0.01f * static_cast<float>(whole.statistics.listFragments / pixels)};
  const auto dropped = renderer.render(shot, options);
  EXPECT_EQ(support::nonFiniteCount(dropped.color), 0u);
  EXPECT_GT(dropped.statistics.listFragmentsDropped, 0u);

  options.fixedRoom = host::ListRoom{.fragmentNodes = 0.01f * nodes, .listFragments = 0.05f};
  (void)renderer.render(shot, options);
  options.fixedRoom.reset();
  EXPECT_TRUE(renderer.render(shot, options).color.samples == whole.color.samples);
}

struct Extreme {
  const char* what;
  int width = 48, height = 27;
  double aperture = 0.05, focus = 2.0;
  ParameterSet parameters = {};
};

TEST_F(MultilayerFiltering, ExtremesStayFiniteAndConstant) {
  const std::vector<Extreme> extremes = {
      {"one pixel", 1, 1},
      {"a row", 67, 1},
      {"a column", 1, 67},
      {"prime sizes", 101, 53},
      {"tiny aperture", 48, 27, 1e-6},
      {"focus close by", 48, 27, 0.05, 1e-3},
      {"focus at the near plane", 48, 27, 0.001, 0.01},
      {"focus at infinity", 48, 27, 0.05, std::numeric_limits<double>::infinity()},
      {"focus far away", 48, 27, 0.05, 1e7},
      {"blur as wide as the picture", 48, 27, 0.7},
      {"blur of four times the picture's width", 48, 27, 3.0},
      {"that, mip steps only", 48, 27, 3.0, 2.0, {{"mipSteps", int64_t{13}}}},
      {"that, many stack steps", 24, 13, 3.0, 2.0, {{"mipSteps", int64_t{0}}, {"stackSteps", int64_t{10}}}},
      {"one level", 48, 27, 0.2, 2.0, {{"mipSteps", int64_t{0}}, {"stackSteps", int64_t{0}}}},
      {"one fragment", 48, 27, 0.2, 2.0, {{"listLength", int64_t{1}}}},
      {"16 fragments", 48, 27, 0.2, 2.0, {{"listLength", int64_t{16}}}},
      {"nothing merged", 48, 27, 0.2, 2.0, {{"epsilon", 0.0}, {"linkDistance", 0.0}}},
      {"all merged", 48, 27, 0.2, 2.0, {{"epsilon", 4.0}, {"linkDistance", 4.0}}},
      {"finer pixels", 48, 27, 0.2, 2.0, {{"antialiasing", std::string("4x4")}}},
  };
  host::Renderer renderer(support::device(), support::constantScene(kColor), std::nullopt);
  for (const Extreme& extreme : extremes) {
    auto shot = support::smallShot(extreme.width, extreme.height);
    shot.background = {kColor.x, kColor.y, kColor.z};
    shot.lens.apertureRadius = extreme.aperture;
    shot.lens.focusDistance = extreme.focus;
    const auto image = render(renderer, shot, kName, extreme.parameters).color;
    EXPECT_EQ(support::nonFiniteCount(image), 0u) << extreme.what;
    EXPECT_LE(distanceFrom(image, kColor), 1e-3) << extreme.what;
  }
}

// Rings of large blurs reach over many cells: tiles find out what they show within what devices let loops do.
TEST_F(MultilayerFiltering, WideBlursInLargePicturesAreShown) {
  engine::Scene scene;
  support::addFacingQuad(scene, 0.5, 0.0, 0.0, 0.004, 9.0, support::addMaterial(scene, {9.0f, 0.0f, 0.0f, 1.0f}));
  for (int i = 0; i < 6; ++i) {
    support::addFacingQuad(scene, 0.6 + 0.02 * i, 0.0, 0.0, 9.0, 9.0,
                           support::addMaterial(scene, {0.2f, 0.3f, 0.4f, 0.2f}));
  }
  support::addFacingQuad(scene, 8.0, 0.0, 0.0, 30.0, 30.0, support::addMaterial(scene, {0.2f, 0.3f, 0.4f, 1.0f}));
  auto shot = support::smallShot(640, 360);
  shot.lens.apertureRadius = 0.12;  // |c| up to 89 px
  host::Renderer renderer(support::device(), scene, std::nullopt);
  const auto image = render(renderer, shot, kName, {{"listLength", int64_t{16}}}).color;
  support::keepPicture(image, "multilayer_wide");
  const double width = 0.016 * support::pixelsPerTangent(shot);  // px, of the bar, whose blur takes its light along
  double light = 0.0;
  for (uint32_t x = 0; x < image.width; ++x) light += double(image.pixel(x, 180)[0]) - 0.2;
  EXPECT_NEAR(light, width * (9.0 - 0.2), 0.03 * width * 9.0);
}

// A thousand surfaces behind one pixel.
TEST_F(MultilayerFiltering, LongListsKeepTheNearest) {
  engine::Scene scene;
  const uint32_t front = support::addMaterial(scene, {kColor, 1.0f}), rest = support::addMaterial(scene, {0, 9, 0, 1});
  for (int i = 0; i < 1000; ++i)
    support::addFacingQuad(scene, 1.5 + 0.01 * i, 0.0, 0.0, 20.0, 20.0, i == 0 ? front : rest);
  const auto shot = support::smallShot(24, 14);
  for (const int64_t length : {1, 4, 16}) {
    const auto frame = rendering(scene, shot, {{"listLength", length}});
    EXPECT_LE(distanceFrom(frame.color, kColor), 1e-3) << length;
    EXPECT_EQ(frame.statistics.unsortedLists, 0u);
  }
}

TEST_F(MultilayerFiltering, AnEmptySceneIsItsBackground) {
  auto shot = support::smallShot(32, 18);
  shot.background = {kColor.x, kColor.y, kColor.z};
  EXPECT_LE(distanceFrom(picture({}, shot), kColor), 1e-6);
}

}  // namespace

}  // namespace lensgraph
