// Plans of random graphs, judged by the independent checker.
#include <gtest/gtest.h>

#include <iostream>

#include "plan_checker.h"
#include "random_graph.h"
#include "rendergraph/compiler.h"
#include "rendergraph/declaration.h"

using namespace rendergraph;

namespace {

constexpr Order kOrders[] = {Order::declared, Order::leastMemory, Order::mostOverlap, Order::fewestBatches,
                             Order::fewestBatches};
constexpr float kBudgets[] = {1.0f, 0.0f, 1.2f, 1e9f};
constexpr Aliasing kAliasings[] = {Aliasing::none, Aliasing::fast, Aliasing::best, Aliasing::fast};

struct Options {
  CompileOptions compile;
  uint32_t passes;
};

Options optionsFor(uint32_t seed) {
  // Mostly small graphs, where a failing seed is easy to read; every 32nd has 200 passes.
  const uint32_t passes = seed % 32 == 31 ? 200 : 4 + seed % 40;
  return {{.order = kOrders[seed % 5], .memoryBudget = kBudgets[seed / 5 % 4], .aliasing = kAliasings[seed % 4]},
          passes};
}

}  // namespace

TEST(RandomPlans, NoDependencyIsMissing) {
  constexpr uint32_t kGraphs = 10000;
  uint64_t passes = 0, barriers = 0, aliasBarriers = 0;
  for (uint32_t seed = 0; seed < kGraphs; ++seed) {
    Graph graph;
    const Options options = optionsFor(seed);
    declareRandom(graph, seed, options.passes);
    const Plan plan = compile(graph.declaration(), options.compile, NominalDevice());
    const auto missing = plan_checker::findMissing({graph.declaration(), plan, options.compile, NominalDevice()});
    ASSERT_TRUE(missing.empty()) << "seed " << seed << ": " << missing.front().text;
    passes += plan.passes.size();
    for (const PlannedPass& pass : plan.passes) {
      barriers += pass.before.images.count + pass.before.buffers.count;
      for (const ImageBarrier& barrier : plan.imagesOf(pass.before))
        aliasBarriers += barrier.reason == BarrierReason::alias;
    }
  }
  std::cout << kGraphs << " graphs, " << passes << " living passes, " << barriers << " barriers, " << aliasBarriers
            << " alias barriers\n";
  EXPECT_GT(aliasBarriers, kGraphs);  // Else the corpus would prove little about aliasing.
}

TEST(RandomPlans, EveryBarrierIsNeededInEveryBit) {
  constexpr uint32_t kGraphs = 3000;
  uint64_t attempts = 0;
  for (uint32_t seed = 100000; seed < 100000 + kGraphs; ++seed) {
    Graph graph;
    const Options options = optionsFor(seed);
    declareRandom(graph, seed, options.passes);
    const Plan plan = compile(graph.declaration(), options.compile, NominalDevice());
    const plan_checker::Superfluous superfluous =
        plan_checker::findSuperfluous({graph.declaration(), plan, options.compile, NominalDevice()});
    ASSERT_TRUE(superfluous.findings.empty()) << "seed " << seed << ": " << superfluous.findings.front();
    attempts += superfluous.attempts;
  }
  std::cout << kGraphs << " graphs, " << attempts << " weakened plans, each found faulty\n";
  EXPECT_GT(attempts, 100000u);
}
