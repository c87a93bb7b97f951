// Failures at every call that can fail: an error in words, nothing lost, and the executor goes on.
#include "support/executor_support.h"

namespace lensgraph {

using namespace rendergraph;
using namespace executor_test;
using testing::HasSubstr;

namespace {

/// Frames of two kinds, with the n-th call failing. Whether it did.
bool runWithFailure(uint32_t framesInFlight, uint32_t threads, int failing) {
  FakeBackend backend;
  backend.failWith = Misuse::outOfMemory;
  bool threw = false;
  {
    Executor executor(backend, {.framesInFlight = framesInFlight});
    backend.failCallAfter = failing;
    for (uint32_t i = 0; i < 6; ++i) {
      Graph graph;
      declare(graph, {.width = i < 3 ? 64u : 32u, .passes = 2});
      try {
        const FrameToken token =
            executor.submit(graph, {.compile = {}, .timing = Timing::inlineTimestamps, .recordingThreads = threads});
        if (i % 2 == 1) executor.wait(token);
      } catch (const GraphError& error) {
        threw = true;
        EXPECT_EQ(error.misuse(), Misuse::outOfMemory);
      }
    }
    backend.failCallAfter = -1;
    Graph graph;
    const Buffer result = declare(graph, {.width = 48});
    executor.execute(graph);
    EXPECT_EQ(executor.mapped(result).size(), 1u << 20);
  }
  EXPECT_THAT(backend.living, testing::IsEmpty()) << "call " << failing;
  EXPECT_THAT(backend.mistakes, testing::IsEmpty()) << "call " << failing;
  return threw;
}

}  // namespace

TEST(Failures, EveryCallMayFailOnce) {
  for (const uint32_t framesInFlight : {1u, 3u}) {
    int failing = 0, silent = 0;
    // A failing allocation may be made good by giving up older objects, so a few calls fail without an error.
    for (; silent < 10; ++failing) silent = runWithFailure(framesInFlight, 1, failing) ? 0 : silent + 1;
    EXPECT_GT(failing, 60);
  }
}

TEST(Failures, ALostDeviceIsNamedWithThePassesItWasAt) {
  FakeBackend backend;
  backend.failWith = Misuse::deviceLost;
  Executor executor(backend, {.framesInFlight = 2});
  Graph graph;
  declare(graph, {.passes = 2, .host = false, .history = false});
  const FrameToken token = executor.submit(graph);
  backend.failWait = true;
  std::string text;
  EXPECT_EQ(misuseOf([&] { executor.wait(token); }, &text), Misuse::deviceLost);
  EXPECT_THAT(text, HasSubstr("pass 'draw'"));
  EXPECT_THAT(text, HasSubstr("between the passes 'draw' and 'read'"));
  EXPECT_EQ(misuseOf([&] { executor.wait(token); }), Misuse::deviceLost) << "and again";
  backend.failSubmit = true;
  EXPECT_EQ(misuseOf([&] { executor.submit(graph); }), Misuse::deviceLost);
}

TEST(Failures, WhatFailsWhileAPassIsRecordedNamesPassAndResource) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  declare(graph, {.passes = 1, .host = false, .history = false});
  bool found = false;
  for (int creations = 0; creations < 20 && !found; ++creations) {
    executor.clear();
    backend.failAfter = creations;
    try {
      executor.execute(graph);
    } catch (const GraphError& error) {
      found = std::string(error.what()).find("pass 'link', resource 'link'") != std::string::npos;
    }
  }
  EXPECT_TRUE(found) << "making the view that the pass binds";
  backend.failAfter = -1;
}

TEST(Failures, MemoryThatIsNotThereNamesWhatWasToLieInIt) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  declare(graph, {.passes = 1, .host = false, .history = false});
  backend.failAfter = 0;
  std::string text;
  misuseOf([&] { executor.execute(graph); }, &text);
  EXPECT_THAT(text, testing::AnyOf(HasSubstr("resource 'drawn'"), HasSubstr("resource 'link'")));
  backend.failAfter = -1;
}

TEST(Failures, IsolatedTimingNamesTheOnePass) {
  FakeBackend backend;
  backend.failWith = Misuse::deviceLost;
  Executor executor(backend);
  Graph graph;
  declare(graph, {.passes = 2, .host = false, .history = false});
  executor.execute(graph, {.compile = {}, .timing = Timing::isolated});
  backend.failCallAfter = 0;
  for (int calls = 0; calls < 100; ++calls) {
    backend.failCallAfter = calls;
    std::string text;
    try {
      executor.execute(graph, {.compile = {}, .timing = Timing::isolated});
    } catch (const GraphError& error) {
      text = error.what();
    }
    EXPECT_THAT(text, testing::Not(HasSubstr("between")));
    if (text.find("pass 'link'") != std::string::npos) return;
  }
  FAIL() << "no failure named the pass";
}

