// The executor against a backend that writes down what it is asked for.
#include "rendergraph/executor.h"

#include <chrono>
#include <stdexcept>
#include <thread>

#include "support/executor_support.h"

namespace lensgraph {

using namespace executor_test;
using namespace rendergraph;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Executor, RecordsInOrderAndSubmitsOnce) {
  FakeBackend backend;
  {
    Executor executor(backend);
    Graph graph;
    declareChain(graph, 7.0f);
    executor.execute(graph);
    EXPECT_THAT(backend.log,
                ElementsAre("begin", "label draw", "barrier", "rendering 64x32 layers 1 clear 7", "draw raster",
                            "end rendering", "label blur", "barrier", "dispatch program", "barrier", "submit"));
    ASSERT_EQ(backend.bindings.size(), 2u);
    EXPECT_EQ(backend.bindings[0].layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    EXPECT_EQ(backend.bindings[1].layout, VK_IMAGE_LAYOUT_GENERAL);
  }
  EXPECT_THAT(backend.living, IsEmpty());
  expectClean(backend);
}

TEST(Executor, ReusesPlanAndObjectsWhenOnlyValuesChange) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  declareChain(graph, 1.0f);
  executor.execute(graph);
  const uint32_t creations = backend.creations;
  graph.reset();
  declareChain(graph, 2.0f);
  executor.execute(graph);
  EXPECT_EQ(backend.creations, creations);
  EXPECT_EQ(executor.plansCompiled(), 1u);
  EXPECT_EQ(executor.plansReused(), 1u);
  EXPECT_TRUE(executor.capture().planReused);
  EXPECT_EQ(backend.count("rendering 64x32 layers 1 clear 2"), 1u);  // The new clear value, the old plan.
}

TEST(Executor, AlternatingGraphsKeepTheirPlansAndShareMemory) {
  FakeBackend backend;
  Executor executor(backend);
  for (int frame = 0; frame < 10; ++frame) {
    Graph graph;
    declareChain(graph, 1.0f, frame % 2 == 0 ? 64 : 32);
    executor.execute(graph);
  }
  EXPECT_EQ(executor.plansCompiled(), 2u);
  EXPECT_EQ(executor.plansReused(), 8u);
  std::size_t heaps = 0;
  for (const auto& [id, what] : backend.living) heaps += what == "heap";
  EXPECT_EQ(heaps, 1u);
}

TEST(Executor, ManyReconfigurationsDoNotPileUpObjects) {
  FakeBackend backend;
  Executor executor(backend);
  for (uint32_t frame = 0; frame < 1000; ++frame) {
    Graph graph;
    declareChain(graph, 1.0f, 16 + frame);
    executor.execute(graph);
    // Three plans keep their objects: a heap, two images, three views each.
    ASSERT_LE(backend.living.size(), 18u) << "frame " << frame;
  }
  expectClean(backend);
}

TEST(Executor, PersistentImageIsZeroedOnceAndWhenItsDescriptionChanges) {
  FakeBackend backend;
  Executor executor(backend);
  const auto frame = [&](uint32_t width) {
    Graph graph;
    ImageDesc desc = kDesc;
    desc.width = width;
    Image sum = graph.persistentImage("sum", desc);
    Pass add = graph.addPass("add", PassKind::compute);
    sum = add.modify(sum, Usage::storage);
    executor.execute(graph);
  };
  frame(64);
  EXPECT_EQ(backend.count("clear"), 1u);
  frame(64);
  frame(64);
  EXPECT_EQ(backend.count("clear"), 1u);
  frame(32);
  EXPECT_EQ(backend.count("clear"), 2u);
  expectClean(backend);
}

TEST(Executor, PersistentDepthAndBufferAreZeroedTheirWay) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  Image depth = graph.persistentImage("depth", {.format = VK_FORMAT_D32_SFLOAT, .width = 8, .height = 8});
  Buffer counter = graph.persistentBuffer("counter", {.size = 64});
  Pass pass = graph.addPass("pass", PassKind::raster);
  depth = pass.depth(depth, {.load = LoadOp::load});
  counter = pass.modify(counter, Usage::storage);
  executor.execute(graph);
  EXPECT_EQ(backend.count("clear depth"), 1u);
  EXPECT_EQ(backend.count("fill 0"), 1u);
}

