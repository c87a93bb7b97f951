// The plan checker on plans for several queues, written by hand.
#include "plan_checker/plan_checker_fixture.h"

namespace lensgraph {

using namespace plan_checker_test;

namespace {

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
        .submission(1)
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
      right, [](Plan& p) { p.submissionWaits[0].stages = kColor; }, Hazard::ownership);
  expectHazard(
      right, [](Plan& p) { p.submissionWaits[0].submission = 0; }, Hazard::structure);
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
          .submission(1)
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
                  .submission(1)
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
      planWith({}), [](Plan&) {}, Hazard::writeAfterRead);
}

TEST_F(PlanChecker, AvailabilityIsKnownOnlyToTheQueueThatWaits) {
  Buffer buffer = graph.createBuffer("buffer", kBuffer);
  Pass writing = graph.addPass("write", PassKind::compute);
  buffer = writing.write(buffer, Usage::storage);
  for (const char* name : {"there", "here"}) {
    Pass reading = graph.addPass(name, PassKind::compute);
    reading.read(buffer, Usage::storage, kCompute);
    reading.sideEffect();
  }
  device = TestDevice({TestDevice::kAll, TestDevice::kAll});
  const Plan plan = PlanMaker(graph, device)
                        .submission(0)
                        .step(0)
                        .submission(1, {{0, kCompute}})
                        .step(1)
                        .submission(0)
                        .step(2, {}, {between(buffer, at(kCompute, kStorageWrite), at(kCompute, kStorageRead))})
                        .submission(0, {{1, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT}})
                        .finish();
  expectExact(plan, 6);
  expectHazard(
      plan, [](Plan& p) { p.bufferBarriers[0].from.access = 0; }, Hazard::readAfterWrite);
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

TEST_F(PlanChecker, TheListIsInOrder) {
  Image image = graph.createImage("image", kDesc);
  const uint32_t write = writing(image);
  const Plan plan = PlanMaker(graph, device)
                        .submission(0)
                        .submission(1, {{0, kCompute}})
                        .step(write, {change(image, kNothing, kUndefined, at(kCompute, kStorageWrite), kGeneral)})
                        .submission(0, {{1, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT}})
                        .finish();
  EXPECT_TRUE(hazards(plan).empty());
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

}  // namespace lensgraph
