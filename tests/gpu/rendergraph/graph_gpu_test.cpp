// The executor on the real backend: what must not change a picture, and what must live on between frames.
#include <gmock/gmock.h>

#include <cstring>

#include "engine/graph/graph_backend.h"
#include "passes/registry/registry.h"
#include "rendergraph/executor.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/test_scenes.h"

namespace lensgraph {

namespace {

using rendergraph::Timing;
using rendergraph::Usage;

/// Layers, a pane to blend, and a bright spot: every pass of every technique has work.
engine::Scene busyScene() {
  auto scene = support::layeredScene();
  support::addFacingQuad(scene, 1.2, 0.2, 0.0, 0.1, 0.3, support::addMaterial(scene, {0.1f, 0.9f, 0.2f, 0.4f}));
  return scene;
}

host::Rendering renderWith(host::Renderer& renderer, const std::string& technique,
                           const rendergraph::ExecuteOptions& execute) {
  host::RenderOptions options;
  options.technique = technique;
  options.execute = execute;
  options.wantDepth = true;
  if (technique == "accumulation") options.parameters = {{"lensSamples", int64_t{6}}, {"viewsPerFrame", int64_t{4}}};
  if (technique == "pinhole") options.parameters = {{"pixelSamples", int64_t{6}}, {"viewsPerFrame", int64_t{4}}};
  return renderer.render(support::smallShot(97, 61), options);
}

std::vector<std::string> techniqueNames() {
  std::vector<std::string> names;
  for (const auto& technique : passes::techniques()) names.emplace_back(technique.name);
  return names;
}

class GraphOnDevice : public support::GpuTest {};
class EveryTechnique : public GraphOnDevice, public testing::WithParamInterface<std::string> {};

// Memory that is shared wrongly shows here: with aliasing off nothing is shared.
TEST_P(EveryTechnique, GivesTheSamePictureWithAndWithoutAliasingInEveryOrder) {
  using rendergraph::Aliasing;
  using rendergraph::Order;
  host::Renderer renderer(support::device(), busyScene(), std::nullopt);
  const auto plain = renderWith(renderer, GetParam(), {.compile = {.aliasing = Aliasing::none}});
  EXPECT_EQ(plain.capture.memory.peakBytes, plain.capture.memory.unaliasedBytes);
  for (const Order order : {Order::declared, Order::leastMemory, Order::mostOverlap, Order::fewestBatches}) {
    const auto shared = renderWith(renderer, GetParam(), {.compile = {.order = order, .aliasing = Aliasing::best}});
    EXPECT_LE(shared.capture.memory.peakBytes, plain.capture.memory.peakBytes);
    EXPECT_TRUE(shared.color.samples == plain.color.samples) << static_cast<int>(order);
    EXPECT_TRUE(shared.depth.samples == plain.depth.samples) << static_cast<int>(order);
  }
}

TEST_P(EveryTechnique, GivesTheSamePictureHoweverItIsTimed) {
  host::Renderer renderer(support::device(), busyScene(), std::nullopt);
  const auto untimed = renderWith(renderer, GetParam(), {});
  const auto stamped = renderWith(renderer, GetParam(), {.compile = {}, .timing = Timing::inlineTimestamps});
  const auto isolated = renderWith(renderer, GetParam(), {.compile = {}, .timing = Timing::isolated});
  EXPECT_TRUE(stamped.color.samples == untimed.color.samples);
  EXPECT_TRUE(isolated.color.samples == untimed.color.samples);
  EXPECT_EQ(stamped.estimatedError, untimed.estimatedError);
  EXPECT_EQ(isolated.estimatedError, untimed.estimatedError);
  EXPECT_LT(untimed.capture.frameGpuMs, 0.0);
  EXPECT_GT(stamped.capture.frameGpuMs, 0.0);
  EXPECT_GT(isolated.capture.frameGpuMs, 0.0);
  for (const auto& pass : isolated.capture.passes) EXPECT_GE(pass.gpuMs, 0.0) << pass.name;
}

INSTANTIATE_TEST_SUITE_P(Every, EveryTechnique, testing::ValuesIn(techniqueNames()),
                         [](const auto& info) { return info.param; });

TEST_F(GraphOnDevice, TwoDevicesServeTheirGraphsSideBySide) {
  const auto scene = busyScene();
  host::Renderer first(support::device(), scene, std::nullopt);
  const auto before = renderWith(first, "accumulation", {});
  std::shared_ptr<engine::ValidationLog> log;
  {
    engine::Device another({.select = "", .validation = true});
    log = another.validationLog();
    host::Renderer second(another, scene, std::nullopt);
    EXPECT_TRUE(renderWith(second, "accumulation", {}).color.samples == before.color.samples);
    EXPECT_TRUE(renderWith(first, "accumulation", {}).color.samples == before.color.samples);
    EXPECT_TRUE(renderWith(second, "two_pass_filter", {}).color.samples ==
                renderWith(first, "two_pass_filter", {}).color.samples);
  }
  EXPECT_THAT(log->messages, testing::IsEmpty()) << "of the second device, its end included";
  EXPECT_TRUE(renderWith(first, "accumulation", {}).color.samples == before.color.samples) << "after its end";
}

// ---- What lives on between frames

/// Copies the image to the host and returns it; `clearTo` then replaces its content on the device.
class PersistentFrames {
 public:
  std::vector<float> run(const rendergraph::ImageDesc& desc, float clearTo) {
    rendergraph::Graph graph;
    auto kept = graph.persistentImage("kept", desc);
    const VkDeviceSize size = VkDeviceSize{desc.width} * desc.height * sizeof(float);
    auto bytes = graph.createBuffer("bytes", {.size = size, .memory = rendergraph::MemoryKind::readback});
    auto read = graph.addPass("read", rendergraph::PassKind::transfer);
    read.read(kept, Usage::transferSource);
    bytes = read.write(bytes, Usage::transferDestination);
    read.record([=](rendergraph::PassContext& context) { context.copyImageToBuffer(kept, bytes); });
    auto clear = graph.addPass("clear", rendergraph::PassKind::transfer);
    kept = clear.write(kept, Usage::transferDestination);
    clear.record([=](rendergraph::PassContext& context) { context.clearImage(kept, {.float32 = {clearTo}}); });
    graph.exportBuffer(bytes, {.stages = VK_PIPELINE_STAGE_2_HOST_BIT, .access = VK_ACCESS_2_HOST_READ_BIT});
    executor_.execute(graph);
    std::vector<float> values(size / sizeof(float));
    std::memcpy(values.data(), executor_.mapped(bytes).data(), size);
    return values;
  }
  void clear() { executor_.clear(); }

