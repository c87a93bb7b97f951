// Orders: valid, and as good in bytes or batches as their policy says.
#include "rendergraph/compile/schedule/ordering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "rendergraph/compile/flow/cells.h"
#include "rendergraph/compile/flow/dependencies.h"
#include "rendergraph/compile/schedule/live_bytes.h"
#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/graph.h"
#include "support/batch_count.h"
#include "support/corpus.h"
#include "support/random_graph.h"

namespace lensgraph {

using namespace rendergraph;

namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();

Plan planOf(const corpus::Shape& shape, const CompileOptions& options, uint32_t* batches = nullptr) {
  Graph graph;
  corpus::declare(graph, shape);
  Plan plan = compile(graph.declaration(), options, NominalDevice());
  if (batches != nullptr) *batches = fewestBatches(graph.declaration(), plan);
  return plan;
}

/// All that orderPasses() wants to know of a random graph in which every pass lives.
struct Case {
  explicit Case(uint32_t seed) {
    declareRandom(graph, seed, 4 + seed % 40);
    const Declaration& declaration = graph.declaration();
    alive.assign(declaration.passes.size(), 1);
    edges = orderingEdges(declaration, Cells(declaration), alive);
    for (uint32_t i = 0; i < declaration.resources.size(); ++i) bytes.push_back(i % 5 == 0 ? 0 : 1 + i * 7919 % 1000);
  }
  PassOrder order(Order policy, float budget = 1.0f) const {
    return orderPasses(graph.declaration(), alive, edges, bytes, {.order = policy, .memoryBudget = budget});
  }
  Graph graph;
  std::vector<uint8_t> alive;
  std::vector<Edge> edges;
  std::vector<VkDeviceSize> bytes;
};

/// The greedy rule word by word: after every pass, look at all that are ready.
std::vector<uint32_t> greedyByLooking(const Case& c, const MemoryUse& use) {
  LiveBytes live(use, Direction::forward);
  std::vector<uint8_t> done(c.alive.size(), 0);
  std::vector<uint32_t> order;
  while (order.size() < c.alive.size()) {
    auto best = std::tuple(std::numeric_limits<int64_t>::max(), int64_t{0}, 0u);
    for (uint32_t pass = 0; pass < done.size(); ++pass) {
      const bool waits = std::any_of(c.edges.begin(), c.edges.end(),
                                     [&](const Edge& edge) { return edge.to == pass && !done[edge.from]; });
      if (done[pass] || waits) continue;
      best = std::min(best, std::tuple(live.added(pass) - live.freed(pass), live.added(pass), pass));
    }
    const uint32_t pass = std::get<2>(best);
    live.begin(pass);
    live.end(pass);
    done[pass] = 1;
    order.push_back(pass);
  }
  return order;
}

}  // namespace

TEST(Ordering, EveryPolicyRespectsEveryEdgeAndRunsEveryPassOnce) {
  for (uint32_t seed = 0; seed < 500; ++seed) {
    const Case c(seed);
    for (Order policy : {Order::declared, Order::leastMemory, Order::mostOverlap, Order::fewestBatches}) {
      for (float budget : {0.0f, 1.0f, kEndless}) {
        const PassOrder order = c.order(policy, budget);
        ASSERT_EQ(order.passes.size(), c.alive.size());
        std::vector<uint32_t> stepOf(c.alive.size(), UINT32_MAX);
        for (uint32_t step = 0; step < order.passes.size(); ++step) stepOf[order.passes[step]] = step;
        for (const Edge& edge : c.edges) {
          ASSERT_LT(order.timeOf(stepOf[edge.from]), order.timeOf(stepOf[edge.to])) << "seed " << seed;
        }
        ASSERT_TRUE(std::is_sorted(order.groups.begin(), order.groups.end()));
        ASSERT_EQ(order.passes, c.order(policy, budget).passes);
      }
    }
  }
}

