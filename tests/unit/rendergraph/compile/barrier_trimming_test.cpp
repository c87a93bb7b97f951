// What other waits see to is not asked for twice; one small plan for each kind. That nothing is superfluous in general
// is for random_plans_test to show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "plan_checker/plan_checker.h"
#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/graph.h"
#include "support/test_device.h"

namespace lensgraph {

using namespace rendergraph;

namespace {

const BufferDesc kBuffer{.size = 4096};
constexpr VkPipelineStageFlags2 kVertex = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
                                kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;

class Trimming : public testing::Test {
 protected:
  Pass pass(const char* name, PassKind kind, bool async = false) {
    Pass added = graph.addPass(name, kind);
    if (async) added.prefer(QueuePreference::asyncCompute);
    if (kind == PassKind::raster) added.renderArea({64, 64});
    added.sideEffect();
    return added;
  }
  Plan exactPlan() const {
    const Plan plan = compile(graph.declaration(), options, device);
    const plan_checker::Setting setting{graph.declaration(), plan, options, device};
    for (const auto& finding : plan_checker::findMissing(setting)) ADD_FAILURE() << finding.text;
    for (const std::string& finding : plan_checker::findSuperfluous(setting).findings) ADD_FAILURE() << finding;
    return plan;
  }
  static auto barriersOf(const Plan& plan, Buffer buffer) {
    return std::count_if(plan.bufferBarriers.begin(), plan.bufferBarriers.end(),
                         [&](const BufferBarrier& barrier) { return barrier.resource == buffer.resource; });
  }

  Graph graph;
  CompileOptions options;
  TestDevice device{{TestDevice::kAll, TestDevice::kAll}};
};

}  // namespace

TEST_F(Trimming, ASemaphoreThereAndBackOrdersTheQueueItself) {
  Buffer question = graph.createBuffer("question", kBuffer), answer = graph.createBuffer("answer", kBuffer);
  Buffer own = graph.createBuffer("own", kBuffer), late = graph.createBuffer("late", kBuffer);
  Pass ask = pass("ask", PassKind::compute);
  question = ask.write(question, Usage::storage);
  own = ask.write(own, Usage::storage);
  Pass reply = pass("reply", PassKind::compute, true);
  reply.read(question, Usage::storage);
  answer = reply.write(answer, Usage::storage);
  Pass meanwhile = pass("meanwhile", PassKind::compute);
  late = meanwhile.write(late, Usage::storage);
  Pass hear = pass("hear", PassKind::compute);
  hear.read(answer, Usage::storage);
  own = hear.modify(own, Usage::storage);
  late = hear.modify(late, Usage::storage);
  const Plan plan = exactPlan();
  EXPECT_EQ(barriersOf(plan, own), 0);
  EXPECT_EQ(barriersOf(plan, late), 1);  // The other queue knows nothing of it.
}

TEST_F(Trimming, AWaitBeforeABarrierNeedsOneStage) {
  const ImageDesc desc{.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 64, .height = 64};
  Image image = graph.createImage("image", desc);
  Pass write = pass("write", PassKind::compute, true);
  image = write.write(image, Usage::storage);
  Pass draw = pass("draw", PassKind::raster);
  draw.sample(image, {}, kVertex | kFragment);
  Plan plan = exactPlan();
  ASSERT_EQ(plan.submissionWaits.size(), 1u);
  EXPECT_TRUE(std::has_single_bit(plan.submissionWaits[0].stages));
  graph.reset();  // Without a change of layout there is no barrier.
  Buffer buffer = graph.createBuffer("buffer", kBuffer);
  Pass fill = pass("fill", PassKind::compute, true);
  buffer = fill.write(buffer, Usage::storage);
  Pass use = pass("use", PassKind::raster);
  use.read(buffer, Usage::storage, kVertex | kFragment);
  plan = exactPlan();
  ASSERT_EQ(plan.submissionWaits.size(), 1u);
  EXPECT_EQ(plan.submissionWaits[0].stages, kVertex | kFragment);
}

TEST_F(Trimming, WhatTheHostHasWaitedForNeedsNoOrder) {
  Buffer result = graph.createBuffer("result", {.size = 4096, .memory = MemoryKind::readback});
  Buffer scratch = graph.createBuffer("scratch", kBuffer), content = graph.createBuffer("content", kBuffer);
  Pass first = pass("first", PassKind::compute);
  result = first.write(result, Usage::storage);
  scratch = first.write(scratch, Usage::storage);
  content = first.write(content, Usage::storage);
  Pass look = pass("look", PassKind::host);
  look.read(result, Usage::host);
  Pass second = pass("second", PassKind::compute);
  result = second.write(result, Usage::storage);
  content = second.modify(content, Usage::storage);
  const Plan plan = exactPlan();
  EXPECT_EQ(barriersOf(plan, result), 1);   // For the host.
  EXPECT_EQ(barriersOf(plan, content), 1);  // The host's waiting shows nothing to the device.
}

TEST_F(Trimming, ReadsOnAnotherQueueGoOnIntoTheNextFrame) {
  options.overlappingFrames = true;
  Buffer kept = graph.createBuffer("kept", kBuffer), other = graph.createBuffer("other", kBuffer);
  Pass make = pass("make", PassKind::compute);
  kept = make.write(kept, Usage::storage);
  Pass reading = pass("reading", PassKind::compute, true);
  reading.read(kept, Usage::storage);
  other = reading.write(other, Usage::storage);
  Pass draw = pass("draw", PassKind::raster);
  draw.read(other, Usage::storage, kFragment);
  graph.exportBuffer(kept, {});
  exactPlan();
}

}  // namespace lensgraph