TEST(Executor, HistorySwapsItsSidesEveryFrameThatWritesIt) {
  FakeBackend backend;
  Executor executor(backend);
  VkImage previous = VK_NULL_HANDLE, next = VK_NULL_HANDLE;
  const auto frame = [&](bool write) {
    Graph graph;
    const History history = graph.history("color", kDesc);
    Pass pass = graph.addPass("resolve", PassKind::compute);
    pass.sample(history.previous);
    pass.sideEffect();
    Image result = history.next;
    if (write) result = pass.write(result, Usage::storage);
    pass.record([&, result, write](PassContext& context) {
      previous = context.image(history.previous);
      next = write ? context.image(result) : VK_NULL_HANDLE;
    });
    executor.execute(graph);
  };
  frame(true);
  const VkImage a = previous, b = next;
  EXPECT_NE(a, b);
  frame(true);
  EXPECT_EQ(previous, b);
  EXPECT_EQ(next, a);
  frame(false);
  EXPECT_EQ(previous, a);
  frame(false);  // Nothing was written, so last frame's content is still last frame's.
  EXPECT_EQ(previous, a);
  EXPECT_EQ(backend.count("clear"), 2u);
}

TEST(Executor, ThrowingRecordingSubmitsNothingAndLeavesTheExecutorUsable) {
  FakeBackend backend;
  Executor executor(backend);
  const auto declare = [](Graph& graph, bool fail) {
    Image sum = graph.persistentImage("sum", kDesc);
    Pass pass = graph.addPass("pass", PassKind::compute);
    sum = pass.modify(sum, Usage::storage);
    pass.record([fail](PassContext&) {
      if (fail) throw std::runtime_error("recording failed");
    });
  };
  Graph bad;
  declare(bad, true);
  EXPECT_THROW(executor.execute(bad), std::runtime_error);
  EXPECT_EQ(backend.count("submit"), 0u);
  Graph good;
  declare(good, false);
  executor.execute(good);
  EXPECT_EQ(backend.count("submit"), 1u);
  EXPECT_EQ(backend.count("clear"), 1u);  // The zeroing recorded with the failed frame never ran.
  EXPECT_EQ(executor.plansCompiled(), 1u);
  executor.execute(good);
  EXPECT_EQ(backend.count("clear"), 1u);
}

TEST(Executor, AFailedWaitZeroesPersistentContentAgain) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  Image sum = graph.persistentImage("sum", kDesc);
  Pass pass = graph.addPass("pass", PassKind::compute);
  sum = pass.modify(sum, Usage::storage);
  executor.execute(graph);
  backend.failSubmit = true;
  EXPECT_EQ(misuseOf([&] { executor.execute(graph); }), Misuse::device);
  backend.failSubmit = false;
  executor.execute(graph);
  EXPECT_EQ(backend.count("clear"), 1u) << "nothing was submitted, so the content is what it was";
  backend.failWait = true;
  EXPECT_EQ(misuseOf([&] { executor.execute(graph); }), Misuse::device);
  backend.failWait = false;
  executor.execute(graph);
  EXPECT_EQ(backend.count("clear"), 2u) << "nobody knows what became of it";
}

TEST(Executor, EveryFailingAllocationIsAnErrorWithoutLeak) {
  int failing = 0;
  for (;; ++failing) {
    FakeBackend backend;
    backend.failAfter = failing;
    bool threw = false;
    {
      Executor executor(backend);
      Graph graph;
      declareChain(graph);
      Buffer counter = graph.persistentBuffer("counter", {.size = 64});
      const History history = graph.history("past", kDesc);
      Pass pass = graph.addPass("pass", PassKind::compute);
      pass.sample(history.previous);
      [[maybe_unused]] const Image next = pass.write(history.next, Usage::storage);
      counter = pass.modify(counter, Usage::storage);
      try {
        executor.execute(graph);
      } catch (const GraphError& error) {
        threw = true;
        EXPECT_EQ(error.misuse(), Misuse::device);
        EXPECT_EQ(backend.count("submit"), 0u);
      }
      backend.failAfter = -1;
      executor.execute(graph);  // With memory again, the same executor goes on.
      EXPECT_EQ(backend.count("submit"), 1u + !threw);
    }
    EXPECT_THAT(backend.living, IsEmpty()) << "allocation " << failing;
    expectClean(backend);
    if (!threw) break;
  }
  EXPECT_GT(failing, 8);
}

