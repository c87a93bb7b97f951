// What a capture says of a frame: lifetimes, memory, edges; several frames merged; JSON. No device.
#include "rendergraph/capture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "rendergraph/capture_series.h"
#include "rendergraph/executor.h"
#include "support/fake_backend.h"

namespace lensgraph {

using namespace rendergraph;
using nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;

namespace rendergraph {
void PrintTo(const CapturedEdge& edge, std::ostream* out) {
  *out << edge.from << " -> " << edge.to << " (" << edge.resource << ")";
}
}  // namespace rendergraph

namespace {

const ImageDesc kDesc{.format = VK_FORMAT_R32_SFLOAT, .width = 64, .height = 32, .layers = 1, .mips = 3};
const AccessState kSampled{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                           VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};

class Captured : public testing::Test {
 protected:
  const Capture& run(Timing timing = Timing::none) {
    executor_.execute(graph_, {.compile = {}, .timing = timing});
    return executor_.capture();
  }
  Image compute(const char* name, std::initializer_list<Image> sampled, Image target, Subresources range = {}) {
    Pass pass = graph_.addPass(name, PassKind::compute);
    for (const Image& image : sampled) pass.sample(image);
    return pass.write(target, Usage::storage, range);
  }

  FakeBackend backend_;
  Executor executor_{backend_};
  Graph graph_;
};

TEST_F(Captured, MemoryAndLifetimesAreThoseOfThePlan) {
  Image a = graph_.createImage("a", kDesc), b = graph_.createImage("b", kDesc), c = graph_.createImage("c", kDesc);
  Image host = graph_.importImage("host", kDesc,
                                  {.image = FakeBackend::as<VkImage>(7),
                                   .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                   .before = kSampled,
                                   .after = kSampled});
  a = compute("one", {host}, a);
  b = compute("two", {a}, b);
  c = compute("three", {b}, c);
  graph_.createImage("unused", kDesc);
  graph_.exportImage(c, kSampled);
  const Capture& capture = run();
  ASSERT_EQ(capture.resources.size(), 5u);
  const auto steps = [&](int i) { return std::pair(capture.resources[i].firstStep, capture.resources[i].lastStep); };
  EXPECT_EQ(steps(0), std::pair(0u, 1u));
  EXPECT_EQ(steps(1), std::pair(1u, 2u));
  EXPECT_EQ(steps(2), std::pair(2u, 3u)) << "seen after the frame";
  EXPECT_EQ(steps(3), std::pair(0u, 3u)) << "the host's";
  EXPECT_EQ(steps(4).first, kNone);
  EXPECT_EQ(capture.resources[3].heap, kNone);
  EXPECT_EQ(capture.resources[3].origin, "imported");
  EXPECT_EQ(capture.resources[0].contentBytes, 4u * (64 * 32 + 32 * 16 + 16 * 8));
  VkDeviceSize heaps = 0;
  for (const CapturedHeap& heap : capture.heaps) heaps += heap.size;
  EXPECT_EQ(heaps, capture.memory.peakBytes);
  for (const Placement& placement : executor_.plan().placements) {
    const CapturedResource& resource = capture.resources[placement.resource];
    EXPECT_EQ(std::tuple(resource.heap, resource.offset, resource.size),
              std::tuple(placement.heap, placement.offset, placement.size));
  }
  VkDeviceSize most = 0;
  for (uint32_t step = 0; step <= 3; ++step) most = std::max(most, bytesAlive(capture, step));
  EXPECT_EQ(most, capture.memory.lowerBound);
  EXPECT_EQ(bytesAlive(capture, 3), capture.resources[2].size);
}

TEST_F(Captured, EdgesLeadToTheWritersOfWhatIsRead) {
  Image mips = graph_.createImage("mips", kDesc), out = graph_.createImage("out", kDesc);
  mips = compute("mip 0", {}, mips, mip(0));
  mips = compute("mip 1", {}, mips, mip(1));
  mips = compute("mip 2", {}, mips, mip(2));
  mips = compute("mip 1 again", {}, mips, mip(1));
  Pass small = graph_.addPass("small", PassKind::compute);
  small.sample(mips, mip(1));
  out = small.write(out, Usage::storage, mip(0));
  Pass all = graph_.addPass("all", PassKind::compute);
  all.sample(mips);
  out = all.modify(out, Usage::storage, mip(0));
  Pass last = graph_.addPass("last", PassKind::compute);
  last.read(out, Usage::storage, mip(0));
  last.sideEffect();
  // The overwritten mip 1 is culled, so steps are those of what is left.
  const Capture& capture = run();
  ASSERT_EQ(capture.passes.size(), 6u);
  EXPECT_EQ(capture.culled.size(), 1u);
  std::vector<std::string> told;
  for (const CapturedEdge& edge : edgesOf(capture)) {
    told.push_back(capture.passes[edge.from].name + " > " + capture.passes[edge.to].name + ": " +
                   capture.resources[edge.resource].name);
  }
  EXPECT_THAT(told,
              testing::UnorderedElementsAre("mip 1 again > small: mips", "mip 0 > all: mips", "mip 1 again > all: mips",
                                            "mip 2 > all: mips", "small > all: out", "all > last: out"));
}

TEST_F(Captured, EdgesOfBuffersThatAreModified) {
  Buffer buffer = graph_.createBuffer("counter", {.size = 64});
  for (const char* name : {"clear", "first", "second"}) {
    Pass pass = graph_.addPass(name, PassKind::compute);
    buffer = std::string(name) == "clear" ? pass.write(buffer, Usage::storage) : pass.modify(buffer, Usage::storage);
  }
  graph_.exportBuffer(buffer, {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT});
  EXPECT_THAT(edgesOf(run()), ElementsAre(CapturedEdge{0, 1, 0}, CapturedEdge{1, 2, 0}))
      << "what comes second finds the first in what it modifies";
}

Capture frame(double gpuMs, double wallMs = 10.0) {
  Capture capture;
  capture.timing = "isolated";
  capture.frameGpuMs = gpuMs;
  capture.frameWallMs = wallMs;
  capture.passes.push_back({.name = "a", .gpuMs = gpuMs / 2, .recordMs = 0.5});
  capture.passes.push_back({.name = "b"});
  return capture;
}

TEST(CaptureSeries, MediansWithTheirSpread) {
  CaptureSeries series;
  for (const double ms : {4.0, 100.0, 2.0}) EXPECT_TRUE(series.add(frame(ms)));
  EXPECT_EQ(series.frames(), 3u);
  EXPECT_EQ(series.frameGpuMs(), (Spread{4.0, 2.0, 100.0}));
  EXPECT_EQ(series.gpuMs(0), (Spread{2.0, 1.0, 50.0}));
  EXPECT_EQ(series.gpuMs(1), Spread{}) << "never measured";
  EXPECT_EQ(series.passSumMs(), (Spread{2.0, 1.0, 50.0}));
  EXPECT_EQ(series.recordMs(0), (Spread{0.5, 0.5, 0.5}));
  series.add(frame(6.0));
  EXPECT_DOUBLE_EQ(series.frameGpuMs().median, 5.0) << "the mean of 4 and 6";
}

TEST(CaptureSeries, FramesThatWereNotMeasuredCountForNothing) {
  EXPECT_EQ(spreadOf({}), Spread{});
  EXPECT_EQ(spreadOf({-1.0}), Spread{});
  EXPECT_EQ(spreadOf({-1.0, 3.0}), (Spread{3.0, 3.0, 3.0}));
}

TEST(CaptureSeries, AFrameOfAnotherStructureBeginsAnew) {
  const auto changes = std::vector<std::pair<const char*, void (*)(Capture&)>>{
      {"a pass less", [](Capture& c) { c.passes.pop_back(); }},
      {"a name", [](Capture& c) { c.passes[0].name = "c"; }},
      {"bytes", [](Capture& c) { c.passes[0].bytesRead = 1; }},
      {"a barrier", [](Capture& c) { c.passes[1].imageBarriers = 1; }},
      {"the resolution",
       [](Capture& c) {
         c.passes[1].resolution = {8, 8};
       }},
      {"a resource", [](Capture& c) { c.resources.push_back({.name = "r"}); }},
      {"memory", [](Capture& c) { c.memory.peakBytes = 1; }},
      {"the way of timing", [](Capture& c) { c.timing = "inline"; }},
  };
  for (const auto& [what, change] : changes) {
    SCOPED_TRACE(what);
    CaptureSeries series;
    series.add(frame(2.0));
    series.add(frame(4.0));
    Capture other = frame(9.0);
    change(other);
    EXPECT_FALSE(series.add(other));
    EXPECT_EQ(series.frames(), 1u);
    EXPECT_DOUBLE_EQ(series.frameGpuMs().median, 9.0);
  }
}

TEST(CaptureSeries, OnlyTimesAndTheCacheMayDiffer) {
  CaptureSeries series;
  series.add(frame(2.0));
  Capture other = frame(4.0, 20.0);
  other.planReused = true;
  other.passes[0].gpuStartMs = 7.0;
  EXPECT_TRUE(series.add(other));
  EXPECT_EQ(series.plansReused(), 1u);
}

TEST_F(Captured, JsonHoldsWhatAPageNeeds) {
  Image a = graph_.createImage("a \"quoted\"\n", kDesc), b = graph_.createImage("b", kDesc);
  a = compute("write", {}, a);
  b = compute("read", {a}, b);
  graph_.exportImage(b, kSampled);
  CaptureSeries series;
  for (int i = 0; i < 3; ++i) series.add(run(Timing::isolated));
  std::ostringstream out;
  writeJson(out, series);
  const json told = json::parse(out.str());
  EXPECT_EQ(told["timing"], "isolated");
  EXPECT_EQ(told["frames"], 3);
  EXPECT_EQ(told["plansReused"], 2);
  EXPECT_LE(told["frameGpuMs"]["min"], told["frameGpuMs"]["median"]);
  ASSERT_EQ(told["passes"].size(), 2u);
  EXPECT_EQ(told["passes"][1]["uses"][0],
            json({{"resource", 0}, {"usage", "sampled"}, {"reads", true}, {"writes", false}}));
  EXPECT_EQ(told["passes"][1]["imageBarriers"], 2);
  EXPECT_EQ(told["passes"][1]["barrierBatches"], 1);
  EXPECT_EQ(told["resources"][0]["name"], "a \"quoted\"\n");
  EXPECT_EQ(told["resources"][0]["lastStep"], 1);
  EXPECT_EQ(told["edges"], json::parse(R"([{"from": 0, "to": 1, "resource": 0}])"));
  EXPECT_EQ(told["memory"]["heaps"].size(), series.structure().heaps.size());
  EXPECT_THAT(told["culled"], IsEmpty());
  // One untimed frame: null where nothing was measured.
  std::ostringstream untimed;
  writeJson(untimed, run());
  EXPECT_TRUE(json::parse(untimed.str())["passes"][0]["gpuMs"].is_null());
}

}  // namespace

}  // namespace lensgraph