TEST(Ordering, LeastMemoryIsNeverWorseThanTheGreedyRuleOrTheDeclaredOrder) {
  uint32_t savedBytes = 0, beatGreedy = 0;
  for (uint32_t seed = 0; seed < 300; ++seed) {
    const Case c(seed);
    const MemoryUse use(c.graph.declaration(), c.alive, c.bytes);
    const int64_t greedy = peakBytes(use, greedyByLooking(c, use));
    const int64_t declared = peakBytes(use, c.order(Order::declared).passes);
    const int64_t found = peakBytes(use, c.order(Order::leastMemory).passes);
    ASSERT_LE(found, std::min(greedy, declared)) << "seed " << seed;
    savedBytes += found < declared;
    beatGreedy += found < greedy;
  }
  EXPECT_GT(savedBytes, 100u);
  EXPECT_GT(beatGreedy, 100u);
}

TEST(Ordering, BytesAliveAreThoseOfALookAtEveryStep) {
  for (uint32_t seed = 0; seed < 100; ++seed) {
    const Case c(seed);
    const MemoryUse use(c.graph.declaration(), c.alive, c.bytes);
    const std::vector<uint32_t> order = c.order(Order::mostOverlap).passes;
    std::map<uint32_t, std::pair<uint32_t, uint32_t>> life;
    for (uint32_t step = 0; step < order.size(); ++step) {
      for (const DeclaredAccess& access : c.graph.declaration().accessesOfPass(order[step])) {
        life.try_emplace(access.resource, step, step).first->second.second = step;
      }
    }
    int64_t peak = 0;
    for (uint32_t step = 0; step < order.size(); ++step) {
      int64_t live = 0;
      for (const auto& [resource, steps] : life) {
        const bool lasting = c.graph.declaration().resources[resource].exported;
        const bool alive = steps.first <= step && (lasting || step <= steps.second);
        if (alive) live += static_cast<int64_t>(c.bytes[resource]);
      }
      peak = std::max(peak, live);
    }
    ASSERT_EQ(peakBytes(use, order), peak) << "seed " << seed;
  }
}

// Parallel lanes: the declared order costs a batch before nearly every pass, level by level costs half as much memory
// again. Both are to be had together.
TEST(Ordering, ParallelLanesNeedFewBatchesWithinTheMemoryOfTheDeclaredOrder) {
  constexpr uint32_t kSeeds = 200;
  double meanBatches = 0, meanBytes = 0, worstBytes = 0;
  uint32_t mostBatches = 0;
  for (uint32_t seed = 0; seed < kSeeds; ++seed) {
    const corpus::Shape shape = corpus::makeShape(corpus::Workload::wide8, seed, 100);
    uint32_t batches = 0;
    const auto bound = static_cast<double>(planOf(shape, {.aliasing = Aliasing::none}).memory.lowerBound);
    const Plan plan = planOf(shape, {.order = Order::fewestBatches, .memoryBudget = 1.05f}, &batches);
    ASSERT_LE(static_cast<double>(plan.memory.lowerBound), 1.05 * bound) << "seed " << seed;
    const double bytes = static_cast<double>(plan.memory.peakBytes) / bound;
    meanBatches += static_cast<double>(batches) / kSeeds;
    meanBytes += bytes / kSeeds;
    mostBatches = std::max(mostBatches, batches);
    worstBytes = std::max(worstBytes, bytes);
  }
  EXPECT_LE(meanBatches, 18.5);
  EXPECT_LE(mostBatches, 20u);
  EXPECT_LE(meanBytes, 1.05);
  EXPECT_LE(worstBytes, 1.13);
}

TEST(Ordering, BudgetTradesBatchesForBytes) {
  const corpus::Shape shape = corpus::makeShape(corpus::Workload::wide8, 3, 100);
  uint32_t few = 0, some = 0, many = 0;
  const Plan fewest = planOf(shape, {.order = Order::fewestBatches, .memoryBudget = kEndless}, &few);
  const Plan middle = planOf(shape, {.order = Order::fewestBatches, .memoryBudget = 1.0f}, &some);
  const Plan smallest = planOf(shape, {.order = Order::fewestBatches, .memoryBudget = 0.0f}, &many);
  EXPECT_LT(few, some);
  EXPECT_LT(some, many);
  EXPECT_GT(fewest.memory.peakBytes, middle.memory.peakBytes);
  EXPECT_GT(middle.memory.peakBytes, smallest.memory.peakBytes);
  // Two blocks of seven levels and a join, of which the second is cut short; then the last pass and the export.
  EXPECT_LE(few, 17u);
}

}  // namespace lensgraph
