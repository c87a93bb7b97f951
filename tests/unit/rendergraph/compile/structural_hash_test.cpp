// The key of the plan cache: every field that a plan depends on changes it, and nothing else does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/graph.h"
#include "support/small_graphs.h"

namespace lensgraph {

using namespace rendergraph;
using namespace small_graphs;

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

}  // namespace lensgraph
