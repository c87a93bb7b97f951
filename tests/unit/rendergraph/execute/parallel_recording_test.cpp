// Recording on several threads: the same commands in the same order, whatever the number. Under a thread sanitizer
// (-DLENSGRAPH_SANITIZE=thread) these tests find what recordings share by mistake.
#include <atomic>
#include <stdexcept>
#include <thread>

#include "rendergraph/jobs.h"
#include "support/executor_support.h"

namespace lensgraph {

using namespace rendergraph;
using namespace executor_test;
using testing::HasSubstr;

namespace {

std::vector<std::string> commandsOf(const Everything& what, uint32_t threads, Timing timing = Timing::none) {
  FakeBackend backend;
  Executor executor(backend, {.framesInFlight = 2});
  Graph graph;
  declare(graph, what);
  for (int frame = 0; frame < 3; ++frame) {
    executor.submit(graph, {.compile = {}, .timing = timing, .recordingThreads = threads});
  }
  expectClean(backend);
  std::erase(backend.log, "begin");  // More command buffers, the same commands.
  return backend.log;
}

/// A pass that fails when `fails`.
void declareFailing(Graph& graph, uint32_t passes, const std::vector<uint32_t>& failing) {
  for (uint32_t i = 0; i < passes; ++i) {
    Pass pass = graph.addPass("pass " + std::to_string(i), PassKind::compute);
    pass.sideEffect();
    const bool fails = std::ranges::find(failing, i) != failing.end();
    pass.record([=](PassContext&) {
      if (fails) throw std::runtime_error("recording " + std::to_string(i) + " failed");
    });
  }
}

}  // namespace

TEST(ParallelRecording, GivesTheSameCommandsInTheSameOrder) {
  for (const Everything& what : {Everything{}, Everything{.passes = 40}, Everything{.passes = 0, .host = false}}) {
    for (const Timing timing : {Timing::none, Timing::inlineTimestamps}) {
      const auto alone = commandsOf(what, 1, timing);
      for (const uint32_t threads : {2u, 3u, 4u, 7u, 64u, 1000u}) EXPECT_EQ(commandsOf(what, threads, timing), alone);
    }
  }
}

TEST(ParallelRecording, RecordsOnSeveralThreadsAtOnce) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  std::atomic<int> arrived = 0;
  for (int i = 0; i < 2; ++i) {
    Pass pass = graph.addPass("pass", PassKind::compute);
    pass.sideEffect();
    pass.record([&](PassContext&) {
      // Each waits for the other: one after the other they would wait forever.
      ++arrived;
      const auto start = std::chrono::steady_clock::now();
      while (arrived < 2 && std::chrono::steady_clock::now() - start < std::chrono::seconds(20)) {
        std::this_thread::yield();
      }
    });
  }
  const auto start = std::chrono::steady_clock::now();
  executor.execute(graph, {.compile = {}, .recordingThreads = 2});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(15));
}

TEST(ParallelRecording, TheFirstPassThatFailsIsTheOneReported) {
  FakeBackend backend;
  Executor executor(backend);
  for (int attempt = 0; attempt < 50; ++attempt) {
    Graph bad;
    declareFailing(bad, 16, {5, 6, 14});
    try {
      executor.execute(bad, {.compile = {}, .recordingThreads = 4});
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "recording 5 failed");
    }
  }
  EXPECT_EQ(backend.count("submit"), 0u);
  Graph good;
  declareFailing(good, 16, {});
  executor.execute(good, {.compile = {}, .recordingThreads = 4});
  EXPECT_EQ(backend.count("submit"), 1u);
  expectClean(backend);
}

TEST(ParallelRecording, MisuseNamesThePassThatDidIt) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  const Image hidden = graph.createImage("hidden", kDesc);
  for (int i = 0; i < 8; ++i) {
    Pass pass = graph.addPass("pass " + std::to_string(i), PassKind::compute);
    pass.sideEffect();
    pass.record([=](PassContext& context) {
      if (i == 6) static_cast<void>(context.image(hidden));
    });
  }
  std::string text;
  EXPECT_EQ(misuseOf([&] { executor.execute(graph, {.compile = {}, .recordingThreads = 8}); }, &text),
            Misuse::undeclaredAccess);
  EXPECT_THAT(text, HasSubstr("pass 'pass 6'"));
}

TEST(ParallelRecording, UsesTheHostsJobs) {
  struct Backwards : Jobs {
    uint32_t runs = 0, jobs = 0;
    void run(uint32_t count, Job job) override {
      ++runs;
      jobs += count;
      for (uint32_t i = count; i-- > 0;) job(i);  // Any order will do.
    }
  } jobs;
  FakeBackend backend;
  Executor executor(backend, {.jobs = &jobs});
  Graph graph;
  declare(graph, {.passes = 10, .host = false});
  executor.execute(graph, {.compile = {}, .recordingThreads = 3});
  EXPECT_EQ(jobs.runs, 1u);
  EXPECT_EQ(jobs.jobs, 3u);
  auto log = backend.log;
  std::erase(log, "begin");
  FakeBackend other;
  Executor alone(other);
  alone.execute(graph);
  std::erase(other.log, "begin");
  EXPECT_EQ(log, other.log);
  expectClean(backend);
}

TEST(ThreadPool, CallsEachNumberOnce) {
  ThreadPool pool(4);
  for (uint32_t count : {0u, 1u, 3u, 100u}) {
    std::vector<std::atomic<int>> calls(count);
    auto job = [&](uint32_t number) { ++calls[number]; };
    pool.run(count, Job::of(job));
    for (const auto& n : calls) EXPECT_EQ(n, 1);
  }
}

}  // namespace lensgraph
