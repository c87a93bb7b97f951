// Plans made by hand, with everything that rendergraph/plan.h can say, and what becomes of them on a backend that knows
// in which order submissions, events and renderings are legal.
#include "rendergraph/compiler.h"
#include "rendergraph/execute/frame/executor_state.h"
#include "support/executor_support.h"

namespace lensgraph {

using namespace rendergraph;
using namespace executor_test;
using testing::ElementsAre;
using testing::IsEmpty;

namespace {

/// Compiles a graph, lets the test rewrite the plan, and carries it out.
class HandMade {
 public:
  explicit HandMade(FakeBackend& backend, uint32_t framesInFlight = 1)
      : state_(backend, {.framesInFlight = framesInFlight}), framesInFlight_(framesInFlight) {}

  template <class Rewrite>
  void run(const Graph& graph, Rewrite&& rewrite, uint32_t threads = 1) {
    // The plan that the executor finds under the declaration's hash is the one made by hand.
    const CompileOptions options{.overlappingFrames = framesInFlight_ > 1};
    const uint64_t hash = structuralHash(graph.declaration(), options);
    PlanCache& plans = state_.plans().cache();
    if (plans.find(hash) == nullptr) rewrite(plans.add(hash, compile(graph.declaration(), {}, NominalDevice())).plan);
    state_.submit(graph.declaration(), {.compile = options, .recordingThreads = threads});
  }
  void waitForAll() { state_.waitForAll(); }

