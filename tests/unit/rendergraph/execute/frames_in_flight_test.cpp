// Several frames before the device: what waits, what is shared, what lives how long.
#include <set>

#include "support/executor_support.h"

namespace lensgraph {

using namespace rendergraph;
using namespace executor_test;
using testing::Each;
using testing::HasSubstr;

namespace {

std::size_t unfinished(const FakeBackend& backend) {
  std::size_t n = 0;
  for (const auto& submitted : backend.submissions) n += !submitted.finished;
  return n;
}

constexpr Everything kOneSubmission{.host = false};

}  // namespace

TEST(FramesInFlight, SubmitWaitsOnlyForTheFrameThatManyCallsAgo) {
  FakeBackend backend;
  Executor executor(backend, {.framesInFlight = 3});
  Graph graph;
  const Buffer result = declare(graph, kOneSubmission);
  const FrameToken first = executor.submit(graph), second = executor.submit(graph), third = executor.submit(graph);
  EXPECT_EQ(unfinished(backend), 3u);
  EXPECT_FALSE(executor.isFinished(first));
  const FrameToken fourth = executor.submit(graph);
  EXPECT_EQ(unfinished(backend), 3u) << "the first had to finish";
  EXPECT_TRUE(executor.isFinished(first));
  EXPECT_EQ(misuseOf([&] { executor.mapped(result); }), Misuse::unfinishedFrame);
  executor.wait(third);
  EXPECT_TRUE(executor.isFinished(second));
  EXPECT_EQ(unfinished(backend), 1u);
  executor.wait(fourth);
  executor.wait(first);
  EXPECT_EQ(unfinished(backend), 0u);
  EXPECT_EQ(executor.mapped(result).size(), 1u << 20);
  EXPECT_EQ((std::set{first.number, second.number, third.number, fourth.number}), (std::set<uint64_t>{1, 2, 3, 4}));
  expectClean(backend);
}

TEST(FramesInFlight, AskingDoesNotWait) {
  FakeBackend backend;
  Executor executor(backend, {.framesInFlight = 2});
  Graph graph;
  declare(graph, kOneSubmission);
  const FrameToken frame = executor.submit(graph);
  EXPECT_FALSE(executor.isFinished(frame));
  backend.finishAll();
  EXPECT_TRUE(executor.isFinished(frame));
}

TEST(FramesInFlight, DeviceMemoryIsSharedAndHostMemoryIsNot) {
  FakeBackend backend;
  Executor executor(backend, {.framesInFlight = 3});
  std::set<const std::byte*> addresses;
  std::set<VkImage> images;
  for (int frame = 0; frame < 9; ++frame) {
    Graph graph;
    Image image = graph.createImage("image", kDesc);
    Buffer bytes = graph.createBuffer("bytes", {.size = 64, .memory = MemoryKind::readback});
    Pass pass = graph.addPass("pass", PassKind::compute);
    image = pass.write(image, Usage::storage);
    bytes = pass.write(bytes, Usage::storage);
    pass.record([&, image](PassContext& context) { images.insert(context.image(image)); });
    graph.exportImage(image, kSampled);
    graph.exportBuffer(bytes, kHostRead);
    const FrameToken token = executor.submit(graph);
    if (frame < 6) continue;
    executor.wait(token);
    addresses.insert(executor.mapped(bytes).data());
  }
  EXPECT_EQ(images.size(), 1u);
  EXPECT_EQ(addresses.size(), 3u);
  EXPECT_EQ(backend.countLiving("heap"), 1u);
  EXPECT_EQ(backend.countLiving("host heap"), 3u);
  expectClean(backend);
}

TEST(FramesInFlight, ExportsOfEachFrameInFlightAreFoundByTheirHandles) {
  FakeBackend backend;
  Executor executor(backend, {.framesInFlight = 2});
  Graph a, b, c;
  const Buffer ofA = declare(a, kOneSubmission), ofB = declare(b, kOneSubmission);
  declare(c, kOneSubmission);
  executor.submit(a);
  const FrameToken second = executor.submit(b);
  executor.wait(second);
  EXPECT_NE(executor.mapped(ofA).data(), executor.mapped(ofB).data());
  executor.submit(c);
  EXPECT_EQ(misuseOf([&] { executor.mapped(ofA); }), Misuse::foreignHandle);
  EXPECT_NO_THROW(executor.mapped(ofB));
}

TEST(FramesInFlight, AnotherPlansFrameIsWaitedForAltogether) {
  FakeBackend backend;
  Executor executor(backend, {.framesInFlight = 2});
  Graph wide, narrow;
  declare(wide, {.width = 64, .host = false, .history = false});
  declare(narrow, {.width = 32, .host = false, .history = false});
  executor.submit(wide);
  executor.submit(wide);
  EXPECT_EQ(backend.count("full barrier"), 0u) << "the plan itself waits for a frame of its kind";
  executor.submit(narrow);
  EXPECT_EQ(backend.count("full barrier"), 1u);
  executor.submit(narrow);
  EXPECT_EQ(backend.count("full barrier"), 1u);
  executor.submit(wide);
  EXPECT_EQ(backend.count("full barrier"), 2u);
  ASSERT_EQ(backend.memoryBarriers.size(), 2u);
  for (const VkMemoryBarrier2& barrier : backend.memoryBarriers) {
    EXPECT_EQ(barrier.srcStageMask, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
    EXPECT_EQ(barrier.dstStageMask, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
    EXPECT_NE(barrier.srcAccessMask & VK_ACCESS_2_MEMORY_WRITE_BIT, 0u);
  }
  for (const auto& submitted : backend.submissions) {
    const auto at = std::ranges::find(submitted.lines, "full barrier");
    if (at == submitted.lines.end()) continue;
    EXPECT_EQ(at - submitted.lines.begin(), 1) << "after the label, before all else";
  }
}

TEST(FramesInFlight, ZeroingOfPersistentContentComesAfterAFullBarrier) {
  FakeBackend backend;
  Executor executor(backend, {.framesInFlight = 2});
  Graph graph;
  declare(graph, kOneSubmission);
  executor.submit(graph);
  const auto clear = std::ranges::find(backend.log, "clear"), full = std::ranges::find(backend.log, "full barrier");
  ASSERT_NE(clear, backend.log.end());
  EXPECT_LT(full - backend.log.begin(), clear - backend.log.begin());
}

TEST(FramesInFlight, WithOneFrameTheHostHasWaitedAndNoBarrierIsNeeded) {
  FakeBackend backend;
  Executor executor(backend);
  Graph wide, narrow;
  declare(wide, {.width = 64});
  declare(narrow, {.width = 32});
  for (int i = 0; i < 3; ++i) {
    executor.execute(wide);
    executor.execute(narrow);
  }
  EXPECT_EQ(backend.count("full barrier"), 0u);
}

// Whatever is replaced or pushed out stays alive as long as a frame in flight uses it: the fake notes what is destroyed
// too early.
TEST(FramesInFlight, NothingIsDestroyedUnderTheDevice) {
  for (const uint32_t frames : {1u, 2u, 4u}) {
    FakeBackend backend;
    {
      Executor executor(backend, {.framesInFlight = frames});
      for (uint32_t i = 0; i < 200; ++i) {
        Graph graph;
        declare(graph, {.width = 16 + i * 7 % 64, .passes = 1 + i % 3, .host = i % 5 == 0, .history = i % 4 != 0});
        const FrameToken token = executor.submit(graph);
        if (i % 11 == 0) executor.wait(token);
      }
    }
    EXPECT_THAT(backend.living, testing::IsEmpty());
    expectClean(backend);
  }
}

TEST(FramesInFlight, NothingGrowsInASteadyState) {
  FakeBackend backend;
  Executor executor(backend, {.framesInFlight = 3});
  std::size_t living = 0;
  uint32_t creations = 0;
  for (int frame = 0; frame < 1000; ++frame) {
    Graph graph;
    declare(graph, {});
    executor.submit(graph, {.compile = {}, .timing = Timing::inlineTimestamps, .recordingThreads = 2});
    backend.submissions.clear();
    backend.log.clear();
    if (frame == 10) {
      living = backend.living.size();
      creations = backend.creations;
    }
  }
  EXPECT_EQ(backend.living.size(), living);
  EXPECT_EQ(backend.creations, creations);
}

TEST(FramesInFlight, HostFramesMayOverlapAsManyCalls) {
  FakeBackend backend;
  {
    Executor executor(backend, {.framesInFlight = 2});
    std::set<VkBuffer> uploads;
    for (int frame = 0; frame < 8; ++frame) {
      Graph graph;
      Buffer upload = graph.createBuffer("upload", {.size = 64, .memory = MemoryKind::upload});
      Image image = graph.createImage("image", kDesc);
      Pass pass = graph.addPass("pass", PassKind::compute);
      upload = pass.write(upload, Usage::storage);
      image = pass.write(image, Usage::storage);
      pass.record([&, upload](PassContext& context) { uploads.insert(context.buffer(upload)); });
      graph.exportImage(image, kSampled);
      executor.record(graph, FakeBackend::as<VkCommandBuffer>(5));
    }
    EXPECT_EQ(uploads.size(), 2u);
    EXPECT_TRUE(backend.submissions.empty());
    EXPECT_EQ(executor.plansCompiled(), 1u);
  }
  EXPECT_THAT(backend.living, testing::IsEmpty());
  expectClean(backend);
}

TEST(FramesInFlight, TimesAreThoseOfTheFrameThatWasWaitedFor) {
  FakeBackend backend;
  Executor executor(backend, {.framesInFlight = 2});
  Graph timed, other;
  declare(timed, {.passes = 2, .host = false});
  declare(other, {.passes = 5, .host = false});
  const FrameToken first = executor.submit(timed, {.compile = {}, .timing = Timing::inlineTimestamps});
  const FrameToken second = executor.submit(other);
  executor.wait(first);
  EXPECT_EQ(executor.capture().passes.size(), 5u);
  EXPECT_GT(executor.capture().frameGpuMs, 0.0);
  executor.wait(second);
  EXPECT_EQ(executor.capture().passes.size(), 8u);
  EXPECT_LT(executor.capture().frameGpuMs, 0.0);
}

TEST(FramesInFlight, OtherNumbersAreRefused) {
  FakeBackend backend;
  for (const uint32_t frames : {0u, 5u}) {
    EXPECT_EQ(misuseOf([&] { Executor(backend, {.framesInFlight = frames}); }), Misuse::overLimit);
  }
}

}  // namespace lensgraph
