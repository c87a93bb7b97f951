// Several graphs and executors at once, each on its own thread; the thread sanitizer (preset tsan) looks for what they
// share unasked.
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "rendergraph/compiler.h"
#include "rendergraph/executor.h"
#include "rendergraph/graph.h"
#include "support/fake_backend.h"
#include "support/random_graph.h"

namespace lensgraph {

using namespace rendergraph;

namespace {

constexpr uint32_t kGraphs = 40;

std::vector<Plan> plansOf(uint32_t firstSeed) {
  std::vector<Plan> plans;
  Graph graph;
  for (uint32_t i = 0; i < kGraphs; ++i) {
    graph.reset();
    declareRandom(graph, firstSeed + i, 20);
    plans.push_back(compile(graph.declaration(), {.order = Order::leastMemory}, NominalDevice()));
  }
  return plans;
}

}  // namespace

TEST(Threads, CompileTheSamePlansSideBySide) {
  constexpr uint32_t kThreads = 4;
  std::vector<std::vector<Plan>> plans(kThreads);
  std::vector<std::thread> threads;
  for (uint32_t i = 0; i < kThreads; ++i) threads.emplace_back([&plans, i] { plans[i] = plansOf(i / 2 * kGraphs); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(plans[0], plans[1]);
  EXPECT_EQ(plans[2], plans[3]);
  EXPECT_EQ(plans[0], plansOf(0));
}

TEST(Threads, ExecuteSideBySide) {
  const auto work = [] {
    FakeBackend backend;
    Executor executor(backend);
    Graph graph;
    for (int frame = 0; frame < 20; ++frame) {
      graph.reset();
      const Image image = graph.createImage("image", {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 8, .height = 8});
      Pass pass = graph.addPass("pass", PassKind::compute);
      const Image written = pass.write(image, Usage::storage);
      graph.exportImage(
          written, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL});
      executor.execute(graph);
    }
    EXPECT_EQ(executor.plansCompiled(), 1u);
  };
  std::thread first(work), second(work);
  first.join();
  second.join();
}

}  // namespace lensgraph