TEST(Executor, AFailedAllocationNamesTheResource) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  Image sum = graph.persistentImage("sum", kDesc);
  Pass pass = graph.addPass("pass", PassKind::compute);
  sum = pass.modify(sum, Usage::storage);
  backend.failAfter = 1;
  std::string text;
  misuseOf([&] { executor.execute(graph); }, &text);
  EXPECT_THAT(text, HasSubstr("'sum'"));
}

TEST(Executor, ImportedImageMayChangeEveryFrame) {
  FakeBackend backend;
  Executor executor(backend);
  for (uint64_t handle : {11, 12, 11}) {
    Graph graph;
    Image target = graph.importImage("target", kDesc,
                                     {.image = FakeBackend::as<VkImage>(handle),
                                      .usage = VK_IMAGE_USAGE_STORAGE_BIT,
                                      .before = {},
                                      .after = kSampled});
    Pass pass = graph.addPass("pass", PassKind::compute);
    target = pass.write(target, Usage::storage);
    pass.record([=](PassContext& context) {
      const Binding bindings[] = {storage(target)};
      context.dispatch({.program = kCompute, .bindings = bindings, .groups = {}});
    });
    executor.execute(graph);
    const uint64_t view = FakeBackend::idOf(backend.bindings[0].view);
    EXPECT_EQ(backend.viewed[view], handle);
    EXPECT_EQ(backend.living.count(view), 0u);  // The host may destroy the image now.
    EXPECT_EQ(FakeBackend::idOf(backend.imageBarriers.back().image), handle);
    EXPECT_EQ(backend.imageBarriers.back().newLayout, kSampled.layout);
  }
  EXPECT_EQ(executor.plansCompiled(), 1u);
}

TEST(Executor, ExportsAreLookedUpByHandleUntilTheNextExecution) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  const Chain chain = declareChain(graph);
  executor.execute(graph);
  EXPECT_NE(executor.exportedImage(chain.result), VkImage(VK_NULL_HANDLE));
  EXPECT_EQ(misuseOf([&] { executor.exportedImage(chain.half); }), Misuse::importState);
  EXPECT_EQ(misuseOf([&] { executor.exportedImage({}); }), Misuse::unknownHandle);
  Graph other;
  declareChain(other);
  executor.execute(other);
  EXPECT_EQ(misuseOf([&] { executor.exportedImage(chain.result); }), Misuse::foreignHandle);
}

