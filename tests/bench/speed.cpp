// Declares, compiles and packs graphs of three shapes from 10 to 10 000 passes.
#include "speed.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "allocation_count.h"
#include "rendergraph/compile/memory/packing.h"
#include "rendergraph/compiler.h"
#include "rendergraph/compute_pass.h"
#include "rendergraph/executor.h"
#include "support/corpus.h"
#include "support/fake_backend.h"

namespace lensgraph::bench {

namespace {

using namespace rendergraph;
using test_support::allocationsSoFar;

/// One frame's work, over and over on a graph that keeps its memory.
class Frames {
 public:
  Frames(corpus::Workload workload, uint32_t passes) : shape_(corpus::makeShape(workload, 1, passes)) {}

  const Graph& declare() {
    graph_.reset();
    corpus::declare(graph_, shape_, outputs_);
    return graph_;
  }
  double passes() const { return static_cast<double>(shape_.inputs.size() + 1); }

 private:
  corpus::Shape shape_;
  Graph graph_;
  std::vector<Image> outputs_;
};

/// `step` is one frame. Reports CPU nanoseconds a pass and heap allocations a frame.
template <class Step>
void measure(benchmark::State& state, const Frames& frames, Step&& step) {
  step();  // Memory that is kept from frame to frame is there from now on.
  step();
  const uint64_t before = allocationsSoFar();
  step();
  const uint64_t allocations = allocationsSoFar() - before;
  for (auto _ : state) step();
  state.counters["allocations"] = static_cast<double>(allocations);
  state.counters["passes"] = frames.passes();
}

void declareOnly(benchmark::State& state, corpus::Workload workload, uint32_t passes) {
  Frames frames(workload, passes);
  measure(state, frames, [&] { benchmark::DoNotOptimize(&frames.declare()); });
}

void declareAndHash(benchmark::State& state, corpus::Workload workload, uint32_t passes) {
  Frames frames(workload, passes);
  measure(state, frames,
          [&] { benchmark::DoNotOptimize(structuralHash(frames.declare().declaration(), CompileOptions{})); });
}

template <Aliasing aliasing>
void declareAndCompile(benchmark::State& state, corpus::Workload workload, uint32_t passes) {
  Frames frames(workload, passes);
  const NominalDevice device;
  measure(state, frames, [&] {
    const Plan plan = compile(frames.declare().declaration(), {.aliasing = aliasing}, device);
    benchmark::DoNotOptimize(&plan);
  });
}

std::vector<AliasItem> itemsOf(corpus::Workload workload, uint32_t seed, uint32_t passes) {
  Graph graph;
  corpus::declare(graph, corpus::makeShape(workload, seed, passes));
  std::vector<AliasItem> items;
  for (const Placement& placement :
       compile(graph.declaration(), {.aliasing = Aliasing::none}, NominalDevice()).placements) {
    items.push_back({.size = placement.size,
                     .alignment = VkDeviceSize{1} << 16,
                     .first = placement.firstStep,
                     .last = placement.lastStep});
  }
  return items;
}

/// Packing alone; "pass" is a resource here, of which every pass makes one. Sixteen graphs in turn, so that the branch
/// predictor does not learn one by heart.
template <Packing (*pack)(std::span<const AliasItem>)>
void packOnly(benchmark::State& state, corpus::Workload workload, uint32_t passes) {
  const Frames frames(workload, passes);
  std::vector<std::vector<AliasItem>> graphs;
  for (uint32_t seed = 0; seed < 16; ++seed) graphs.push_back(itemsOf(workload, seed, passes));
  uint32_t turn = 0;
  measure(state, frames, [&] {
    const Packing packing = pack(graphs[turn++ % graphs.size()]);
    benchmark::DoNotOptimize(&packing);
  });
}

/// Declared anew, found in the plan cache, and all its barriers recorded; the passes record nothing themselves.
void unchangedFrame(benchmark::State& state, corpus::Workload workload, uint32_t passes) {
  Frames frames(workload, passes);
  FakeBackend backend;
  backend.silent = true;
  Executor executor(backend);
  measure(state, frames, [&] { executor.execute(frames.declare(), {.compile = {.aliasing = Aliasing::fast}}); });
}

const ComputeProgram kProgram{.name = "program", .shader = {}};
struct Push {
  float values[8];
};

/// One pass that samples two textures, writes one, and dispatches once; both forms declare and record the same.
Image declareLong(Graph& graph, Image a, Image b, Image result, const Push& push) {
  Pass pass = graph.addPass("pass", PassKind::compute);
  pass.sample(a);
  pass.sample(b);
  result = pass.write(result, Usage::storage);
  pass.record([=](PassContext& context) {
    const std::array bindings = {sampled(a), sampled(b), storage(result)};
    context.dispatch(
        {.program = kProgram, .bindings = bindings, .pushConstants = bytesOf(push), .groups = groupsFor({64, 64}, 8)});
  });
  return result;
}

Image declareShort(Graph& graph, Image a, Image b, Image result, const Push& push) {
  compute(graph, "pass", kProgram).sample(a).sample(b).write(result).push(push).groups(groupsFor({64, 64}, 8));
  return result;
}

/// chain2 with dispatches.
template <Image (*declarePass)(Graph&, Image, Image, Image, const Push&)>
void declareDispatches(Graph& graph, uint32_t passes) {
  const ImageDesc desc{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = 64, .height = 64};
  graph.reset();
  Image before = graph.persistentImage("start", desc), last = before;
  for (uint32_t i = 0; i < passes; ++i) {
    const Image result = declarePass(graph, last, before, graph.createImage("texture", desc), {{1.0f}});
    before = last;
    last = result;
  }
  graph.exportImage(
      last, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL});
}

template <Image (*declarePass)(Graph&, Image, Image, Image, const Push&)>
void dispatchesDeclared(benchmark::State& state, corpus::Workload workload, uint32_t passes) {
  const Frames frames(workload, passes - 1);
  Graph graph;
  measure(state, frames, [&] {
    declareDispatches<declarePass>(graph, passes);
    benchmark::DoNotOptimize(&graph);
  });
}

template <Image (*declarePass)(Graph&, Image, Image, Image, const Push&)>
void dispatchesExecuted(benchmark::State& state, corpus::Workload workload, uint32_t passes) {
  const Frames frames(workload, passes - 1);
  FakeBackend backend;
  backend.silent = true;
  Executor executor(backend);
  Graph graph;
  measure(state, frames, [&] {
    declareDispatches<declarePass>(graph, passes);
    executor.execute(graph, {.compile = {.aliasing = Aliasing::fast}});
  });
}

struct Step {
  const char* name;
  void (*run)(benchmark::State&, corpus::Workload, uint32_t);
  uint32_t mostPasses;
  bool onlyChain2 = false;
};
constexpr Step kSteps[] = {
    {"declare", declareOnly, 10000},
    {"declare+hash", declareAndHash, 10000},
    {"unchanged frame", unchangedFrame, 1000},  // The backend's books grow with the square of the objects.
    {"pack, fast", packOnly<packFast>, 10000},
    {"pack, best", packOnly<packBest>, 10000},
    {"compile, no aliasing", declareAndCompile<Aliasing::none>, 10000},
    {"compile, fast", declareAndCompile<Aliasing::fast>, 10000},
    {"compile, best", declareAndCompile<Aliasing::best>, 10000},
    {"declare dispatches, Pass", dispatchesDeclared<declareLong>, 10000, true},
    {"declare dispatches, ComputePass", dispatchesDeclared<declareShort>, 10000, true},
    {"unchanged frame of dispatches, Pass", dispatchesExecuted<declareLong>, 1000, true},
    {"unchanged frame of dispatches, ComputePass", dispatchesExecuted<declareShort>, 1000, true},
};

/// Prints as usual, and keeps every repetition.
class Collector : public benchmark::ConsoleReporter {
 public:
  Collector() : benchmark::ConsoleReporter(OO_Tabular) {}
  void ReportRuns(const std::vector<Run>& runs) override {
    benchmark::ConsoleReporter::ReportRuns(runs);
    std::vector<double> times;
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      times.push_back(run.GetAdjustedCPUTime() / run.counters.at("passes"));
    }
    if (times.empty()) return;
    std::sort(times.begin(), times.end());
    const std::string name = runs.front().run_name.function_name;
    const auto first = name.find('/'), second = name.rfind('/');
    results.push_back({{"step", name.substr(0, first)},
                       {"workload", name.substr(first + 1, second - first - 1)},
                       {"passes", std::stoi(name.substr(second + 1))},
                       {"leastNsPerPass", times.front()},
                       {"medianNsPerPass", times[times.size() / 2]},
                       {"allocations", static_cast<uint64_t>(runs.front().counters.at("allocations"))}});
  }
  nlohmann::ordered_json results = nlohmann::ordered_json::array();
};

}  // namespace

void registerSpeed() {
  for (const Step& step : kSteps) {
    for (const auto& [workload, name] : corpus::kWorkloads) {
      for (uint32_t passes : {10u, 100u, 1000u, 10000u}) {
        if (passes > step.mostPasses || (step.onlyChain2 && workload != corpus::Workload::chain2)) continue;
        const std::string full = std::string(step.name) + "/" + std::string(name) + "/" + std::to_string(passes);
        benchmark::RegisterBenchmark(full.c_str(), step.run, workload, passes);
      }
    }
  }
}

nlohmann::ordered_json runSpeed() {
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  return std::move(collector.results);
}

}  // namespace lensgraph::bench
