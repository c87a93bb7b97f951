// Culling, order, lifetimes, load and store operations, and the purity of compile().
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/graph.h"
#include "support/random_graph.h"

namespace lensgraph {

using namespace rendergraph;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

const ImageDesc kDesc{.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 64, .height = 64};
const AccessState kSampled{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                           VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};

Plan planOf(const Graph& graph, CompileOptions options = {}) {
  return compile(graph.declaration(), options, NominalDevice());
}

std::vector<std::string> names(const Graph& graph, const Plan& plan) {
  std::vector<std::string> result;
  for (const PlannedPass& pass : plan.passes) result.emplace_back(graph.declaration().passes[pass.pass].name);
  return result;
}

/// A compute pass that samples some images and writes one.
Image step(Graph& graph, const char* name, std::initializer_list<Image> inputs, Image output) {
  Pass pass = graph.addPass(name, PassKind::compute);
  for (const Image& input : inputs) pass.sample(input);
  return pass.write(output, Usage::storage);
}

}  // namespace

TEST(Culling, KeepsOnlyWhatTheExportNeeds) {
  Graph graph;
  Image a = graph.createImage("a", kDesc), b = graph.createImage("b", kDesc), c = graph.createImage("c", kDesc);
  a = step(graph, "makeA", {}, a);
  b = step(graph, "makeB", {a}, b);
  c = step(graph, "makeC", {b}, c);
  Image d = step(graph, "makeD", {a}, graph.createImage("d", kDesc));
  graph.exportImage(d, kSampled);
  const Plan plan = planOf(graph);
  EXPECT_THAT(names(graph, plan), ElementsAre("makeA", "makeD"));
  ASSERT_EQ(plan.culled.size(), 2u);
  EXPECT_EQ(plan.culled[0].pass, 1u);
  EXPECT_THAT(plan.culled[0].reason, HasSubstr("'b' is read only by culled 'makeC'"));
  EXPECT_THAT(plan.culled[1].reason, HasSubstr("nothing reads what it writes to 'c'"));
  for (const Placement& placement : plan.placements) {  // No memory for what nobody makes.
    EXPECT_TRUE(placement.resource == a.resource || placement.resource == d.resource);
  }
}

TEST(Culling, ReplacedContentIsNotNeeded) {
  Graph graph;
  Image image = graph.createImage("image", kDesc);
  image = step(graph, "first", {}, image);
  image = step(graph, "second", {}, image);
  graph.exportImage(image, kSampled);
  EXPECT_THAT(names(graph, planOf(graph)), ElementsAre("second"));
}

TEST(Culling, WhatStaysOfAPartialWriteIsNeeded) {
  Graph graph;
  ImageDesc desc = kDesc;
  desc.mips = 2;
  Image image = graph.createImage("image", desc);
  Pass first = graph.addPass("first", PassKind::compute);
  image = first.write(image, Usage::storage);
  Pass second = graph.addPass("second", PassKind::compute);
  image = second.write(image, Usage::storage, mip(1));
  graph.exportImage(image, kSampled);
  EXPECT_THAT(names(graph, planOf(graph)), ElementsAre("first", "second"));
}

TEST(Culling, SideEffectsImportsAndPersistentContentLive) {
  Graph graph;
  Pass effect = graph.addPass("effect", PassKind::compute);
  effect.sideEffect();
  Image target = graph.importImage("target", kDesc, {.usage = VK_IMAGE_USAGE_STORAGE_BIT});
  target = step(graph, "import", {}, target);
  Image sum = graph.persistentImage("sum", kDesc);
  sum = step(graph, "persistent", {}, sum);
  graph.addPass("idle", PassKind::compute);
  const Plan plan = planOf(graph);
  EXPECT_THAT(names(graph, plan), ElementsAre("effect", "import", "persistent"));
  EXPECT_THAT(plan.culled[0].reason, HasSubstr("writes nothing"));
}

namespace {

/// Two chains, each a large intermediate that a small result comes from; declared large, large, small, small.
void declareTwoChains(Graph& graph) {
  ImageDesc large = kDesc;
  large.width = large.height = 1024;
  Image x = step(graph, "largeX", {}, graph.createImage("x", large));
  Image y = step(graph, "largeY", {}, graph.createImage("y", large));
  Image p = step(graph, "smallX", {x}, graph.createImage("p", kDesc));
  Image q = step(graph, "smallY", {y}, graph.createImage("q", kDesc));
  Image out = step(graph, "join", {p, q}, graph.createImage("out", kDesc));
  graph.exportImage(out, kSampled);
}

}  // namespace