TEST(Executor, HostPassesRunBetweenSubmissionsAndReachTheirBuffers) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  Buffer in = graph.createBuffer("in", {.size = 16, .memory = MemoryKind::upload});
  Buffer out = graph.createBuffer("out", {.size = 16, .memory = MemoryKind::readback});
  Pass fill = graph.addPass("fill", PassKind::host);
  in = fill.write(in, Usage::host);
  fill.record([&, in](PassContext& context) {
    backend.log.push_back("host");
    ASSERT_EQ(context.mapped(in).size(), 16u);
    context.mapped(in)[0] = std::byte{42};
    EXPECT_EQ(context.commandBuffer(), VkCommandBuffer(VK_NULL_HANDLE));
  });
  Pass copy = graph.addPass("copy", PassKind::transfer);
  copy.read(in, Usage::transferSource);
  out = copy.write(out, Usage::transferDestination);
  copy.record([=](PassContext& context) { context.copyBuffer(in, out, 16); });
  graph.exportBuffer(out, {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
  executor.execute(graph);
  // The submission itself makes visible what the host wrote.
  EXPECT_THAT(backend.log, ElementsAre("host", "begin", "label copy", "copy buffer 16", "barrier", "submit"));
  EXPECT_EQ(executor.mapped(out).size(), 16u);
  EXPECT_EQ(misuseOf([&] { executor.record(graph, VK_NULL_HANDLE); }), Misuse::undeclaredAccess);
}

TEST(Executor, UpdatesABufferWithBytesOfTheRecording) {
  FakeBackend backend;
  Executor executor(backend);
  const auto update = [&](std::size_t byteCount) {
    Graph graph;
    Buffer table = graph.createBuffer("table", {.size = 70000});
    Pass pass = graph.addPass("upload", PassKind::transfer);
    table = pass.write(table, Usage::transferDestination);
    pass.record([=](PassContext& context) {
      const std::vector<std::byte> bytes(byteCount);
      context.updateBuffer(table, bytes);
    });
    graph.exportBuffer(table, {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_READ_BIT});
    executor.execute(graph);
  };
  update(48);
  EXPECT_EQ(backend.count("update 0+48"), 1u);
  update(70000);  // more than one command takes
  EXPECT_EQ(backend.count("update 0+65536"), 1u);
  EXPECT_EQ(backend.count("update 65536+4464"), 1u);
  for (const std::size_t bad : {0u, 6u, 70004u}) {
    EXPECT_EQ(misuseOf([&] { update(bad); }), Misuse::sizeMismatch) << bad;
  }
}

TEST(Executor, FillsABufferWholeOrItsStart) {
  FakeBackend backend;
  Executor executor(backend);
  const auto fill = [&](VkDeviceSize bytes) {
    Graph graph;
    Buffer table = graph.createBuffer("table", {.size = 64});
    Pass pass = graph.addPass("fill", PassKind::transfer);
    table = pass.write(table, Usage::transferDestination);
    pass.record([=](PassContext& context) { context.fillBuffer(table, 7, bytes); });
    graph.exportBuffer(table, {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_READ_BIT});
    executor.execute(graph);
  };
  fill(VK_WHOLE_SIZE);
  fill(32);
  EXPECT_EQ(backend.count("fill 7 x32"), 1u);
  for (const VkDeviceSize bad : {0u, 6u, 68u}) {
    EXPECT_EQ(misuseOf([&] { fill(bad); }), Misuse::sizeMismatch) << bad;
  }
}

TEST(Executor, RecordsIntoTheHostsCommandBufferWithoutSubmitting) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  declareChain(graph);
  executor.record(graph, FakeBackend::as<VkCommandBuffer>(5));
  EXPECT_EQ(backend.count("begin") + backend.count("submit"), 0u);
  EXPECT_EQ(backend.count("dispatch program"), 1u);
}

TEST(Executor, TimingModes) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  declareChain(graph);
  executor.execute(graph, {.compile = {}, .timing = Timing::none});
  EXPECT_LT(executor.capture().passes[0].gpuMs, 0.0);
  EXPECT_EQ(backend.count("timestamp 0"), 0u);
  executor.execute(graph, {.compile = {}, .timing = Timing::inlineTimestamps});
  ASSERT_EQ(executor.capture().passes.size(), 2u);
  EXPECT_DOUBLE_EQ(executor.capture().passes[0].gpuMs, 1.0);  // The fake clock reads 0, 1, 4, 9 ms.
  EXPECT_DOUBLE_EQ(executor.capture().passes[1].gpuMs, 5.0);
  EXPECT_DOUBLE_EQ(executor.capture().frameGpuMs, 9.0);
  backend.log.clear();
  executor.execute(graph, {.compile = {}, .timing = Timing::isolated});
  EXPECT_EQ(backend.count("submit"), 3u);  // Two passes, after.
  const Capture& capture = executor.capture();
  EXPECT_GE(capture.passes[0].gpuMs, 0.0);
  EXPECT_GE(capture.frameGpuMs, capture.passes[0].gpuMs + capture.passes[1].gpuMs);
  EXPECT_EQ(capture.timing, "isolated");
  EXPECT_EQ(executor.plansCompiled(), 2u);  // The isolated one merges no raster passes.
}

TEST(Executor, IsolatedFrameTimeIsTheSubmissionsAndNotTheRecording) {
  FakeBackend backend;
  backend.submitMs = 5;
  Executor executor(backend);
  Graph graph;
  Image image = graph.createImage("image", kDesc);
  Pass slow = graph.addPass("slow to record", PassKind::compute);
  image = slow.write(image, Usage::storage);
  slow.record([](PassContext&) { std::this_thread::sleep_for(std::chrono::milliseconds(40)); });
  graph.exportImage(image, kSampled);
  executor.execute(graph, {.compile = {}, .timing = Timing::isolated});
  const Capture& capture = executor.capture();
  const CapturedPass& pass = capture.passes[0];
  EXPECT_GE(pass.recordMs, 40.0);
  EXPECT_GE(pass.gpuMs, 5.0);
  EXPECT_LT(pass.gpuMs, 40.0);
  EXPECT_GE(pass.gpuStartMs, pass.recordStartMs + pass.recordMs);
  EXPECT_GE(capture.frameGpuMs, 10.0) << "two submissions";
  EXPECT_LT(capture.frameGpuMs, 10.0 + 40.0) << "without the recording";
  EXPECT_GE(capture.frameWallMs, 10.0 + 40.0);
}

