// Captures and image taps on a device: times that add up, and images inside the graph.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph {

namespace {

class InspectionOnDevice : public support::GpuTest {};

host::RenderOptions optionsOf(const std::string& technique) {
  host::RenderOptions options;
  options.technique = technique;
  return options;
}

// The frame's time is read from the clock around all submissions, less the recording; the passes' times are read around
// each. What the sum lacks is the two submissions that belong to no pass. Another process may take the processor
// between two passes of one frame; a mistake in the accounting would show in all of them.
TEST_F(InspectionOnDevice, IsolatedPassesAddUpToTheFrame) {
  std::vector<std::string> warnings;
  const auto shot = host::readShot(LENSGRAPH_SOURCE_DIR "/samples/scenes/street_lights.json");
  host::Renderer renderer(support::device(), shot, warnings);
  for (const std::string technique : {"pinhole", "two_pass_filter"}) {
    SCOPED_TRACE(technique);
    auto options = optionsOf(technique);
    options.execute.timing = rendergraph::Timing::isolated;
    renderer.render(shot, options);
    double nearest = 0.0;
    for (int frame = 0; frame < 7; ++frame) {
      const auto capture = renderer.render(shot, options).capture;
      double sum = 0.0;
      for (const auto& pass : capture.passes) sum += pass.gpuMs;
      EXPECT_LE(sum, capture.frameGpuMs);
      EXPECT_LE(capture.frameGpuMs, capture.frameWallMs);
      nearest = std::max(nearest, sum / capture.frameGpuMs);
    }
    EXPECT_GE(nearest, 0.95);
  }
}

TEST_F(InspectionOnDevice, TappedImagesAreThePictureAndItsDepth) {
  host::Renderer renderer(support::device(), support::layeredScene(), std::nullopt);
  const auto shot = support::smallShot(37, 23);
  auto options = optionsOf("pinhole");
  options.wantDepth = true;
  const auto plain = renderer.render(shot, options);
  host::Tapped tapped;
  options.tapped = &tapped;
  options.taps = {{.pass = "pinhole.opaque", .resource = "pinhole.color"},
                  {.pass = "pinhole.opaque", .resource = "pinhole.depth"},
                  {.pass = "pinhole.opaque", .resource = "nothing"}};
  const auto tappedToo = renderer.render(shot, options);
  EXPECT_TRUE(tappedToo.color.samples == plain.color.samples) << "taps change nothing";
  ASSERT_EQ(tapped.pictures.size(), 3u);
  EXPECT_TRUE(tapped.pictures[0].samples == plain.color.samples);
  ASSERT_EQ(tapped.pictures[1].pixelCount(), plain.depth.pixelCount());
  const float nearPlane = tapped.pictures[1].samples[0] * plain.depth.samples[0];
  for (std::size_t i = 0; i < plain.depth.samples.size(); ++i) {
    ASSERT_NEAR(tapped.pictures[1].samples[i] * plain.depth.samples[i], nearPlane, 1e-5f * nearPlane) << i;
  }
  EXPECT_TRUE(tapped.pictures[2].isEmpty());
  EXPECT_FALSE(tapped.choices.empty());
}

// Mid-frame content: the running mean after the first of two views is that view, whatever comes later.
TEST_F(InspectionOnDevice, ATapSeesWhatLaterPassesReplace) {
  host::Renderer renderer(support::device(), support::layeredScene(), std::nullopt);
  const auto shot = support::smallShot(37, 23);
  host::Tapped tapped;
  auto options = optionsOf("accumulation");
  options.parameters = {{"lensSamples", int64_t{2}}};
  options.tapped = &tapped;
  options.taps = {{.pass = "accumulation.view0.opaque", .resource = "accumulation.view0.color"},
                  {.pass = "accumulation.view0.accumulate", .resource = "accumulation.mean"},
                  {.pass = "accumulation.view1.accumulate", .resource = "accumulation.mean"}};
  const auto rendering = renderer.render(shot, options);
  EXPECT_EQ(rendering.executions, 1u);
  ASSERT_EQ(tapped.pictures.size(), 3u);
  const auto& first = tapped.pictures[0].samples;
  for (std::size_t i = 0; i < first.size(); ++i) ASSERT_NEAR(tapped.pictures[1].samples[i], first[i], 1e-5f) << i;
  EXPECT_FALSE(tapped.pictures[1].samples == tapped.pictures[2].samples);
}

}  // namespace

}  // namespace lensgraph
