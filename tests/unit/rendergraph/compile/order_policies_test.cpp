// What the policies of Order promise, and that equal declarations give equal plans.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rendergraph/compiler.h"
#include "rendergraph/graph.h"
#include "support/random_graph.h"
#include "support/small_graphs.h"

namespace lensgraph {

using namespace rendergraph;
using namespace small_graphs;
using testing::ElementsAre;

namespace {

/// Two chains, each a large intermediate that a small result comes from; declared large, large, small, small.
void declareTwoChains(Graph& graph) {
  ImageDesc large = kDesc;
  large.width = large.height = 1024;
  Image x = step(graph, "largeX", {}, graph.createImage("x", large));
  Image y = step(graph, "largeY", {}, graph.createImage("y", large));
  Image p = step(graph, "smallX", {x}, graph.createImage("p", kDesc));
  Image q = step(graph, "smallY", {y}, graph.createImage("q", kDesc));
  Image out = step(graph, "join", {p, q}, graph.createImage("out", kDesc));
  graph.exportImage(out, kSampled);
}

}  // namespace

TEST(Ordering, PoliciesDifferAsPromised) {
  Graph graph;
  declareTwoChains(graph);
  const Plan declared = planOf(graph, {.order = Order::declared});
  const Plan least = planOf(graph, {.order = Order::leastMemory});
  const Plan overlap = planOf(graph, {.order = Order::mostOverlap});
  EXPECT_THAT(names(graph, declared), ElementsAre("largeX", "largeY", "smallX", "smallY", "join"));
  EXPECT_THAT(names(graph, least), ElementsAre("largeX", "smallX", "largeY", "smallY", "join"));
  EXPECT_THAT(names(graph, overlap), ElementsAre("largeX", "largeY", "smallX", "smallY", "join"));
  EXPECT_LT(least.memory.peakBytes, declared.memory.peakBytes);
}

TEST(Ordering, LeastMemoryNeverNeedsMoreThanDeclared) {
  for (uint32_t seed = 0; seed < 300; ++seed) {
    Graph graph;
    declareRandom(graph, seed, 30);
    const Plan declared = planOf(graph, {.order = Order::declared});
    const Plan least = planOf(graph, {.order = Order::leastMemory});
    EXPECT_LE(least.memory.lowerBound, declared.memory.lowerBound) << "seed " << seed;
  }
}

TEST(Ordering, EqualDeclarationsGiveEqualPlans) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const CompileOptions options{.order = static_cast<Order>(seed % 3)};
    Graph first, second;
    declareRandom(first, seed, 60);
    declareRandom(second, seed, 10);
    second.reset();
    declareRandom(second, seed, 60);
    EXPECT_EQ(planOf(first, options), planOf(second, options));
    EXPECT_EQ(structuralHash(first.declaration(), options), structuralHash(second.declaration(), options));
  }
}

}  // namespace lensgraph