TEST(Executor, TimesInACaptureCountFromTheFramesBeginning) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  declareChain(graph);
  executor.execute(graph, {.compile = {}, .timing = Timing::inlineTimestamps});
  const auto& passes = executor.capture().passes;
  EXPECT_GE(passes[0].recordStartMs, 0.0);
  EXPECT_GE(passes[1].recordStartMs, passes[0].recordStartMs + passes[0].recordMs);
  EXPECT_GE(passes[0].gpuStartMs, passes[1].recordStartMs + passes[1].recordMs) << "submitted when all is recorded";
  EXPECT_DOUBLE_EQ(passes[1].gpuStartMs - passes[0].gpuStartMs, 4.0) << "the fake clock reads 0, 1, 4, 9 ms";
}

TEST(Executor, CaptureCountsBytesOfDeclaredRanges) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  declareChain(graph);
  executor.execute(graph);
  const CapturedPass& blur = executor.capture().passes[1];
  EXPECT_EQ(blur.name, "blur");
  EXPECT_EQ(blur.bytesRead, 64u * 32 * 8);
  EXPECT_EQ(blur.bytesWritten, 64u * 32 * 8);
  EXPECT_EQ(blur.imageBarriers, 2u);
  EXPECT_EQ(blur.resolution.width, 64u);
}

TEST(Executor, SampledAndStorageInOnePassAreBoundInGeneral) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  ImageDesc desc = kDesc;
  desc.mips = 2;
  Image image = graph.persistentImage("image", desc);
  Pass pass = graph.addPass("pass", PassKind::compute);
  pass.sample(image);
  const Image read = image;
  image = pass.write(image, Usage::storage, mip(1));
  pass.record([=](PassContext& context) {
    const Binding bindings[] = {sampled(read), storage(image, mip(1))};
    context.dispatch({.program = kCompute, .bindings = bindings, .groups = {}});
  });
  executor.execute(graph);
  EXPECT_EQ(backend.bindings[0].layout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_EQ(backend.bindings[1].layout, VK_IMAGE_LAYOUT_GENERAL);
}

TEST(Executor, SampledDepthUnderReadOnlyTestHasTheReadOnlyLayout) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  Image depth = graph.persistentImage("depth", {.format = VK_FORMAT_D32_SFLOAT, .width = 8, .height = 8});
  Pass pass = graph.addPass("pass", PassKind::raster);
  pass.depthReadOnly(depth);
  pass.sample(depth);
  pass.sideEffect();
  pass.record([=](PassContext& context) {
    const Binding bindings[] = {sampled(depth)};
    context.draw({.program = kRaster, .bindings = bindings});
    EXPECT_EQ(context.depthFormat(), VK_FORMAT_D32_SFLOAT);
    EXPECT_TRUE(context.colorFormats().empty());
  });
  executor.execute(graph);
  EXPECT_EQ(backend.bindings[0].layout, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL);
  EXPECT_EQ(executor.plan().depthOf(executor.plan().passes[0])[0].store, VK_ATTACHMENT_STORE_OP_NONE);
}

TEST(Executor, CopiesTheDeclaredRanges) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  ImageDesc desc = kDesc;
  desc.mips = 3;
  Image from = graph.persistentImage("from", desc), to = graph.persistentImage("to", desc);
  Pass pass = graph.addPass("copy", PassKind::transfer);
  pass.read(from, Usage::transferSource, {.firstMip = 1});
  to = pass.write(to, Usage::transferDestination, {.firstMip = 1});
  pass.record([=](PassContext& context) { context.copyImage(from, to); });
  executor.execute(graph);
  EXPECT_EQ(backend.count("copy image mip 1"), 1u);
  EXPECT_EQ(backend.count("copy image mip 2"), 1u);
  EXPECT_EQ(backend.count("copy image mip 0"), 0u);
}

}  // namespace lensgraph
