// The plan checker itself, on plans written by hand: right ones pass, and each fault in them is found.
#include "plan_checker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "plan_maker.h"
#include "rendergraph/declaration.h"
#include "test_device.h"

using namespace rendergraph;
using plan_checker::Hazard;

namespace {

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 kColor = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
constexpr VkPipelineStageFlags2 kHost = VK_PIPELINE_STAGE_2_HOST_BIT;
constexpr VkAccessFlags2 kStorageWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
constexpr VkAccessFlags2 kStorageRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
constexpr VkAccessFlags2 kSampledRead = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
constexpr VkAccessFlags2 kColorWrite = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
constexpr VkAccessFlags2 kColorRead = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT;
constexpr VkImageLayout kUndefined = VK_IMAGE_LAYOUT_UNDEFINED, kGeneral = VK_IMAGE_LAYOUT_GENERAL;
constexpr VkImageLayout kReadOnly = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
constexpr VkImageLayout kAttachment = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

const ImageDesc kDesc{.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 64, .height = 64};
const BufferDesc kBuffer{.size = 4096};
constexpr Subresources kWhole{0, 1, 0, 1, VK_IMAGE_ASPECT_COLOR_BIT};
constexpr AccessPoint kNothing{};

AccessPoint at(VkPipelineStageFlags2 stages, VkAccessFlags2 access = 0) {
  return {.stages = stages, .access = access};
}

ImageBarrier change(Image image, AccessPoint from, VkImageLayout before, AccessPoint to, VkImageLayout after) {
  return {.resource = image.resource, .range = kWhole, .from = from, .to = to, .oldLayout = before, .newLayout = after};
}

BufferBarrier between(Buffer buffer, AccessPoint from, AccessPoint to) {
  return {.resource = buffer.resource, .from = from, .to = to};
}

ImageBarrier moving(ImageBarrier barrier, BarrierReason reason, uint32_t from, uint32_t to) {
  barrier.reason = reason;
  barrier.fromQueue = from;
  barrier.toQueue = to;
  return barrier;
}

class PlanChecker : public testing::Test {
 protected:
  plan_checker::Setting setting(const Plan& plan) const { return {graph.declaration(), plan, options, device}; }

  std::vector<Hazard> hazards(const Plan& plan) const {
    std::vector<Hazard> result;
    for (const plan_checker::Finding& finding : plan_checker::findMissing(setting(plan))) {
      result.push_back(finding.hazard);
    }
    return result;
  }
  /// Nothing is missing and nothing is superfluous, so that every single weakening was found faulty.
  void expectExact(const Plan& plan, uint32_t attempts) const {
    for (const auto& finding : plan_checker::findMissing(setting(plan))) ADD_FAILURE() << finding.text;
    const plan_checker::Superfluous superfluous = plan_checker::findSuperfluous(setting(plan));
    for (const std::string& finding : superfluous.findings) ADD_FAILURE() << finding;
    EXPECT_GE(superfluous.attempts, attempts);
  }
  void expectHazard(Plan plan, const std::function<void(Plan&)>& fault, Hazard hazard) const {
    fault(plan);
    EXPECT_THAT(hazards(plan), testing::Contains(hazard));
  }

  uint32_t sampling(std::initializer_list<Image> images, const char* name = "sample",
                    PassKind kind = PassKind::compute) {
    Pass pass = graph.addPass(name, kind);
    for (Image image : images) pass.sample(image, {}, kind == PassKind::compute ? kCompute : kFragment);
    if (kind == PassKind::raster) pass.renderArea({64, 64});
    pass.sideEffect();
    return passes++;
  }
  uint32_t writing(Image& image, const char* name = "write") {
    Pass pass = graph.addPass(name, PassKind::compute);
    image = pass.write(image, Usage::storage);
    return passes++;
  }
  uint32_t drawing(Image& image, LoadOp load, Image* sampled = nullptr) {
    Pass pass = graph.addPass("draw", PassKind::raster);
    image = pass.color(image, {.load = load});
    if (sampled != nullptr) pass.sample(*sampled, {}, kFragment);
    return passes++;
  }

