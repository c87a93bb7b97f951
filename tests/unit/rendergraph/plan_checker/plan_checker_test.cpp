// The plan checker itself, on plans for one queue written by hand: right ones pass, and each fault in them is found.
#include "plan_checker/plan_checker_fixture.h"

namespace lensgraph {

using namespace plan_checker_test;

TEST_F(PlanChecker, AnEventCoversWhatCameBeforeItWasSet) {
  Image image = graph.createImage("image", kDesc), other = graph.createImage("other", kDesc);
  const uint32_t write = writing(image), unrelated = writing(other), sample = sampling({image});
  options.splitDistance = 1;
  const AccessPoint written = at(kCompute, kStorageWrite);
  const ImageBarrier split = change(image, written, kGeneral, at(kCompute, kSampledRead), kReadOnly);
  const ImageBarrier begin = change(image, kNothing, kUndefined, written, kGeneral);
  const ImageBarrier beginOther = change(other, kNothing, kUndefined, written, kGeneral);
  const Plan plan = PlanMaker(graph, device)
                        .submission(0)
                        .step(write, {begin})
                        .step(unrelated, {beginOther})
                        .step(sample, {}, {}, {{0, {split}, {}}})
                        .finish();
  expectExact(plan, 15);
  const Plan tooEarly = PlanMaker(graph, device)
                            .submission(0)
                            .step(unrelated, {beginOther})
                            .step(write, {begin})
                            .step(sample, {}, {}, {{0, {split}, {}}})
                            .finish();
  EXPECT_THAT(hazards(tooEarly), testing::Contains(Hazard::layout));
  expectHazard(
      plan, [](Plan& p) { p.events[0].setAfter = 2; }, Hazard::structure);
  expectHazard(
      plan, [](Plan& p) { p.passes[0].sets.count = 0; }, Hazard::structure);
  options.splitDistance = 0;
  expectHazard(
      plan, [](Plan&) {}, Hazard::structure);
}

TEST_F(PlanChecker, AttachmentsOfOneRenderingAreInOrder) {
  Image image = graph.createImage("image", kDesc);
  const uint32_t first = drawing(image, LoadOp::clear), second = drawing(image, LoadOp::load);
  const uint32_t sample = sampling({image});
  const ImageBarrier begin = change(image, kNothing, kUndefined, at(kColor, kColorWrite), kAttachment);
  const ImageBarrier end = change(image, at(kColor, kColorWrite), kAttachment, at(kCompute, kSampledRead), kReadOnly);
  const Plan merged =
      PlanMaker(graph, device).submission(0).step(first, {begin}).step(second).continues().step(sample, {end}).finish();
  expectExact(merged, 13);
  expectHazard(
      merged, [](Plan& p) { p.passes[1].continuesRendering = false; }, Hazard::readAfterWrite);
  expectHazard(
      merged, [](Plan& p) { p.attachments[0].load = VK_ATTACHMENT_LOAD_OP_DONT_CARE; }, Hazard::lostContent);
  expectHazard(
      merged, [](Plan& p) { p.attachments[1].load = VK_ATTACHMENT_LOAD_OP_CLEAR; }, Hazard::structure);
  expectHazard(
      merged, [](Plan& p) { p.passes[1].renderArea.width = 32; }, Hazard::structure);
  expectHazard(
      merged, [](Plan& p) { p.attachments[0].store = p.attachments[1].store = VK_ATTACHMENT_STORE_OP_DONT_CARE; },
      Hazard::lostContent);
  expectHazard(
      merged, [](Plan& p) { p.attachments[1].store = VK_ATTACHMENT_STORE_OP_DONT_CARE; }, Hazard::structure);
  options.mergeRasterPasses = false;
  expectHazard(
      merged, [](Plan&) {}, Hazard::structure);
}

TEST_F(PlanChecker, StoresInsideARenderingAreNotOrdered) {
  Image image = graph.createImage("image", kDesc), stored = graph.createImage("stored", kDesc);
  Pass first = graph.addPass("first", PassKind::raster), second = graph.addPass("second", PassKind::raster);
  image = first.color(image, {.load = LoadOp::clear});
  stored = first.write(stored, Usage::storage, {}, kFragment);
  image = second.color(image, {.load = LoadOp::load});
  second.read(stored, Usage::storage, {}, kFragment);
  const ImageBarrier begin = change(image, kNothing, kUndefined, at(kColor, kColorWrite), kAttachment);
  const ImageBarrier store = change(stored, kNothing, kUndefined, at(kFragment, kStorageWrite), kGeneral);
  Plan plan = PlanMaker(graph, device).submission(0).step(0, {begin, store}).step(1).continues().finish();
  EXPECT_THAT(hazards(plan), testing::ElementsAre(Hazard::readAfterWrite));
}

TEST_F(PlanChecker, StoringForNobodyIsSuperfluous) {
  Image image = graph.createImage("image", kDesc);
  const uint32_t draw = drawing(image, LoadOp::dontCare);
  const ImageBarrier begin = change(image, kNothing, kUndefined, at(kColor, kColorWrite), kAttachment);
  const auto planWith = [&](VkAttachmentLoadOp load, VkAttachmentStoreOp store) {
    Plan plan = PlanMaker(graph, device).submission(0).step(draw, {begin}).finish();
    plan.attachments[0].load = load;
    plan.attachments[0].store = store;
    return plan;
  };
  expectExact(planWith(VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_DONT_CARE), 4);
  const auto superfluous = [&](const Plan& plan) { return plan_checker::findSuperfluous(setting(plan)).findings; };
  EXPECT_THAT(superfluous(planWith(VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE)),
              testing::ElementsAre(testing::HasSubstr("store operation")));
  EXPECT_THAT(superfluous(planWith(VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_DONT_CARE)),
              testing::ElementsAre(testing::HasSubstr("load operation")));
}

TEST_F(PlanChecker, TheHostNeedsABarrierToRead) {
  Buffer buffer = graph.createBuffer("buffer", {.size = 64, .memory = MemoryKind::readback});
  Pass writing = graph.addPass("write", PassKind::compute);
  buffer = writing.write(buffer, Usage::storage, kCompute);
  Pass reading = graph.addPass("read", PassKind::host);
  reading.read(buffer, Usage::host);
  Pass again = graph.addPass("again", PassKind::compute);
  buffer = again.write(buffer, Usage::storage, kCompute);
  const BufferBarrier forHost = between(buffer, at(kCompute, kStorageWrite), at(kHost, VK_ACCESS_2_HOST_READ_BIT));
  const Plan plan =
      PlanMaker(graph, device).submission(0).step(0).step(1, {}, {forHost}).submission(0).step(2).finish();
  expectExact(plan, 5);
  const BufferBarrier repeated = between(buffer, at(kHost), at(kCompute));
  const Plan repeating = PlanMaker(graph, device)
                             .submission(0)
                             .step(0)
                             .step(1, {}, {forHost})
                             .submission(0)
                             .step(2, {}, {repeated})
                             .finish();
  EXPECT_TRUE(hazards(repeating).empty());
  EXPECT_THAT(plan_checker::findSuperfluous(setting(repeating)).findings,
              testing::Each(testing::HasSubstr("barrier before step 2")));
  const Plan together = PlanMaker(graph, device).submission(0).step(0).step(1, {}, {forHost}).step(2).finish();
  EXPECT_THAT(hazards(together), testing::Contains(Hazard::structure));
}

TEST_F(PlanChecker, WhatTheHostWritesIsVisibleToLaterSubmissions) {
  Buffer buffer = graph.createBuffer("buffer", {.size = 64, .memory = MemoryKind::upload});
  Pass writing = graph.addPass("write", PassKind::host);
  buffer = writing.write(buffer, Usage::host);
  Pass reading = graph.addPass("read", PassKind::compute);
  reading.read(buffer, Usage::storage, kCompute);
  reading.sideEffect();
  EXPECT_TRUE(hazards(PlanMaker(graph, device).submission(0).step(0).submission(0).step(1).finish()).empty());
}

TEST_F(PlanChecker, OverlappingFramesShareTheirMemory) {
  Image image = graph.createImage("image", kDesc);
  const uint32_t write = writing(image), sample = sampling({image});
  const auto planWith = [&](AccessPoint from) {
    return PlanMaker(graph, device)
        .submission(0)
        .step(write, {change(image, from, kUndefined, at(kCompute, kStorageWrite), kGeneral)})
        .step(sample, {change(image, at(kCompute, kStorageWrite), kGeneral, at(kCompute, kSampledRead), kReadOnly)})
        .finish();
  };
  expectExact(planWith(kNothing), 10);
  EXPECT_THAT(plan_checker::findSuperfluous(setting(planWith(at(kCompute)))).findings,
              testing::ElementsAre(testing::HasSubstr("without one source stage")));
  options.overlappingFrames = true;
  EXPECT_THAT(hazards(planWith(kNothing)), testing::Contains(Hazard::alias));
  expectExact(planWith(at(kCompute)), 11);
}

TEST_F(PlanChecker, OverlappingFramesRestInBetween) {
  Image image = graph.persistentImage("image", kDesc);
  const uint32_t write = writing(image);
  constexpr VkPipelineStageFlags2 kEvery = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  const AccessPoint rest = at(kEvery, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT);
  const auto planWith = [&](AccessPoint from) {
    return PlanMaker(graph, device)
        .submission(0)
        .step(write, {change(image, from, kUndefined, at(kCompute, kStorageWrite), kGeneral)})
        .atEnd({change(image, at(kCompute, kStorageWrite), kGeneral, rest, kGeneral)})
        .finish();
  };
  EXPECT_TRUE(hazards(planWith(kNothing)).empty());
  options.overlappingFrames = true;
  EXPECT_THAT(hazards(planWith(kNothing)), testing::Contains(Hazard::alias));
  EXPECT_TRUE(hazards(planWith(at(kCompute))).empty());
}

TEST_F(PlanChecker, MemoryIsWhereItShouldBe) {
  Image image = graph.createImage("image", kDesc);
  const uint32_t write = writing(image), sample = sampling({image});
  device = TestDevice({TestDevice::kAll}, true, 100);
  const Plan plan =
      PlanMaker(graph, device)
          .submission(0)
          .step(write, {change(image, kNothing, kUndefined, at(kCompute, kStorageWrite), kGeneral)})
          .step(sample, {change(image, at(kCompute, kStorageWrite), kGeneral, at(kCompute, kSampledRead), kReadOnly)})
          .finish();
  expectExact(plan, 10);
  const std::function<void(Plan&)> faults[] = {[](Plan& p) { p.heaps[0].dedicated = false; },
                                               [](Plan& p) { p.heaps[0].memoryTypeBits = 0b100; },
                                               [](Plan& p) { p.heaps[0].memoryTypeBits = 0; },
                                               [](Plan& p) { p.heaps[0].memory = MemoryKind::upload; },
                                               [](Plan& p) { p.heaps[0].size /= 2; },
                                               [](Plan& p) { p.placements[0].offset = 1; },
                                               [](Plan& p) { p.placements[0].lastStep = 0; },
                                               [](Plan& p) { p.placements.clear(); },
                                               [](Plan& p) { p.memory.peakBytes *= 2; },
                                               [](Plan& p) { p.memory.lowerBound = 1; },
                                               [](Plan& p) { p.placements.push_back(p.placements[0]); }};
  for (const auto& fault : faults) expectHazard(plan, fault, Hazard::memory);
}

TEST_F(PlanChecker, CountsTheFewestBatches) {
  Image first = graph.createImage("first", kDesc), second = graph.createImage("second", kDesc);
  const uint32_t a = writing(first), b = writing(second), c = sampling({first}), d = sampling({second});
  const AccessPoint written = at(kCompute, kStorageWrite), sampled = at(kCompute, kSampledRead);
  const Plan late = PlanMaker(graph, device)
                        .submission(0)
                        .step(a, {change(first, kNothing, kUndefined, written, kGeneral)})
                        .step(b, {change(second, kNothing, kUndefined, written, kGeneral)})
                        .step(c, {change(first, written, kGeneral, sampled, kReadOnly)})
                        .step(d, {change(second, written, kGeneral, sampled, kReadOnly)})
                        .finish();
  EXPECT_TRUE(hazards(late).empty());
  EXPECT_EQ(late.barrierBatches, 4u);
  EXPECT_EQ(plan_checker::fewestBatches(setting(late)), 2u);
}

}  // namespace lensgraph
