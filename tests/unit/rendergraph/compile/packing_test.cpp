// Packing: nothing alive overlaps, and the waste against the lower bound on a corpus of typical texture sizes.
#include "rendergraph/compile/memory/packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/graph.h"
#include "support/corpus.h"
#include "support/random_graph.h"

namespace lensgraph {

using namespace rendergraph;

namespace {

void expectSound(std::span<const AliasItem> items, const Packing& packing) {
  ASSERT_EQ(packing.offsets.size(), items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    ASSERT_EQ(packing.offsets[i] % items[i].alignment, 0u);
    ASSERT_LE(packing.offsets[i] + items[i].size, packing.size);
    for (std::size_t j = 0; j < i; ++j) {
      const bool together = items[i].first <= items[j].last && items[j].first <= items[i].last;
      const bool overlapping = packing.offsets[i] < packing.offsets[j] + items[j].size &&
                               packing.offsets[j] < packing.offsets[i] + items[i].size;
      ASSERT_FALSE(together && overlapping) << i << " and " << j;
    }
  }
}

}  // namespace

TEST(Aliasing, RandomItemsAreSoundAndNoWorseThanSeparate) {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    std::vector<AliasItem> items(1 + random() % 60);
    for (AliasItem& item : items) {
      item = {.size = 1 + random() % 100000,
              .alignment = VkDeviceSize{1} << random() % 17,
              .first = static_cast<uint32_t>(random() % 50),
              .last = 0};
      item.last = item.first + static_cast<uint32_t>(random() % 12);
    }
    const Packing fast = packFast(items), best = packBest(items), separate = packSeparately(items);
    for (const Packing& packing : {fast, best, separate}) expectSound(items, packing);
    EXPECT_GE(best.size, largestLiveSum(items));
    EXPECT_LE(best.size, fast.size);
    EXPECT_LE(fast.size, separate.size);
  }
}

TEST(Aliasing, LargestLiveSumIsExact) {
  const AliasItem items[] = {
      {.size = 10, .first = 0, .last = 2}, {.size = 20, .first = 3, .last = 5}, {.size = 5, .first = 2, .last = 3}};
  EXPECT_EQ(largestLiveSum(items), 25u);
  EXPECT_EQ(largestLiveSum({}), 0u);
}

TEST(Aliasing, AHandMadeCaseReachesTheBound) {
  // 3 + 1, then 2 + 2: greedy by start would need 5.
  const AliasItem items[] = {{.size = 3, .first = 0, .last = 0},
                             {.size = 1, .first = 0, .last = 1},
                             {.size = 2, .first = 1, .last = 2},
                             {.size = 2, .first = 2, .last = 3}};
  const Packing packing = packBest(items);
  expectSound(items, packing);
  EXPECT_EQ(packing.size, 4u);
}

TEST(Aliasing, PlansOfRandomGraphsShareNoLivingByte) {
  for (uint32_t seed = 0; seed < 1000; ++seed) {
    Graph graph;
    declareRandom(graph, seed, 40);
    const Plan plan =
        compile(graph.declaration(), {.aliasing = seed % 2 ? Aliasing::best : Aliasing::fast}, NominalDevice());
    // Lifetimes from the declaration, not from the plan.
    std::vector<std::pair<uint32_t, uint32_t>> life(graph.declaration().resources.size(), {UINT32_MAX, 0});
    for (uint32_t step = 0; step < plan.passes.size(); ++step) {
      for (const DeclaredAccess& access : graph.declaration().accesses) {
        if (access.pass != plan.passes[step].pass) continue;
        life[access.resource].first = std::min(life[access.resource].first, step);
        life[access.resource].second = step;
      }
    }
    for (std::size_t i = 0; i < life.size(); ++i) {
      if (graph.declaration().resources[i].exported) life[i].second = UINT32_MAX;
    }
    for (const Placement& a : plan.placements) {
      ASSERT_LE(a.offset + a.size, plan.heaps[a.heap].size);
      for (const Placement& b : plan.placements) {
        if (&a == &b || a.heap != b.heap) continue;
        const bool bytes = a.offset < b.offset + b.size && b.offset < a.offset + a.size;
        const bool time =
            life[a.resource].first <= life[b.resource].second && life[b.resource].first <= life[a.resource].second;
        ASSERT_FALSE(bytes && time) << "seed " << seed;
      }
    }
  }
}

namespace {

struct Ratios {
  double mean = 0, worst = 0;
};

/// Heap against the lower bound over 200 seeds of 100 passes.
Ratios corpusRatios(corpus::Workload workload, Aliasing aliasing) {
  constexpr uint32_t kSeeds = 200;
  Ratios ratios;
  for (uint32_t seed = 0; seed < kSeeds; ++seed) {
    Graph graph;
    corpus::declare(graph, corpus::makeShape(workload, seed, 100));
    const MemoryReport memory = compile(graph.declaration(), {.aliasing = aliasing}, NominalDevice()).memory;
    const double ratio = static_cast<double>(memory.peakBytes) / static_cast<double>(memory.lowerBound);
    EXPECT_GE(ratio, 1.0);
    ratios.mean += ratio / kSeeds;
    ratios.worst = std::max(ratios.worst, ratio);
  }
  return ratios;
}

}  // namespace

// The bench program prints the figures; these are what must not be lost.
TEST(Aliasing, CorpusStaysCloseToTheLowerBound) {
  for (const auto& [workload, name] : corpus::kWorkloads) {
    const Ratios best = corpusRatios(workload, Aliasing::best);
    EXPECT_LE(best.mean, 1.005) << name;
    EXPECT_LE(best.worst, 1.06) << name;
    EXPECT_LE(corpusRatios(workload, Aliasing::fast).mean, 1.1) << name;
  }
}

// Ten thousand resources that all live throughout would have 50 million pairs to look at.
TEST(Aliasing, ManyThatLiveThroughoutAreStackedAtOnce) {
  std::vector<AliasItem> items(10000);
  for (uint32_t i = 0; i < items.size(); ++i) {
    items[i] = {.size = 100 + i % 7, .alignment = 1, .first = i, .last = 10000};
  }
  EXPECT_EQ(packBest(items).size, largestLiveSum(items));
  EXPECT_EQ(packFast(items).size, largestLiveSum(items));
}

}  // namespace lensgraph