TEST(Ordering, PoliciesDifferAsPromised) {
  Graph graph;
  declareTwoChains(graph);
  const Plan declared = planOf(graph, {.order = Order::declared});
  const Plan least = planOf(graph, {.order = Order::leastMemory});
  const Plan overlap = planOf(graph, {.order = Order::mostOverlap});
  EXPECT_THAT(names(graph, declared), ElementsAre("largeX", "largeY", "smallX", "smallY", "join"));
  EXPECT_THAT(names(graph, least), ElementsAre("largeX", "smallX", "largeY", "smallY", "join"));
  EXPECT_THAT(names(graph, overlap), ElementsAre("largeX", "largeY", "smallX", "smallY", "join"));
  EXPECT_LT(least.memory.peakBytes, declared.memory.peakBytes);
}

TEST(Ordering, LeastMemoryNeverNeedsMoreThanDeclared) {
  for (uint32_t seed = 0; seed < 300; ++seed) {
    Graph graph;
    declareRandom(graph, seed, 30);
    const Plan declared = planOf(graph, {.order = Order::declared});
    const Plan least = planOf(graph, {.order = Order::leastMemory});
    EXPECT_LE(least.memory.lowerBound, declared.memory.lowerBound) << "seed " << seed;
  }
}

TEST(Ordering, EqualDeclarationsGiveEqualPlans) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const CompileOptions options{.order = static_cast<Order>(seed % 3)};
    Graph first, second;
    declareRandom(first, seed, 60);
    declareRandom(second, seed, 10);
    second.reset();
    declareRandom(second, seed, 60);
    EXPECT_EQ(planOf(first, options), planOf(second, options));
    EXPECT_EQ(structuralHash(first.declaration(), options), structuralHash(second.declaration(), options));
  }
}

TEST(Attachments, StoreOnlyWhatIsReadLater) {
  Graph graph;
  Image color = graph.createImage("color", kDesc);
  Image depth = graph.createImage("depth", {.format = VK_FORMAT_D32_SFLOAT, .width = 64, .height = 64});
  Pass first = graph.addPass("first", PassKind::raster);
  color = first.color(color);
  depth = first.depth(depth);
  Pass second = graph.addPass("second", PassKind::raster);
  color = second.color(color, {.load = LoadOp::load});
  depth = second.depth(depth, {.load = LoadOp::load});
  graph.exportImage(color, kSampled);
  const Plan plan = compile(graph.declaration(), {.mergeRasterPasses = false}, NominalDevice());
  EXPECT_EQ(plan.colorsOf(plan.passes[0])[0].load, VK_ATTACHMENT_LOAD_OP_CLEAR);
  EXPECT_EQ(plan.depthOf(plan.passes[0])[0].store, VK_ATTACHMENT_STORE_OP_STORE);
  EXPECT_EQ(plan.colorsOf(plan.passes[1])[0].load, VK_ATTACHMENT_LOAD_OP_LOAD);
  EXPECT_EQ(plan.colorsOf(plan.passes[1])[0].store, VK_ATTACHMENT_STORE_OP_STORE);
  EXPECT_EQ(plan.depthOf(plan.passes[1])[0].store, VK_ATTACHMENT_STORE_OP_DONT_CARE);
}

TEST(Compile, UsageFlagsFollowFromLivingAccesses) {
  Graph graph;
  Image image = graph.createImage("image", kDesc);
  image = step(graph, "write", {}, image);
  Pass culled = graph.addPass("culled", PassKind::transfer);
  culled.read(image, Usage::transferSource);
  graph.exportImage(step(graph, "read", {image}, graph.createImage("out", kDesc)), kSampled);
  const Plan plan = planOf(graph);
  EXPECT_EQ(plan.placements[0].imageUsage, VkImageUsageFlags(VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT));
}

TEST(Compile, AMipChainIsBuiltInPlaceWithOneBarrierAStep) {
  Graph graph;
  ImageDesc desc = kDesc;
  desc.mips = 4;
  Image chain = graph.createImage("chain", desc);
  Pass first = graph.addPass("mip 0", PassKind::compute);
  chain = first.write(chain, Usage::storage, mip(0));
  for (uint32_t level = 1; level < 4; ++level) {
    Pass pass = graph.addPass("mip", PassKind::compute);
    pass.sample(chain, mip(level - 1));
    chain = pass.write(chain, Usage::storage, mip(level));
  }
  graph.exportImage(chain, kSampled);
  const Plan plan = planOf(graph);
  for (uint32_t level = 1; level < 4; ++level) {
    ASSERT_EQ(plan.passes[level].before.images.count, 2u);  // The mip that is read, the mip that is written.
    for (const ImageBarrier& barrier : plan.imagesOf(plan.passes[level].before)) {
      EXPECT_EQ(barrier.range.mipCount, 1u);
    }
  }
  const auto after = plan.imagesOf(plan.submissions.back().atEnd);
  ASSERT_EQ(after.size(), 1u);  // The others are in the layout and visible already.
  EXPECT_EQ(after[0].range.firstMip, 3u);
}