TEST(Failures, ASubmissionThatFailsAfterOthersZeroesPersistentContentAgain) {
  FakeBackend backend;
  Executor executor(backend);
  const auto run = [&](bool fail) {
    Graph graph;
    Image sum = graph.persistentImage("sum", kDesc);
    Pass add = graph.addPass("add", PassKind::compute);
    sum = add.modify(sum, Usage::storage);
    Pass host = graph.addPass("host", PassKind::host);
    host.sideEffect();
    host.record([&backend, fail](PassContext&) { backend.failSubmit = fail; });
    Pass again = graph.addPass("again", PassKind::compute);
    sum = again.modify(sum, Usage::storage);
    executor.execute(graph);
  };
  run(false);
  EXPECT_EQ(misuseOf([&] { run(true); }), Misuse::device);
  backend.failSubmit = false;
  run(false);
  EXPECT_EQ(backend.count("clear"), 2u);
  expectClean(backend);
}

// Sizes, techniques, options, histories, taps: whatever is reconfigured, what is no longer used goes.
TEST(Failures, AThousandReconfigurationsLeaveNothingBehind) {
  for (const uint32_t framesInFlight : {1u, 3u}) {
    FakeBackend backend;
    {
      Executor executor(backend, {.framesInFlight = framesInFlight});
      std::size_t most = 0;
      for (uint32_t i = 0; i < 1000; ++i) {
        Graph graph;
        declare(graph, {.width = 8 + i % 211, .passes = 1 + i % 3, .host = i % 5 == 0, .history = i % 4 != 0});
        ExecuteOptions options;
        options.compile.aliasing = i % 7 == 0 ? Aliasing::none : Aliasing::fast;
        options.timing = i % 13 == 0 ? Timing::isolated : i % 3 == 0 ? Timing::inlineTimestamps : Timing::none;
        options.recordingThreads = 1 + i % 3;
        executor.submit(graph, options);
        backend.log.clear();
        std::erase_if(backend.submissions, [](const auto& submitted) { return submitted.finished; });
        if (i < 50) most = std::max(most, backend.living.size());
        ASSERT_LE(backend.living.size(), most + 20) << "frame " << i;
      }
    }
    EXPECT_THAT(backend.living, testing::IsEmpty());
    expectClean(backend);
  }
}

// On two queues a frame has several submissions, so it may break off while the device executes the first of them.
TEST(Failures, ViewsOfImportedImagesOutliveWhatWasSubmittedOfABrokenFrame) {
  const ImportedImage imported{
      .image = FakeBackend::as<VkImage>(7), .usage = VK_IMAGE_USAGE_SAMPLED_BIT, .before = kSampled, .after = kSampled};
  FakeBackend backend;
  backend.failWith = Misuse::outOfMemory;
  backend.queueFacts = {{.family = 0}, {.family = 1, .graphics = false}};
  bool brokeOffLate = false;
  int silent = 0;
  for (int failing = 0; silent < 10; ++failing) {
    Executor executor(backend);
    Graph graph;
    const Image scene = graph.importImage("scene", kDesc, imported);
    Pass filter = graph.addPass("filter", PassKind::compute);
    filter.prefer(QueuePreference::asyncCompute);
    filter.sample(scene);
    const Image filtered = filter.write(graph.createImage("filtered", kDesc), Usage::storage);
    filter.record([=](PassContext& context) {
      const Binding bindings[] = {sampled(scene), storage(filtered)};
      context.dispatch({.program = kCompute, .bindings = bindings, .groups = {}});
    });
    Pass show = graph.addPass("show", PassKind::raster);
    show.sample(filtered);
    const Image shown = show.color(graph.createImage("shown", kDesc));
    show.record([](PassContext& context) { context.draw({.program = kRaster, .bindings = {}}); });
    graph.exportImage(shown, kSampled);
    const std::size_t before = backend.submissions.size();
    backend.failCallAfter = failing;
    try {
      executor.submit(graph);
      ++silent;
    } catch (const GraphError&) {
      silent = 0;
      brokeOffLate = brokeOffLate || backend.submissions.size() > before;
    }
    backend.failCallAfter = -1;
  }
  EXPECT_TRUE(brokeOffLate) << "a submission was given to the device before the frame broke off";
  EXPECT_THAT(backend.mistakes, testing::IsEmpty());
}

}  // namespace lensgraph