  Graph graph;
  CompileOptions options;
  TestDevice device{{TestDevice::kAll, TestDevice::kAsyncCompute}};
  uint32_t passes = 0;
};

class TwoFamilies : public PlanChecker {
 protected:
  /// Written by async compute, sampled by a raster pass.
  TwoFamilies() {
    image = graph.createImage("image", kDesc);
    write = writing(image);
    sample = sampling({image}, "sample", PassKind::raster);
    const ImageBarrier transfer = change(image, kNothing, kGeneral, kNothing, kReadOnly);
    release = moving(transfer, BarrierReason::release, 1, 0);
    release.from = at(kCompute, kStorageWrite);
    acquire = moving(transfer, BarrierReason::acquire, 1, 0);
    acquire.from = at(kFragment);
    acquire.to = at(kFragment, kSampledRead);
  }
  Plan plan(std::initializer_list<SubmissionWait> waits = {{1, kFragment}}) const {
    return PlanMaker(graph, device)
        .submission(0)
        .submission(1, {{0, kCompute}})
        .step(write, {change(image, kNothing, kUndefined, at(kCompute, kStorageWrite), kGeneral)})
        .atEnd({release})
        .submission(0, waits)
        .step(sample, {acquire})
        .finish();
  }
  Image image;
  uint32_t write, sample;
  ImageBarrier release, acquire;
};

}  // namespace

TEST_F(TwoFamilies, AReleaseASemaphoreAndAnAcquireAreEnoughAndAllNeeded) {
  expectExact(plan(), 15);
}

TEST_F(TwoFamilies, EveryFaultOfTheTransferIsFound) {
  const Plan right = plan();
  expectHazard(
      right, [](Plan& p) { std::swap(p.imageBarriers[1].oldLayout, p.imageBarriers[1].newLayout); }, Hazard::layout);
  expectHazard(
      right, [](Plan& p) { std::swap(p.imageBarriers[2].oldLayout, p.imageBarriers[2].newLayout); }, Hazard::ownership);
  expectHazard(
      right, [](Plan& p) { p.submissions[1].atEnd.images.count = 0; }, Hazard::structure);
  expectHazard(
      right, [](Plan& p) { p.imageBarriers[2].from.stages = kColor; }, Hazard::ownership);
  expectHazard(
      right, [](Plan& p) { p.submissionWaits[1].stages = kColor; }, Hazard::ownership);
  expectHazard(
      right, [](Plan& p) { p.submissionWaits[1].submission = 0; }, Hazard::structure);
  expectHazard(
      right, [](Plan& p) { p.imageBarriers[1].from.stages = kFragment; }, Hazard::structure);
  expectHazard(
      right, [](Plan& p) { p.placements[0].concurrent = true; }, Hazard::ownership);
  expectHazard(
      right, [](Plan& p) { std::swap(p.imageBarriers[1].fromQueue, p.imageBarriers[1].toQueue); }, Hazard::structure);
}

TEST_F(TwoFamilies, StagesThatWaitForNothingAreSuperfluous) {
  EXPECT_TRUE(hazards(plan({{1, kFragment | kColor}})).empty());
  const plan_checker::Superfluous found = plan_checker::findSuperfluous(setting(plan({{1, kFragment | kColor}})));
  EXPECT_THAT(found.findings, testing::ElementsAre(testing::HasSubstr("wait of submission 2 for 1")));
  const Plan all = plan({{1, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT}});
  EXPECT_TRUE(hazards(all).empty());
}