TEST(Compile, SeveralReadersWaitOnce) {
  Graph graph;
  Image image = step(graph, "write", {}, graph.createImage("image", kDesc));
  Image a = step(graph, "compute", {image}, graph.createImage("a", kDesc));
  Pass raster = graph.addPass("raster", PassKind::raster);
  raster.sample(image, {}, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
  Image b = raster.color(graph.createImage("b", kDesc));
  graph.exportImage(a, kSampled);
  graph.exportImage(b, kSampled);
  const Plan plan = planOf(graph);
  uint32_t barriers = 0;
  for (const PlannedPass& pass : plan.passes) {
    for (const ImageBarrier& barrier : plan.imagesOf(pass.before)) {
      if (barrier.resource != image.resource || barrier.from.stages == 0) continue;
      ++barriers;
      EXPECT_EQ(barrier.to.stages, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
    }
  }
  EXPECT_EQ(barriers, 1u);
}

namespace {

/// A declaration whose every field is a parameter, to change one at a time.
struct Fields {
  ImageDesc image{.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 64, .height = 64, .layers = 2, .mips = 2};
  BufferDesc buffer{.size = 64};
  ImportedImage imported{.image = VK_NULL_HANDLE,
                         .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                         .before = kSampled,
                         .after = kSampled};
  ImportedBuffer importedBuffer{.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT};
  AccessState after = kSampled;
  Subresources range = mip(0);
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  PassKind kind = PassKind::compute;
  LoadOp load = LoadOp::clear;
  QueuePreference queue = QueuePreference::graphics;
  VkExtent2D area = {8, 8};
  uint32_t areaLayers = 1;
  bool sideEffect = true, exported = true, persistent = false, modify = false, extraRead = false, disabled = false;
  const char* name = "image";
  float clear = 0.0f;
  CompileOptions options;

  uint64_t hash() const {
    Graph graph;
    Image a = persistent ? graph.persistentImage(name, image) : graph.createImage(name, image);
    Buffer b = graph.createBuffer("buffer", buffer);
    Image c = graph.importImage("import", {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 64, .height = 64}, imported);
    Buffer d = graph.importBuffer("import buffer", {.size = 64}, importedBuffer);
    Pass first = graph.addPass("first", kind);
    a = first.write(a, Usage::storage, range, stages);
    b = first.write(b, Usage::storage, stages);
    first.prefer(queue);
    if (sideEffect) first.sideEffect();
    Pass second = graph.addPass("second", PassKind::compute);
    second.sample(c);
    if (extraRead) second.sample(a, range);
    d = modify ? second.modify(d, Usage::storage) : second.write(d, Usage::storage);
    Pass raster = graph.addPass("raster", PassKind::raster);
    ImageDesc target{.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 16, .height = 16};
    [[maybe_unused]] const Image e =
        raster.color(graph.createImage("e", target), {.load = load, .clear = {{clear, 0, 0, 0}}});
    Pass stores = graph.addPass("stores", PassKind::raster);
    stores.renderArea(area, areaLayers);
    graph.addPass("optional", PassKind::compute).onlyIf(!disabled);
    if (exported) graph.exportImage(a, after);
    return structuralHash(graph.declaration(), options);
  }
};

}  // namespace

TEST(StructuralHash, MissesNoFieldThatThePlanDependsOn) {
  using Change = std::function<void(Fields&)>;
  const std::pair<const char*, Change> changes[] = {
      {"format", [](Fields& f) { f.image.format = VK_FORMAT_R16G16_SFLOAT; }},
      {"width", [](Fields& f) { f.image.width = 65; }},
      {"height", [](Fields& f) { f.image.height = 65; }},
      {"layers", [](Fields& f) { f.image.layers = 3; }},
      {"mips", [](Fields& f) { f.image.mips = 3; }},
      {"samples", [](Fields& f) { f.image.samples = VK_SAMPLE_COUNT_4_BIT; }},
      {"extra image usage", [](Fields& f) { f.image.extraUsage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT; }},
      {"buffer size", [](Fields& f) { f.buffer.size = 65; }},
      {"buffer memory", [](Fields& f) { f.buffer.memory = MemoryKind::readback; }},
      {"extra buffer usage", [](Fields& f) { f.buffer.extraUsage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT; }},
      {"import usage", [](Fields& f) { f.imported.usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT; }},
      {"before stages", [](Fields& f) { f.imported.before.stages = VK_PIPELINE_STAGE_2_COPY_BIT; }},
      {"before access", [](Fields& f) { f.imported.before.access = VK_ACCESS_2_TRANSFER_READ_BIT; }},
      {"before layout", [](Fields& f) { f.imported.before.layout = VK_IMAGE_LAYOUT_GENERAL; }},
      {"after stages", [](Fields& f) { f.imported.after.stages = VK_PIPELINE_STAGE_2_COPY_BIT; }},
      {"after access", [](Fields& f) { f.imported.after.access = VK_ACCESS_2_TRANSFER_READ_BIT; }},
      {"after layout", [](Fields& f) { f.imported.after.layout = VK_IMAGE_LAYOUT_GENERAL; }},
      {"import buffer usage", [](Fields& f) { f.importedBuffer.usage |= VK_BUFFER_USAGE_TRANSFER_SRC_BIT; }},
      {"import buffer before", [](Fields& f) { f.importedBuffer.before.stages = VK_PIPELINE_STAGE_2_COPY_BIT; }},
      {"import buffer after", [](Fields& f) { f.importedBuffer.after.stages = VK_PIPELINE_STAGE_2_COPY_BIT; }},
      {"export stages", [](Fields& f) { f.after.stages = VK_PIPELINE_STAGE_2_COPY_BIT; }},
      {"export access", [](Fields& f) { f.after.access = VK_ACCESS_2_TRANSFER_READ_BIT; }},
      {"export layout", [](Fields& f) { f.after.layout = VK_IMAGE_LAYOUT_GENERAL; }},
      {"mip range", [](Fields& f) { f.range = mip(1); }},
      {"layer range", [](Fields& f) { f.range.layerCount = 1; }},
      {"stages", [](Fields& f) { f.stages |= VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT; }},
      {"kind", [](Fields& f) { f.kind = PassKind::transfer; }},
      {"load", [](Fields& f) { f.load = LoadOp::dontCare; }},
      {"queue", [](Fields& f) { f.queue = QueuePreference::asyncCompute; }},
      {"render area", [](Fields& f) { f.area.height = 9; }},
      {"render layers", [](Fields& f) { f.areaLayers = 2; }},
      {"side effect", [](Fields& f) { f.sideEffect = false; }},
      {"exported", [](Fields& f) { f.exported = false; }},
      {"origin", [](Fields& f) { f.persistent = true; }},
      {"mode", [](Fields& f) { f.modify = true; }},
      {"another access", [](Fields& f) { f.extraRead = true; }},
      {"order", [](Fields& f) { f.options.order = Order::leastMemory; }},
      {"memory budget", [](Fields& f) { f.options.memoryBudget = 1.5f; }},
      {"disabled", [](Fields& f) { f.disabled = true; }},
      {"barrier placement", [](Fields& f) { f.options.barriers = BarrierTiming::fewestBatches; }},
      {"split distance", [](Fields& f) { f.options.splitDistance = 2; }},
      {"merging", [](Fields& f) { f.options.mergeRasterPasses = false; }},
      {"queues", [](Fields& f) { f.options.useQueues = false; }},
      {"overlapping frames", [](Fields& f) { f.options.overlappingFrames = true; }},
      {"aliasing none", [](Fields& f) { f.options.aliasing = Aliasing::none; }},
      {"aliasing fast", [](Fields& f) { f.options.aliasing = Aliasing::fast; }},
  };
  std::map<uint64_t, std::string> seen{{Fields{}.hash(), "nothing"}};
  for (const auto& [what, change] : changes) {
    Fields fields;
    change(fields);
    const auto [found, added] = seen.emplace(fields.hash(), what);
    EXPECT_TRUE(added) << what << " hashes like " << found->second;
  }
}

TEST(StructuralHash, IgnoresNamesValuesAndTheHostsObjects) {
  const uint64_t hash = Fields{}.hash();
  Fields fields;
  fields.name = "another";
  fields.clear = 1.0f;
  fields.imported.image = reinterpret_cast<VkImage>(uint64_t{42});
  fields.importedBuffer.buffer = reinterpret_cast<VkBuffer>(uint64_t{43});
  EXPECT_EQ(fields.hash(), hash);
}

TEST(Graph, DestroysRecordingsOnResetAndAtItsEnd) {
  struct Counter {
    explicit Counter(int& living) : living(&living) { ++living; }
    Counter(const Counter& other) : living(other.living) { ++*living; }
    ~Counter() { --*living; }
    void operator()(PassContext&) const {}
    int* living;
  };
  int living = 0;
  {
    Graph graph;
    graph.addPass("a", PassKind::compute).record(Counter(living));
    EXPECT_EQ(living, 1);
    graph.reset();
    EXPECT_EQ(living, 0);
    Pass pass = graph.addPass("b", PassKind::compute);
    pass.record(Counter(living));
    pass.record(Counter(living));
    EXPECT_EQ(living, 1);
    Graph moved = std::move(graph);
    EXPECT_EQ(living, 1);
  }
  EXPECT_EQ(living, 0);
}

}  // namespace lensgraph
