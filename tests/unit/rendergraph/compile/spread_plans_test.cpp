// Plans for one queue, spread over several by hand: every step becomes a submission of its own that waits for the one
// before, and all resources are concurrent. Nothing can be missing then, and the checker must agree; and when one of
// the semaphores is taken away, something can be.
#include <gtest/gtest.h>

#include <iostream>

#include "plan_checker/plan_checker.h"
#include "plan_checker/usage_model.h"
#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "support/random_graph.h"
#include "support/test_device.h"

namespace lensgraph {

using namespace rendergraph;

namespace {

constexpr VkPipelineStageFlags2 kAllStages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
const TestDevice kDevice({TestDevice::kAll, TestDevice::kAsyncCompute, TestDevice::kTransfer});

/// What the host owns stays on the first queue, for want of transfers.
uint32_t queueFor(const Declaration& declaration, uint32_t pass) {
  for (const DeclaredAccess& access : declaration.accesses) {
    if (access.pass == pass && declaration.resources[access.resource].imported()) return 0;
  }
  const PassKind kind = declaration.passes[pass].kind;
  if (kind == PassKind::transfer && declaration.passes[pass].queue == QueuePreference::transfer) return 2;
  return kind == PassKind::compute || kind == PassKind::transfer ? 1 : 0;
}

/// Stages that the queue lacks are those of other queues, which a semaphore has been waited for.
VkPipelineStageFlags2 supported(VkPipelineStageFlags2 stages, uint32_t queue, bool waiting) {
  if ((stages & kAllStages) != 0) return kAllStages;
  const plan_checker::StageMask mask = plan_checker::stageMask(stages);
  const plan_checker::StageMask here = mask & plan_checker::stagesOf(kDevice.queues()[queue]);
  return plan_checker::stageFlags(here) | (waiting && here != mask ? kAllStages : 0);
}

void adapt(Plan& plan, const BarrierBatch& batch, uint32_t queue) {
  const auto change = [&](auto& barrier) {
    barrier.from.stages = supported(barrier.from.stages, queue, true);
    barrier.to.stages = supported(barrier.to.stages, queue, false);
  };
  for (uint32_t i = 0; i < batch.images.count; ++i) change(plan.imageBarriers[batch.images.first + i]);
  for (uint32_t i = 0; i < batch.buffers.count; ++i) change(plan.bufferBarriers[batch.buffers.first + i]);
}

void addSubmission(Plan& plan, uint32_t queue, Run steps) {
  PlannedSubmission submission{.queue = queue, .steps = steps};
  submission.waits.first = static_cast<uint32_t>(plan.submissionWaits.size());
  if (!plan.submissions.empty() && plan.submissions.back().queue != queue) {
    submission.waits.count = 1;
    plan.submissionWaits.push_back({static_cast<uint32_t>(plan.submissions.size() - 1), kAllStages});
  }
  plan.submissions.push_back(submission);
}

void spread(const Declaration& declaration, Plan& plan) {
  const BarrierBatch atEnd = plan.submissions.back().atEnd;
  plan.submissions.clear();
  addSubmission(plan, 0, {});
  for (uint32_t step = 0; step < plan.passes.size(); ++step) {
    PlannedPass& planned = plan.passes[step];
    planned.queue = queueFor(declaration, planned.pass);
    addSubmission(plan, planned.queue, {step, 1});
    adapt(plan, planned.before, planned.queue);
  }
  addSubmission(plan, 0, {});
  plan.submissions.back().atEnd = atEnd;
  for (Placement& placement : plan.placements) placement.concurrent = true;
  for (PersistentResource& persistent : plan.persistent) persistent.concurrent = true;
}

}  // namespace

TEST(SpreadPlans, TotalOrderIsEnough) {
  constexpr uint32_t kGraphs = 600;
  uint64_t waits = 0, found = 0, weakened = 0;
  for (uint32_t seed = 300000; seed < 300000 + kGraphs; ++seed) {
    Graph graph;
    declareRandom(graph, seed, seed % 32 == 31 ? 200 : 4 + seed % 40);
    CompileOptions options{.splitDistance = 0, .mergeRasterPasses = false, .useQueues = false};
    Plan plan = compile(graph.declaration(), options, kDevice);
    options.useQueues = true;
    spread(graph.declaration(), plan);
    bool several = false;
    for (const PlannedSubmission& submission : plan.submissions) several = several || submission.queue != 0;
    if (!several) continue;
    const auto missing = plan_checker::findMissing({graph.declaration(), plan, options, kDevice});
    ASSERT_TRUE(missing.empty()) << "seed " << seed << ": " << missing.front().text;
    waits += plan.submissionWaits.size();
    for (SubmissionWait& wait : plan.submissionWaits) {
      const SubmissionWait right = wait;
      wait.stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
      ++weakened;
      found += plan_checker::findMissing({graph.declaration(), plan, options, kDevice}).empty() ? 0 : 1;
      wait = right;
    }
  }
  std::cout << waits << " semaphore waits; of " << weakened << " at too few stages, " << found
            << " were missed by uses\n";
  EXPECT_GT(found, weakened / 10);
}

}  // namespace lensgraph
