// Plans of random graphs for several devices, judged by the independent checker.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "plan_checker/plan_checker.h"
#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "support/random_graph.h"
#include "support/test_device.h"

namespace lensgraph {

using namespace rendergraph;

namespace {

constexpr Order kOrders[] = {Order::declared, Order::leastMemory, Order::mostOverlap, Order::fewestBatches,
                             Order::fewestBatches};
constexpr float kBudgets[] = {1.0f, 0.0f, 1.2f, 1e9f};
constexpr Aliasing kAliasings[] = {Aliasing::none, Aliasing::fast, Aliasing::best, Aliasing::fast};
constexpr uint32_t kDistances[] = {0, 0, 1, 3};

const TestDevice kDevices[] = {
    TestDevice(),
    TestDevice({TestDevice::kAll, TestDevice::kAsyncCompute, TestDevice::kTransfer}),
    TestDevice({TestDevice::kAll, TestDevice::kAsyncCompute}, true),
    TestDevice({TestDevice::kAll, TestDevice::kAll}),
    TestDevice({TestDevice::kAll, TestDevice::kTransfer}, false, VkDeviceSize{1} << 18),
    TestDevice({TestDevice::kAll, TestDevice::kAll, TestDevice::kTransfer}, true, VkDeviceSize{1} << 18),
};

/// Which options vary; with every option also devices that want dedicated memory, and graphs that resolve samples.
enum class Vary { someOptions, everyOption };

/// A random graph and how it is compiled; the same seed gives the same.
struct Case {
  Case(uint32_t seed, Vary vary, uint32_t largest = 200)
      : device(kDevices[seed / 7 % (vary == Vary::someOptions ? 4 : 6)]) {
    // Mostly small graphs, where a failing seed is easy to read; every 32nd is large.
    const uint32_t passes = seed % 32 == 31 ? largest : 4 + seed % 40;
    declareRandom(graph, seed, passes, vary == Vary::everyOption && seed % 3 == 0);
    options = {.order = kOrders[seed % 5], .memoryBudget = kBudgets[seed / 5 % 4], .aliasing = kAliasings[seed % 4]};
    if (vary == Vary::someOptions) return;
    options.barriers = seed % 11 < 4 ? BarrierTiming::fewestBatches : BarrierTiming::beforeUse;
    options.splitDistance = kDistances[seed / 3 % 4];
    options.mergeRasterPasses = seed % 13 != 0;
    options.useQueues = seed % 17 != 0;
    options.overlappingFrames = seed / 2 % 2 != 0;
  }
  Plan compile() const { return rendergraph::compile(graph.declaration(), options, device); }
  plan_checker::Setting setting(const Plan& plan) const { return {graph.declaration(), plan, options, device}; }

  Graph graph;
  CompileOptions options;
  const TestDevice& device;
};

struct Counts {
  uint64_t passes = 0, barriers = 0, aliases = 0, transfers = 0, waits = 0, events = 0, merged = 0, concurrent = 0;

  void add(const Plan& plan) {
    passes += plan.passes.size();
    barriers += plan.imageBarriers.size() + plan.bufferBarriers.size();
    waits += plan.submissionWaits.size();
    events += plan.events.size();
    for (const ImageBarrier& barrier : plan.imageBarriers) {
      aliases += barrier.reason == BarrierReason::alias ? 1 : 0;
      transfers += barrier.reason == BarrierReason::acquire ? 1 : 0;
    }
    for (const PlannedPass& pass : plan.passes) merged += pass.continuesRendering ? 1 : 0;
    for (const Placement& placement : plan.placements) concurrent += placement.concurrent ? 1 : 0;
  }
};

Counts expectNothingMissing(Vary vary) {
  constexpr uint32_t kGraphs = 10000;
  Counts counts;
  for (uint32_t seed = 0; seed < kGraphs; ++seed) {
    const Case random(seed, vary);
    const Plan plan = random.compile();
    const auto missing = plan_checker::findMissing(random.setting(plan));
    EXPECT_TRUE(missing.empty()) << "seed " << seed << ": " << missing.front().text;
    if (!missing.empty()) break;
    counts.add(plan);
  }
  std::cout << kGraphs << " graphs, " << counts.passes << " living passes, " << counts.barriers << " barriers, "
            << counts.aliases << " alias barriers, " << counts.transfers << " transfers, " << counts.waits
            << " semaphore waits, " << counts.events << " events, " << counts.merged << " merged raster passes, "
            << counts.concurrent << " concurrent resources\n";
  EXPECT_GT(counts.aliases, kGraphs);  // Else the corpus would prove little about aliasing.
  return counts;
}

void expectNothingSuperfluous(Vary vary) {
  constexpr uint32_t kGraphs = 3000;
  uint64_t attempts = 0, severalQueues = 0, waits = 0;
  for (uint32_t seed = 100000; seed < 100000 + kGraphs; ++seed) {
    Case random(seed, vary);
    random.options.barriers = BarrierTiming::beforeUse;
    const Plan plan = random.compile();
    const plan_checker::Superfluous superfluous = plan_checker::findSuperfluous(random.setting(plan));
    ASSERT_TRUE(superfluous.findings.empty()) << "seed " << seed << ": " << superfluous.findings.front();
    attempts += superfluous.attempts;
    waits += plan.submissionWaits.size();
    severalQueues +=
        std::any_of(plan.passes.begin(), plan.passes.end(), [](const PlannedPass& pass) { return pass.queue != 0; });
  }
  std::cout << kGraphs << " graphs, " << severalQueues << " of them on several queues with " << waits
            << " semaphore waits; " << attempts << " weakened plans, all found faulty\n";
  EXPECT_GT(attempts, 500000u);
  EXPECT_GT(severalQueues, kGraphs / 2);
}

}  // namespace

TEST(RandomPlans, NoDependencyIsMissing) {
  expectNothingMissing(Vary::someOptions);
}

TEST(RandomPlans, EveryBarrierIsNeededInEveryBit) {
  expectNothingSuperfluous(Vary::someOptions);
}

TEST(RandomPlans, NoDependencyIsMissingWithAnyOption) {
  const Counts counts = expectNothingMissing(Vary::everyOption);
  EXPECT_GT(counts.transfers, 1000u);
  EXPECT_GT(counts.waits, 10000u);
  EXPECT_GT(counts.events, 1000u);
  EXPECT_GT(counts.merged, 1000u);
  EXPECT_GT(counts.concurrent, 100u);
}

TEST(RandomPlans, EveryBitIsNeededWithAnyOption) {
  expectNothingSuperfluous(Vary::everyOption);
}

TEST(RandomPlans, BatchesAreTheFewest) {
  constexpr uint32_t kGraphs = 1000;
  for (uint32_t seed = 200000; seed < 200000 + kGraphs; ++seed) {
    Case random(seed, Vary::everyOption, 40);
    random.options.barriers = BarrierTiming::fewestBatches;
    random.options.splitDistance = 0;
    random.options.useQueues = false;
    const Plan plan = random.compile();
    ASSERT_EQ(plan.barrierBatches, plan_checker::fewestBatches(random.setting(plan))) << "seed " << seed;
  }
}

}  // namespace lensgraph
