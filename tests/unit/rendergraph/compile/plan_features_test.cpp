// What a plan makes of the rarer things that a declaration can say: optional passes, resolves, shared renderings, other
// queues, split barriers, dedicated memory. That such plans are right in general is for random_plans_test to show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/error.h"
#include "rendergraph/graph.h"
#include "rendergraph/memory_notes.h"
#include "support/test_device.h"

namespace lensgraph {

using namespace rendergraph;
using testing::HasSubstr;

namespace {

const ImageDesc kDesc{.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 64, .height = 64};
const AccessState kSampled{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                           VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};

Image filtered(Graph& graph, const char* name, Image input, bool condition = true,
               QueuePreference queue = QueuePreference::graphics) {
  Image output = graph.createImage(name, kDesc);
  Pass pass = graph.addPass(name, PassKind::compute);
  pass.onlyIf(condition);
  pass.prefer(queue);
  if (input) pass.sample(input);
  return pass.write(output, Usage::storage);
}

Plan planOf(const Graph& graph, const CompileOptions& options = {}, const DeviceFacts& device = NominalDevice()) {
  return compile(graph.declaration(), options, device);
}

Misuse misuseOf(const Graph& graph) {
  try {
    planOf(graph);
  } catch (const GraphError& error) {
    return error.misuse();
  }
  ADD_FAILURE() << "no error";
  return Misuse::device;
}

}  // namespace

TEST(OptionalPass, LeavesTheContentFromBefore) {
  for (const bool condition : {true, false}) {
    Graph graph;
    Image image = filtered(graph, "made", {});
    Pass sharpen = graph.addPass("sharpen", PassKind::compute);
    sharpen.onlyIf(condition);
    sharpen.sideEffect();
    image = sharpen.modify(image, Usage::storage);
    graph.exportImage(image, kSampled);
    const Plan plan = planOf(graph);
    EXPECT_EQ(plan.passes.size(), condition ? 2u : 1u);
    ASSERT_EQ(plan.culled.size(), condition ? 0u : 1u);
    if (!condition) {
      EXPECT_EQ(plan.culled[0].reason, "its condition is false");
    }
  }
}

TEST(OptionalPass, WithoutContentFromBeforeItsReadersAreAtFault) {
  Graph graph;
  graph.exportImage(filtered(graph, "b", filtered(graph, "a", {}, false)), kSampled);
  EXPECT_EQ(misuseOf(graph), Misuse::unwrittenRead);
}

TEST(OptionalPass, IsDecidedBeforeItsAccesses) {
  Graph graph;
  Image image = graph.createImage("image", kDesc);
  Pass pass = graph.addPass("pass", PassKind::compute);
  image = pass.write(image, Usage::storage);
  pass.onlyIf(false);
  graph.exportImage(image, kSampled);
  EXPECT_EQ(misuseOf(graph), Misuse::undeclaredAccess);
}

TEST(Sizes, FollowFromOtherResources) {
  ImageDesc odd = kDesc;
  odd.width = 65;
  odd.height = 1;
  odd.mips = 7;
  const ImageDesc half = withFormat(dividedBy(odd, 2), VK_FORMAT_R32_SFLOAT);
  EXPECT_EQ(half.width, 33u);
  EXPECT_EQ(half.height, 1u);
  EXPECT_EQ(half.mips, 1u);
  EXPECT_EQ(half.format, VK_FORMAT_R32_SFLOAT);
}

TEST(Resolve, IsAnAttachmentOfItsColour) {
  Graph graph;
  ImageDesc samples = kDesc;
  samples.samples = VK_SAMPLE_COUNT_4_BIT;
  Pass pass = graph.addPass("draw", PassKind::raster);
  Image many = pass.color(graph.createImage("many", samples));
  Image one = pass.resolve(graph.createImage("one", kDesc));
  EXPECT_TRUE(many);
  graph.exportImage(one, kSampled);
  const Plan plan = planOf(graph);
  const auto colors = plan.colorsOf(plan.passes[0]);
  ASSERT_EQ(colors.size(), 1u);
  EXPECT_EQ(colors[0].store, VK_ATTACHMENT_STORE_OP_DONT_CARE) << "nobody reads the samples";
  ASSERT_LT(colors[0].resolve, plan.attachments.size());
  EXPECT_EQ(plan.attachments[colors[0].resolve].resource, one.resource);
}

TEST(Resolve, WantsSeveralSamplesAndOne) {
  Graph graph;
  Pass pass = graph.addPass("draw", PassKind::raster);
  Image color = pass.color(graph.createImage("color", kDesc));
  graph.exportImage(pass.resolve(graph.createImage("one", kDesc)), kSampled);
  graph.exportImage(color, kSampled);
  EXPECT_EQ(misuseOf(graph), Misuse::sizeMismatch);

  graph.reset();
  Pass alone = graph.addPass("draw", PassKind::raster);
  graph.exportImage(alone.resolve(graph.createImage("one", kDesc)), kSampled);
  EXPECT_EQ(misuseOf(graph), Misuse::missingUsage);
}

TEST(SharedRendering, EndsWhereSomethingHasToBeOrdered) {
  for (const bool samplesTheStore : {false, true}) {
    Graph graph;
    Image color = graph.createImage("color", kDesc), stored = graph.createImage("stored", kDesc);
    Pass first = graph.addPass("first", PassKind::raster);
    color = first.color(color);
    stored = first.write(stored, Usage::storage, {}, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
    Pass second = graph.addPass("second", PassKind::raster);
    color = second.color(color, {.load = LoadOp::load});
    if (samplesTheStore) second.sample(stored);
    graph.exportImage(color, kSampled);
    graph.exportImage(stored, kSampled);
    const Plan plan = planOf(graph);
    EXPECT_EQ(plan.passes[1].continuesRendering, !samplesTheStore);
    EXPECT_FALSE(planOf(graph, {.mergeRasterPasses = false}).passes[1].continuesRendering);
  }
}

TEST(Queues, APassRunsWhereItPrefersAndTheOthersWaitForItOnce) {
  const TestDevice device({TestDevice::kAll, TestDevice::kAsyncCompute});
  Graph graph;
  const Image a = filtered(graph, "a", {}, true, QueuePreference::asyncCompute);
  const Image b = filtered(graph, "b", {});
  const Image c = filtered(graph, "c", a), d = filtered(graph, "d", a);
  for (const Image& image : {b, c, d}) graph.exportImage(image, kSampled);
  const Plan plan = planOf(graph, {}, device);
  uint32_t elsewhere = 0;
  for (const PlannedPass& pass : plan.passes) elsewhere += pass.queue != 0 ? 1 : 0;
  EXPECT_EQ(elsewhere, 1u);
  EXPECT_EQ(plan.submissionWaits.size(), 1u);
  const Plan single = planOf(graph, {.useQueues = false}, device);
  EXPECT_EQ(single.submissions.size(), 1u);
}

TEST(SplitBarriers, SpanThePassesInBetween) {
  Graph graph;
  const Image early = filtered(graph, "early", {});
  Image other = filtered(graph, "other 0", {});
  for (int i = 1; i < 4; ++i) other = filtered(graph, "other", other);
  const Image late = filtered(graph, "late", early);
  graph.exportImage(other, kSampled);
  graph.exportImage(late, kSampled);
  EXPECT_TRUE(planOf(graph).events.empty());
  const Plan plan = planOf(graph, {.splitDistance = 3});
  ASSERT_EQ(plan.events.size(), 1u);
  EXPECT_EQ(plan.events[0].setAfter, 0u);
  EXPECT_EQ(plan.events[0].waitBefore, 5u);
  EXPECT_EQ(plan.passes[0].sets.count, 1u);
  EXPECT_EQ(plan.passes[5].waits.count, 1u);
}

TEST(MemoryNotes, SayWithWhomOrWhyNot) {
  Graph graph;
  const Image a = filtered(graph, "a", {}), b = filtered(graph, "b", a), c = filtered(graph, "c", b);
  const Image kept = graph.persistentImage("kept", kDesc);
  const Image unused = graph.createImage("unused", kDesc);
  Pass last = graph.addPass("last", PassKind::compute);
  last.sample(c);
  last.sample(kept);
  Image result = last.write(graph.createImage("result", kDesc), Usage::storage);
  graph.exportImage(result, kSampled);
  const auto notes = memoryNotes(graph.declaration(), planOf(graph));
  EXPECT_THAT(notes[a.resource], HasSubstr("shares memory with 'c'"));
  EXPECT_THAT(notes[kept.resource], HasSubstr("kept across frames"));
  EXPECT_THAT(notes[unused.resource], HasSubstr("no living pass"));

  const TestDevice dedicated({TestDevice::kAll}, false, 1);
  const Plan apart = planOf(graph, {}, dedicated);
  EXPECT_THAT(memoryNotes(graph.declaration(), apart)[a.resource], HasSubstr("for it alone"));
  EXPECT_EQ(apart.memory.peakBytes, apart.memory.unaliasedBytes);
}

}  // namespace lensgraph
