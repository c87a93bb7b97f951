// An unchanged frame asks the heap for nothing between the start of its declaration and the end of its recording.
#include <atomic>
#include <cstdlib>
#include <new>

#include "executor_support.h"

namespace {
std::atomic<uint64_t> allocations = 0;
}

// For the whole test program; the array and nothrow forms call this one.
void* operator new(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

using namespace rendergraph;
using namespace executor_test;

namespace {

uint64_t allocationsOfSteadyFrames(uint32_t framesInFlight, uint32_t threads, Timing timing) {
  FakeBackend backend;
  backend.silent = true;
  Executor executor(backend, {.framesInFlight = framesInFlight});
  Graph graph;
  const auto frame = [&] {
    graph.reset();
    declare(graph, {.passes = 12});
    executor.submit(graph, {.compile = {}, .timing = timing, .recordingThreads = threads});
  };
  for (int warmUp = 0; warmUp < 10; ++warmUp) frame();
  const uint64_t before = allocations;
  for (int i = 0; i < 100; ++i) frame();
  return allocations - before;
}

}  // namespace

TEST(SteadyFrame, AllocatesNothing) {
  EXPECT_EQ(allocationsOfSteadyFrames(1, 1, Timing::none), 0u);
  EXPECT_EQ(allocationsOfSteadyFrames(3, 1, Timing::none), 0u);
  EXPECT_EQ(allocationsOfSteadyFrames(2, 3, Timing::none), 0u);
  EXPECT_EQ(allocationsOfSteadyFrames(2, 1, Timing::inlineTimestamps), 0u);
}

TEST(SteadyFrame, TheCountCounts) {
  const uint64_t before = allocations;
  const auto one = std::make_unique<int>(1);
  EXPECT_EQ(allocations - before, *one + 0u);
}