TEST_F(TwoFamilies, BarriersOfOneFamilyTransferNothing) {
  device = TestDevice({TestDevice::kAll, TestDevice::kAll});
  EXPECT_THAT(hazards(plan()), testing::Contains(Hazard::structure));
  const Plan simple =
      PlanMaker(graph, device)
          .submission(0)
          .submission(1, {{0, kCompute}})
          .step(write, {change(image, kNothing, kUndefined, at(kCompute, kStorageWrite), kGeneral)})
          .submission(0, {{1, kFragment}})
          .step(sample, {change(image, at(kFragment), kGeneral, at(kFragment, kSampledRead), kReadOnly)})
          .finish();
  expectExact(simple, 10);
  device = TestDevice({TestDevice::kAll, TestDevice::kAsyncCompute});
  EXPECT_THAT(hazards(simple), testing::Contains(Hazard::ownership));
}

TEST_F(TwoFamilies, TheChangeOfLayoutMayBeAtTheEndOfTheFirstHalf) {
  device = TestDevice({TestDevice::kAll, TestDevice::kAll});
  expectExact(PlanMaker(graph, device)
                  .submission(0)
                  .submission(1, {{0, kCompute}})
                  .step(write, {change(image, kNothing, kUndefined, at(kCompute, kStorageWrite), kGeneral)})
                  .atEnd({change(image, at(kCompute, kStorageWrite), kGeneral, kNothing, kReadOnly)})
                  .submission(0, {{1, kFragment}})
                  .step(sample)
                  .finish(),
              8);
}

TEST_F(PlanChecker, TwoFamiliesReadAtOnceOnlyWhatIsConcurrent) {
  Image image = graph.createImage("image", kDesc);
  const uint32_t write = writing(image), here = sampling({image}), there = sampling({image});
  const auto planWith = [&](VkPipelineStageFlags2 stages) {
    return PlanMaker(graph, device)
        .concurrent(image.resource)
        .submission(0)
        .step(write, {change(image, kNothing, kUndefined, at(kCompute, kStorageWrite), kGeneral)})
        .atEnd({change(image, at(kCompute, kStorageWrite), kGeneral, at(kCompute, kSampledRead), kReadOnly)})
        .submission(1, {{0, stages}})
        .step(there)
        .submission(0)
        .step(here)
        .submission(0, {{1, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT}})
        .finish();
  };
  expectExact(planWith(kCompute), 12);
  expectHazard(
      planWith(kCompute), [](Plan& p) { p.placements[0].concurrent = false; }, Hazard::ownership);
  expectHazard(
      planWith(kCompute), [](Plan& p) { p.submissionWaits[0].stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT; },
      Hazard::readAfterWrite);
}

TEST_F(PlanChecker, QueuesAreNotOrderedByTheList) {
  Buffer buffer = graph.importBuffer("buffer", kBuffer, {VK_NULL_HANDLE, ~0u, {}, {}});
  Pass reading = graph.addPass("read", PassKind::compute);
  reading.read(buffer, Usage::storage, kCompute);
  reading.sideEffect();
  Pass writing = graph.addPass("write", PassKind::compute);
  buffer = writing.write(buffer, Usage::storage, kCompute);
  device = TestDevice({TestDevice::kAll, TestDevice::kAll});
  const auto planWith = [&](std::initializer_list<SubmissionWait> waits) {
    return PlanMaker(graph, device)
        .submission(0)
        .step(0)
        .submission(1, waits)
        .step(1)
        .submission(0, {{1, kCompute}})
        .finish();
  };
  expectExact(planWith({{0, kCompute}}), 2);
  expectHazard(
      planWith({{0, kCompute}}), [](Plan& p) { p.submissionWaits[0].stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT; },
      Hazard::writeAfterRead);
  expectHazard(
      planWith({}), [](Plan&) {}, Hazard::structure);
}

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
  // A barrier that repeats what the host's waiting gives is allowed.
  const BufferBarrier repeated = between(buffer, at(kHost), at(kCompute));
  expectExact(PlanMaker(graph, device)
                  .submission(0)
                  .step(0)
                  .step(1, {}, {forHost})
                  .submission(0)
                  .step(2, {}, {repeated})
                  .finish(),
              8);
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