 private:
  ExecutorState state_;
  uint32_t framesInFlight_;
};

/// `count` compute passes, each reading what the one before wrote.
void declareLinks(Graph& graph, uint32_t count) {
  Image image = graph.createImage("image", kDesc);
  for (uint32_t i = 0; i < count; ++i) {
    Pass pass = graph.addPass("pass " + std::to_string(i), PassKind::compute);
    image = i == 0 ? pass.write(image, Usage::storage) : pass.modify(image, Usage::storage);
    pass.record([](PassContext& context) { context.dispatch({.program = kCompute, .bindings = {}, .groups = {}}); });
  }
  graph.exportImage(image, kSampled);
}

/// graphics: (empty) → compute: steps 0, 1 → transfer: step 2 → graphics: step 3 and the end.
void putOnThreeQueues(Plan& plan) {
  const BarrierBatch end = plan.submissions.back().atEnd;
  const uint32_t queues[] = {1, 1, 2, 0};
  for (uint32_t i = 0; i < 4; ++i) plan.passes[i].queue = queues[i];
  constexpr VkPipelineStageFlags2 kAll = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  plan.submissionWaits = {{0, kAll}, {1, VK_PIPELINE_STAGE_2_COPY_BIT}, {1, kAll}, {2, kAll}};
  plan.submissions = {{.queue = 0, .steps = {0, 0}, .waits = {0, 0}, .atEnd = {}},
                      {.queue = 1, .steps = {0, 2}, .waits = {0, 1}, .atEnd = {}},
                      {.queue = 2, .steps = {2, 1}, .waits = {1, 1}, .atEnd = {}},
                      {.queue = 0, .steps = {3, 1}, .waits = {2, 2}, .atEnd = end}};
}

const std::vector<QueueFacts> kThreeQueues = {
    {.family = 0}, {.family = 1, .graphics = false}, {.family = 2, .graphics = false, .compute = false}};

std::vector<std::string> labelsOf(const FakeBackend::Submitted& submitted) {
  std::vector<std::string> labels;
  for (const std::string& line : submitted.lines) {
    if (line.starts_with("label ")) labels.push_back(line.substr(6));
  }
  return labels;
}

}  // namespace

TEST(CarriedOut, SubmissionsWaitForOneAnotherThroughTheQueuesTimelines) {
  for (const uint32_t threads : {1u, 2u, 4u}) {
    FakeBackend backend;
    backend.queueFacts = kThreeQueues;
    HandMade executor(backend, 2);
    Graph graph;
    declareLinks(graph, 4);
    for (int frame = 0; frame < 5; ++frame) executor.run(graph, putOnThreeQueues, threads);
    expectClean(backend);
    // The first submission has nothing to do: whoever waits for it waits for the frame before, on that queue.
    ASSERT_EQ(backend.submissions.size(), 15u);
    const auto *compute = &backend.submissions[12], *transfer = compute + 1, *graphics = compute + 2;
    EXPECT_EQ(compute->queue, 1u);
    EXPECT_THAT(labelsOf(*compute), ElementsAre("pass 0", "pass 1"));
    ASSERT_EQ(compute->waits.size(), 1u);
    EXPECT_EQ(compute->waits[0].semaphore, graphics->signal);
    EXPECT_EQ(compute->waits[0].value, backend.submissions[11].value) << "the end of the frame before";
    EXPECT_EQ(transfer->queue, 2u);
    ASSERT_EQ(transfer->waits.size(), 1u);
    EXPECT_EQ(transfer->waits[0].semaphore, compute->signal);
    EXPECT_EQ(transfer->waits[0].value, compute->value);
    EXPECT_EQ(transfer->waits[0].stages, VK_PIPELINE_STAGE_2_COPY_BIT);
    EXPECT_EQ(graphics->queue, 0u);
    EXPECT_THAT(labelsOf(*graphics), ElementsAre("pass 3"));
    EXPECT_EQ(graphics->waits.size(), 2u);
    executor.waitForAll();
    for (const auto& submitted : backend.submissions) EXPECT_TRUE(submitted.finished);
  }
}

TEST(CarriedOut, OwnershipPassesBetweenTheFamiliesOfTheQueues) {
  FakeBackend backend;
  backend.queueFacts = kThreeQueues;
  backend.queueFacts.push_back({.family = 1, .graphics = false});
  HandMade executor(backend);
  Graph graph;
  declareLinks(graph, 2);
  executor.run(graph, [](Plan& plan) {
    ImageBarrier& transfer = plan.imageBarriers.at(plan.passes[1].before.images.first);
    transfer.fromQueue = 1;
    transfer.toQueue = 2;
    ImageBarrier& same = plan.imageBarriers.at(plan.submissions.back().atEnd.images.first);
    same.fromQueue = 1;
    same.toQueue = 3;
  });
  ASSERT_EQ(backend.imageBarriers.size(), 3u);
  EXPECT_EQ(backend.imageBarriers[0].srcQueueFamilyIndex, VK_QUEUE_FAMILY_IGNORED);
  EXPECT_EQ(backend.imageBarriers[1].srcQueueFamilyIndex, 1u);
  EXPECT_EQ(backend.imageBarriers[1].dstQueueFamilyIndex, 2u);
  EXPECT_EQ(backend.imageBarriers[2].srcQueueFamilyIndex, VK_QUEUE_FAMILY_IGNORED) << "two queues of one family";
}

TEST(CarriedOut, SplitBarriersAreEventsOfEachFrameInFlight) {
  FakeBackend backend;
  {
    HandMade executor(backend, 3);
    Graph graph;
    declareLinks(graph, 4);
    const auto split = [](Plan& plan) {
      // What step 3 waits for is set after step 0.
      plan.events = {{.setAfter = 0, .waitBefore = 3, .barriers = plan.passes[3].before}};
      plan.eventSets = {0};
      plan.passes[3].before = {};
      plan.passes[3].waits = {0, 1};
      plan.passes[0].sets = {0, 1};
    };
    for (int frame = 0; frame < 12; ++frame) executor.run(graph, split, 1 + frame % 3);
    EXPECT_EQ(backend.countLiving("event"), 3u);
    EXPECT_EQ(backend.count("set event"), 12u);
    EXPECT_EQ(backend.count("wait event"), 12u);
    const auto& lines = backend.submissions.back().lines;
    EXPECT_LT(std::ranges::find(lines, "set event"), std::ranges::find(lines, "label pass 1"));
    EXPECT_GT(std::ranges::find(lines, "wait event"), std::ranges::find(lines, "label pass 3"));
    executor.waitForAll();
  }
  EXPECT_THAT(backend.living, IsEmpty());
  expectClean(backend);
}

TEST(CarriedOut, MergedPassesShareOneRenderingOnAnyNumberOfThreads) {
  for (const uint32_t threads : {1u, 2u, 3u, 8u}) {
    FakeBackend backend;
    HandMade executor(backend);
    Graph graph;
    Image image = graph.createImage("image", kDesc);
    for (int i = 0; i < 6; ++i) {
      Pass pass = graph.addPass("pass", PassKind::raster);
      image = pass.color(image, {.load = i == 0 ? LoadOp::clear : LoadOp::load});
      pass.record([](PassContext& context) {
        EXPECT_EQ(context.colorFormats().size(), 1u);
        context.draw({.program = kRaster, .bindings = {}});
      });
    }
    graph.exportImage(image, kSampled);
    executor.run(
        graph,
        [](Plan& plan) {
          plan.passes[3].continuesRendering = false;  // Two groups of three.
        },
        threads);
    EXPECT_EQ(backend.count("rendering 64x32 layers 1 clear 0"), 2u);
    EXPECT_EQ(backend.count("end rendering"), 2u);
    EXPECT_EQ(backend.count("draw raster"), 6u);
    expectClean(backend);
  }
}

TEST(CarriedOut, ResolvesToTheMeanOrForIntegersToOneSample) {
  for (const VkFormat format : {VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32_UINT}) {
    FakeBackend backend;
    HandMade executor(backend);
    Graph graph;
    ImageDesc desc{.format = format, .width = 8, .height = 8, .samples = VK_SAMPLE_COUNT_4_BIT};
    Image samples = graph.createImage("samples", desc);
    desc.samples = VK_SAMPLE_COUNT_1_BIT;
    Image mean = graph.persistentImage("mean", desc);
    Pass pass = graph.addPass("pass", PassKind::raster);
    samples = pass.color(samples);
    mean = pass.resolve(mean);
    pass.record([](PassContext& context) {
      EXPECT_EQ(context.samples(), VK_SAMPLE_COUNT_4_BIT);
      context.draw({.program = kRaster, .bindings = {}});
    });
    executor.run(graph, [&](Plan& plan) {
      const PlannedAttachment color{.resource = samples.resource,
                                    .range = {0, 1, 0, 1, VK_IMAGE_ASPECT_COLOR_BIT},
                                    .layout = VK_IMAGE_LAYOUT_GENERAL,
                                    .resolve = 1};
      const PlannedAttachment target{
          .resource = mean.resource, .range = color.range, .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
      plan.attachments = {color, target};
      plan.passes[0].colors = {0, 1};
      plan.passes[0].depth = {};
    });
    ASSERT_EQ(backend.attachments.size(), 1u);
    const VkRenderingAttachmentInfo& info = backend.attachments[0];
    EXPECT_EQ(info.resolveMode,
              format == VK_FORMAT_R32_UINT ? VK_RESOLVE_MODE_SAMPLE_ZERO_BIT : VK_RESOLVE_MODE_AVERAGE_BIT);
    EXPECT_EQ(info.resolveImageLayout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    EXPECT_NE(info.resolveImageView, VkImageView(VK_NULL_HANDLE));
    EXPECT_EQ(backend.count("draw raster samples 4"), 1u);
  }
}

TEST(CarriedOut, ResourcesSharedByFamiliesAreMadeConcurrent) {
  FakeBackend backend;
  HandMade executor(backend);
  Graph graph;
  declareLinks(graph, 2);
  Image kept = graph.persistentImage("kept", kDesc);
  Pass pass = graph.addPass("keep", PassKind::compute);
  kept = pass.modify(kept, Usage::storage);
  executor.run(graph, [](Plan& plan) {
    plan.placements.at(0).concurrent = true;
    plan.persistent.at(0).concurrent = true;
  });
  std::vector<std::string> names;
  for (const uint64_t id : backend.concurrent) names.push_back(backend.living[id]);
  EXPECT_THAT(names, testing::UnorderedElementsAre("image image", "image kept"));
}

TEST(CarriedOut, DedicatedMemoryHoldsOneResourceAndIsNeverPooled) {
  FakeBackend backend;
  backend.dedicatedImages = true;  // Of persistent ones; the plan says it for its own.
  {
    HandMade executor(backend);
    Graph graph, other;
    const auto dedicate = [](Plan& plan) {
      for (PlannedHeap& heap : plan.heaps) heap.dedicated = true;
    };
    declareLinks(graph, 1);
    declareLinks(other, 2);
    Image kept = other.persistentImage("kept", kDesc);
    Pass pass = other.addPass("keep", PassKind::compute);
    kept = pass.modify(kept, Usage::storage);
    executor.run(graph, dedicate);
    EXPECT_EQ(backend.countLiving("dedicated heap"), 1u);
    executor.run(other, dedicate);
    EXPECT_EQ(backend.countLiving("dedicated heap"), 3u);
    EXPECT_EQ(backend.countLiving("heap"), 0u);
    executor.waitForAll();
  }
  EXPECT_THAT(backend.living, IsEmpty());
  expectClean(backend);
}

}  // namespace lensgraph
