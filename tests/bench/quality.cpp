// Packs and orders 200 random graphs of each shape, and collects means and worst cases.
#include "quality.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include "bare_technique.h"
#include "passes/registry/registry.h"
#include "rendergraph/compiler.h"
#include "support/batch_count.h"
#include "support/corpus.h"

namespace lensgraph::bench {

namespace {

using namespace rendergraph;
using nlohmann::ordered_json;

constexpr uint32_t kSeeds = 200, kPasses = 100;

struct Statistic {
  double mean = 0, worst = 0;
  void add(double value) {
    mean += value / kSeeds;
    worst = std::max(worst, value);
  }
};

double ratio(VkDeviceSize a, VkDeviceSize b) {
  return static_cast<double>(a) / static_cast<double>(b);
}

/// Best of five, since other programs share the machine.
double compileMicroseconds(const Graph& graph, const CompileOptions& options) {
  using Clock = std::chrono::steady_clock;
  double best = std::numeric_limits<double>::max();
  for (int repetition = 0; repetition < 5; ++repetition) {
    const auto start = Clock::now();
    compile(graph.declaration(), options, NominalDevice());
    best = std::min(best, std::chrono::duration<double, std::micro>(Clock::now() - start).count());
  }
  return best;
}

struct Setting {
  const char* name;
  CompileOptions options;
};
std::vector<Setting> orderSettings() {
  std::vector<Setting> settings = {
      {"declared", {}}, {"leastMemory", {.order = Order::leastMemory}}, {"mostOverlap", {.order = Order::mostOverlap}}};
  for (float budget : {0.0f, 0.8f, 0.9f, 1.0f, 1.05f, 1.1f, 1.2f, 1.35f, std::numeric_limits<float>::infinity()}) {
    settings.push_back({"fewestBatches", {.order = Order::fewestBatches, .memoryBudget = budget}});
  }
  return settings;
}

}  // namespace

ordered_json aliasingQuality() {
  ordered_json rows = ordered_json::array();
  for (const auto& [workload, name] : corpus::kWorkloads) {
    for (const auto& [level, levelName] : {std::pair(Aliasing::fast, "fast"), std::pair(Aliasing::best, "best")}) {
      Statistic heap, unaliased;
      for (uint32_t seed = 0; seed < kSeeds; ++seed) {
        Graph graph;
        corpus::declare(graph, corpus::makeShape(workload, seed, kPasses));
        const MemoryReport memory = compile(graph.declaration(), {.aliasing = level}, NominalDevice()).memory;
        heap.add(ratio(memory.peakBytes, memory.lowerBound));
        unaliased.add(ratio(memory.unaliasedBytes, memory.lowerBound));
      }
      rows.push_back({{"workload", name},
                      {"level", levelName},
                      {"meanHeapPerBound", heap.mean},
                      {"worstHeapPerBound", heap.worst},
                      {"meanUnaliasedPerBound", unaliased.mean}});
    }
  }
  return rows;
}

ordered_json batchesAgainstBytes() {
  ordered_json rows = ordered_json::array();
  for (const Setting& setting : orderSettings()) {
    Statistic batches, bytes;
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
      Graph graph;
      corpus::declare(graph, corpus::makeShape(corpus::Workload::wide8, seed, kPasses));
      const NominalDevice device;
      const VkDeviceSize bound = compile(graph.declaration(), {.aliasing = Aliasing::none}, device).memory.lowerBound;
      const Plan plan = compile(graph.declaration(), setting.options, device);
      batches.add(fewestBatches(graph.declaration(), plan));
      bytes.add(ratio(plan.memory.peakBytes, bound));
    }
    ordered_json row = {{"order", setting.name}};
    if (setting.options.order == Order::fewestBatches) {
      const float budget = setting.options.memoryBudget;
      row["memoryBudget"] = budget < 1e9f ? ordered_json(std::round(budget * 100.0) / 100.0) : ordered_json("infinity");
    }
    row["meanBatches"] = batches.mean;
    row["mostBatches"] = batches.worst;
    row["meanBytesPerBound"] = bytes.mean;
    row["worstBytesPerBound"] = bytes.worst;
    rows.push_back(row);
  }
  return rows;
}

ordered_json techniques() {
  ordered_json rows = ordered_json::array();
  for (const passes::Technique& technique : passes::techniques()) {
    for (const VkExtent2D extent : {VkExtent2D{1280, 720}, VkExtent2D{3840, 2160}}) {
      Graph graph;
      passes::SceneDraw scene;
      declareBare(graph, technique, {.extent = extent}, scene);
      const Plan plan = compile(graph.declaration(), {}, NominalDevice());
      rows.push_back({{"technique", technique.name},
                      {"width", extent.width},
                      {"height", extent.height},
                      {"passes", plan.passes.size()},
                      {"batches", plan.barrierBatches},
                      {"peakBytes", plan.memory.peakBytes},
                      {"lowerBound", plan.memory.lowerBound},
                      {"unaliasedBytes", plan.memory.unaliasedBytes},
                      {"compileFastUs", compileMicroseconds(graph, {.aliasing = Aliasing::fast})},
                      {"compileBestUs", compileMicroseconds(graph, {.aliasing = Aliasing::best})}});
    }
  }
  return rows;
}

}  // namespace lensgraph::bench