TEST_F(PlanChecker, RetainedResourcesRestOnTheFirstQueue) {
  Buffer buffer = graph.persistentBuffer("buffer", kBuffer);
  Pass pass = graph.addPass("modify", PassKind::compute);
  buffer = pass.modify(buffer, Usage::storage, kCompute);
  const auto moved = [&](BarrierReason reason, uint32_t from, uint32_t to, AccessPoint first, AccessPoint then) {
    BufferBarrier barrier = between(buffer, first, then);
    barrier.reason = reason;
    barrier.fromQueue = from;
    barrier.toQueue = to;
    return barrier;
  };
  const AccessPoint every =
      at(VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT);
  const AccessPoint used = at(kCompute, kStorageRead | kStorageWrite);
  const Plan plan = PlanMaker(graph, device)
                        .submission(0)
                        .atEnd({}, {moved(BarrierReason::release, 0, 1, kNothing, kNothing)})
                        .submission(1, {{0, kCompute}})
                        .step(0, {}, {moved(BarrierReason::acquire, 0, 1, at(kCompute), used)})
                        .atEnd({}, {moved(BarrierReason::release, 1, 0, at(kCompute, kStorageWrite), kNothing)})
                        .submission(0, {{1, kCompute}})
                        .atEnd({}, {moved(BarrierReason::acquire, 1, 0, at(kCompute), every)})
                        .finish();
  expectExact(plan, 15);
  options.overlappingFrames = true;
  // The release must chain from the rest state.
  EXPECT_THAT(hazards(plan), testing::Contains(Hazard::alias));
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

TEST_F(PlanChecker, AliasesOnDifferentQueuesMustBeOrdered) {
  Image first = graph.createImage("first", kDesc), second = graph.createImage("second", kDesc);
  const uint32_t a = writing(first), b = writing(second);
  const AccessPoint written = at(kCompute, kStorageWrite);
  const auto planWith = [&](AccessPoint from) {
    Plan plan = PlanMaker(graph, device)
                    .submission(0)
                    .step(a, {change(first, kNothing, kUndefined, written, kGeneral)})
                    .submission(1, {{0, kCompute}})
                    .step(b, {change(second, from, kUndefined, written, kGeneral)})
                    .submission(0, {{1, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT}})
                    .finish();
    plan.placements[1].heap = 0;
    plan.heaps.pop_back();
    plan.memory.peakBytes = plan.memory.lowerBound;
    return plan;
  };
  expectExact(planWith(at(kCompute)), 9);
  EXPECT_THAT(hazards(planWith(kNothing)), testing::Contains(Hazard::alias));
  expectHazard(
      planWith(at(kCompute)), [](Plan& p) { p.submissionWaits[0].stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT; },
      Hazard::alias);
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

TEST_F(PlanChecker, TheListIsInOrder) {
  Image image = graph.createImage("image", kDesc);
  const uint32_t write = writing(image);
  const Plan plan = PlanMaker(graph, device)
                        .submission(0)
                        .submission(1, {{0, kCompute}})
                        .step(write, {change(image, kNothing, kUndefined, at(kCompute, kStorageWrite), kGeneral)})
                        .submission(0, {{1, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT}})
                        .finish();
  expectExact(plan, 4);
  const std::function<void(Plan&)> faults[] = {[](Plan& p) { p.submissionWaits[0].submission = 2; },
                                               [](Plan& p) { p.submissionWaits[0].stages = 0; },
                                               [](Plan& p) { p.submissionWaits[0].stages = kFragment; },
                                               [](Plan& p) { p.submissions[1].queue = 0; },
                                               [](Plan& p) { p.submissions[1].steps.count = 0; },
                                               [](Plan& p) { p.submissions.pop_back(); },
                                               [](Plan& p) { p.passes[0].pass = 7; },
                                               [](Plan& p) { p.passes[0].queue = 2; },
                                               [](Plan& p) { p.barrierBatches = 2; },
                                               [](Plan& p) {
                                                 p.culled.push_back({0, ""});
                                               }};
  for (const auto& fault : faults) expectHazard(plan, fault, Hazard::structure);
}
