// An unchanged frame asks the heap for nothing between the start of its declaration and the end of its recording.
#include <memory>
#include <new>

#include "allocation_count.h"
#include "support/executor_support.h"

namespace lensgraph {

using namespace rendergraph;
using namespace executor_test;
using test_support::allocationsSoFar;

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
  const uint64_t before = allocationsSoFar();
  for (int i = 0; i < 100; ++i) frame();
  return allocationsSoFar() - before;
}

}  // namespace

TEST(SteadyFrame, AllocatesNothing) {
  EXPECT_EQ(allocationsOfSteadyFrames(1, 1, Timing::none), 0u);
  EXPECT_EQ(allocationsOfSteadyFrames(3, 1, Timing::none), 0u);
  EXPECT_EQ(allocationsOfSteadyFrames(2, 3, Timing::none), 0u);
  EXPECT_EQ(allocationsOfSteadyFrames(2, 1, Timing::inlineTimestamps), 0u);
}

TEST(SteadyFrame, TheCountCountsEveryForm) {
  // Functions called by name: what a new-expression asks for, the compiler may leave out.
  constexpr auto kAligned = std::align_val_t{64};
  const uint64_t before = allocationsSoFar();
  operator delete(operator new(1));
  operator delete[](operator new[](1));
  operator delete(operator new(1, std::nothrow), std::nothrow);
  operator delete[](operator new[](1, std::nothrow), std::nothrow);
  operator delete(operator new(1, kAligned), kAligned);
  operator delete[](operator new[](1, kAligned), kAligned);
  operator delete(operator new(1, kAligned, std::nothrow), kAligned, std::nothrow);
  operator delete[](operator new[](1, kAligned, std::nothrow), kAligned, std::nothrow);
  EXPECT_EQ(allocationsSoFar() - before, 8u);
}

}  // namespace lensgraph