 private:
  engine::GraphBackend backend_{support::device()};
  rendergraph::Executor executor_{backend_};
};

TEST_F(GraphOnDevice, APersistentImageIsZeroAtFirstAndLivesOn) {
  using testing::Each;
  const rendergraph::ImageDesc desc{.format = VK_FORMAT_R32_SFLOAT, .width = 37, .height = 19};
  PersistentFrames frames;
  EXPECT_THAT(frames.run(desc, 2.5f), Each(0.0f));
  EXPECT_THAT(frames.run(desc, -7.0f), Each(2.5f));
  EXPECT_THAT(frames.run(desc, 1.0f), Each(-7.0f));
  // Another description makes it anew; so does clear().
  const rendergraph::ImageDesc larger{.format = VK_FORMAT_R32_SFLOAT, .width = 64, .height = 64};
  EXPECT_THAT(frames.run(larger, 3.0f), Each(0.0f));
  EXPECT_THAT(frames.run(larger, 4.0f), Each(3.0f));
  frames.clear();
  EXPECT_THAT(frames.run(larger, 4.0f), Each(0.0f));
  // Executors do not share.
  PersistentFrames others;
  EXPECT_THAT(others.run(larger, 9.0f), Each(0.0f));
  EXPECT_THAT(frames.run(larger, 4.0f), Each(4.0f));
}

}  // namespace

}  // namespace lensgraph
