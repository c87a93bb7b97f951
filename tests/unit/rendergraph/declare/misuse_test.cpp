// Every kind of misuse: found, named, and told what to do about it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/graph.h"

namespace lensgraph {

using namespace rendergraph;
using testing::HasSubstr;

namespace {

const ImageDesc kColor{.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 64, .height = 64};
const ImageDesc kDepth{.format = VK_FORMAT_D32_SFLOAT, .width = 64, .height = 64};
const AccessState kSampled{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                           VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};

/// The problems of a declaration.
std::vector<GraphError::Problem> problemsOf(const std::function<void(Graph&)>& declare) {
  Graph graph;
  try {
    declare(graph);
    compile(graph.declaration(), {}, NominalDevice());
  } catch (const GraphError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.problems();
  }
  return {};
}

/// Expects exactly one problem, with these names in it.
void expectProblem(Misuse misuse, const char* pass, const char* resource, const char* remedy,
                   const std::function<void(Graph&)>& declare) {
  const std::vector<GraphError::Problem> problems = problemsOf(declare);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].misuse, misuse) << nameOf(problems[0].misuse);
  EXPECT_EQ(problems[0].pass, pass);
  EXPECT_EQ(problems[0].resource, resource);
  EXPECT_THAT(problems[0].remedy, HasSubstr(remedy));
  EXPECT_FALSE(problems[0].reason.empty());
  const std::string text = GraphError(problems).what();
  EXPECT_THAT(text, HasSubstr(problems[0].reason));
  EXPECT_THAT(text, HasSubstr(problems[0].remedy));
  EXPECT_THAT(text, HasSubstr("misuse_test.cpp"));
}

}  // namespace

TEST(Misuse, UnwrittenRead) {
  expectProblem(Misuse::unwrittenRead, "reader", "empty", "earlier pass", [](Graph& graph) {
    const Image empty = graph.createImage("empty", kColor);
    Pass pass = graph.addPass("reader", PassKind::compute);
    pass.sample(empty);
  });
}

TEST(Misuse, UnwrittenMipIsAnUnwrittenRead) {
  expectProblem(Misuse::unwrittenRead, "reader", "chain", "earlier pass", [](Graph& graph) {
    ImageDesc desc = kColor;
    desc.mips = 3;
    Image chain = graph.createImage("chain", desc);
    Pass writer = graph.addPass("writer", PassKind::compute);
    chain = writer.write(chain, Usage::storage, {.firstMip = 0, .mipCount = 2});
    Pass reader = graph.addPass("reader", PassKind::compute);
    reader.sample(chain);
  });
}

TEST(Misuse, ModifyOfUnwrittenContent) {
  expectProblem(Misuse::unwrittenRead, "counter", "counts", "clear", [](Graph& graph) {
    Buffer counts = graph.createBuffer("counts", {.size = 64});
    Pass pass = graph.addPass("counter", PassKind::compute);
    counts = pass.modify(counts, Usage::storage);
  });
}

TEST(Misuse, ExportOfUnwrittenContent) {
  expectProblem(Misuse::unwrittenRead, "", "empty", "before the export", [](Graph& graph) {
    const Image empty = graph.createImage("empty", kColor);
    graph.exportImage(empty, kSampled);
  });
}

TEST(Misuse, StaleVersion) {
  expectProblem(Misuse::staleVersion, "reader", "image", "last write returned", [](Graph& graph) {
    const Image first = graph.createImage("image", kColor);
    Pass writer = graph.addPass("writer", PassKind::compute);
    const Image second = writer.write(first, Usage::storage);
    EXPECT_NE(first, second);
    Pass reader = graph.addPass("reader", PassKind::compute);
    reader.sample(first);
  });
}

TEST(Misuse, StaleExport) {
  expectProblem(Misuse::staleVersion, "", "image", "last write returned", [](Graph& graph) {
    const Image first = graph.createImage("image", kColor);
    Pass writer = graph.addPass("writer", PassKind::compute);
    [[maybe_unused]] const Image second = writer.write(first, Usage::storage);
    graph.exportImage(first, kSampled);
  });
}

TEST(Misuse, HistoryPreviousIsReadOnly) {
  expectProblem(Misuse::staleVersion, "pass", "past (previous)", "History::next", [](Graph& graph) {
    const History past = graph.history("past", kColor);
    Pass pass = graph.addPass("pass", PassKind::compute);
    [[maybe_unused]] const Image image = pass.write(past.previous, Usage::storage);
  });
}

TEST(Misuse, DoubleWrite) {
  expectProblem(Misuse::doubleWrite, "pass", "image", "split the pass", [](Graph& graph) {
    Image image = graph.createImage("image", kColor);
    Pass pass = graph.addPass("pass", PassKind::compute);
    image = pass.write(image, Usage::storage);
    image = pass.write(image, Usage::storage);
  });
}

TEST(Misuse, DoubleWriteWithAnotherPassInBetween) {
  const auto problems = problemsOf([](Graph& graph) {
    Image image = graph.createImage("image", kColor);
    Pass first = graph.addPass("first", PassKind::compute);
    Pass second = graph.addPass("second", PassKind::compute);
    image = first.write(image, Usage::storage);
    second.sample(image);
    image = first.write(image, Usage::storage);
  });
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems[0].misuse, Misuse::doubleWrite) << nameOf(problems[0].misuse);
  EXPECT_EQ(problems[0].pass, "first");
}

TEST(Misuse, WritesOfDifferentLayersAreNoDoubleWrite) {
  EXPECT_TRUE(problemsOf([](Graph& graph) {
                ImageDesc desc = kColor;
                desc.layers = 2;
                Image image = graph.createImage("image", desc);
                Pass pass = graph.addPass("pass", PassKind::compute);
                image = pass.write(image, Usage::storage, layer(0));
                image = pass.write(image, Usage::storage, layer(1));
              }).empty());
}

TEST(Misuse, FeedbackLoopOfAnAttachment) {
  expectProblem(Misuse::doubleWrite, "pass", "image", "copy", [](Graph& graph) {
    Image image = graph.persistentImage("image", kColor);
    Pass pass = graph.addPass("pass", PassKind::raster);
    pass.sample(image);
    image = pass.color(image, {.load = LoadOp::load});
  });
}

TEST(Misuse, PersistentNameTwice) {
  expectProblem(Misuse::doubleWrite, "", "sum", "different names", [](Graph& graph) {
    graph.persistentImage("sum", kColor);
    graph.persistentBuffer("sum", {.size = 4});
  });
}

TEST(Misuse, SizeMismatchOfAttachments) {
  expectProblem(Misuse::sizeMismatch, "pass", "small", "same size", [](Graph& graph) {
    Image large = graph.createImage("large", kColor);
    ImageDesc desc = kColor;
    desc.width = 32;
    Image small = graph.createImage("small", desc);
    Pass pass = graph.addPass("pass", PassKind::raster);
    large = pass.color(large);
    small = pass.color(small);
  });
}

TEST(Misuse, LayerCountMismatchOfAttachments) {
  expectProblem(Misuse::sizeMismatch, "pass", "depth", "layer count", [](Graph& graph) {
    ImageDesc desc = kColor;
    desc.layers = 4;
    Image layers = graph.createImage("layers", desc);
    Image depth = graph.createImage("depth", kDepth);
    Pass pass = graph.addPass("pass", PassKind::raster);
    layers = pass.color(layers);
    depth = pass.depth(depth);
  });
}

TEST(Misuse, RasterPassWithoutRenderArea) {
  expectProblem(Misuse::sizeMismatch, "pass", "", "renderArea()", [](Graph& graph) {
    Pass pass = graph.addPass("pass", PassKind::raster);
    pass.sideEffect();
  });
}

TEST(Misuse, FormatMismatch) {
  expectProblem(Misuse::formatMismatch, "pass", "depth", "depth()", [](Graph& graph) {
    Image depth = graph.createImage("depth", kDepth);
    Pass pass = graph.addPass("pass", PassKind::raster);
    depth = pass.color(depth);
  });
  expectProblem(Misuse::formatMismatch, "pass", "color", "depth format", [](Graph& graph) {
    Image color = graph.createImage("color", kColor);
    Pass pass = graph.addPass("pass", PassKind::raster);
    color = pass.depth(color);
  });
}

TEST(Misuse, MissingUsageOfAnImport) {
  expectProblem(Misuse::missingUsage, "pass", "target", "add the flag", [](Graph& graph) {
    Image target = graph.importImage("target", kColor, {.usage = VK_IMAGE_USAGE_SAMPLED_BIT});
    Pass pass = graph.addPass("pass", PassKind::compute);
    target = pass.write(target, Usage::storage);
  });
}

TEST(Misuse, AUsageThatTheResourceCannotHaveIsReported) {
  expectProblem(Misuse::missingUsage, "pass", "image", "choose a usage", [](Graph& graph) {
    Image image = graph.createImage("image", kColor);
    Pass pass = graph.addPass("pass", PassKind::compute);
    image = pass.write(image, Usage::sampled);
  });
  expectProblem(Misuse::missingUsage, "pass", "buffer", "MemoryKind::upload", [](Graph& graph) {
    Buffer buffer = graph.createBuffer("buffer", {.size = 4});
    Pass pass = graph.addPass("pass", PassKind::host);
    buffer = pass.write(buffer, Usage::host);
  });
  expectProblem(Misuse::missingUsage, "pass", "image", "PassKind::raster", [](Graph& graph) {
    Image image = graph.createImage("image", kColor);
    Pass pass = graph.addPass("pass", PassKind::compute);
    image = pass.color(image);
  });
  expectProblem(Misuse::missingUsage, "pass", "image", "compute or raster", [](Graph& graph) {
    const Image image = graph.persistentImage("image", kColor);
    Pass pass = graph.addPass("pass", PassKind::transfer);
    pass.sample(image);
  });
}

TEST(Misuse, Cycle) {
  const auto problems = problemsOf([](Graph& graph) {
    Image a = graph.createImage("a", kColor), b = graph.createImage("b", kColor);
    Pass first = graph.addPass("first", PassKind::compute);
    Pass second = graph.addPass("second", PassKind::compute);
    a = first.write(a, Usage::storage);
    second.sample(a);
    b = second.write(b, Usage::storage);
    first.sample(b);
    first.sideEffect();
  });
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].misuse, Misuse::cycle);
  EXPECT_EQ(problems[0].pass, "first");
  EXPECT_THAT(problems[0].reason, HasSubstr("'first', 'second'"));
}

TEST(Misuse, UnknownHandle) {
  expectProblem(Misuse::unknownHandle, "pass", "", "handle that the graph returned", [](Graph& graph) {
    Pass pass = graph.addPass("pass", PassKind::compute);
    pass.sample(Image{});
  });
  Graph graph;
  Image image = graph.createImage("image", kColor);
  image.resource = 5;
  EXPECT_THROW(graph.desc(image), GraphError);
}

TEST(Misuse, ForeignHandle) {
  Graph other;
  const Image foreign = other.createImage("image", kColor);
  expectProblem(Misuse::foreignHandle, "pass", "", "in this graph", [&](Graph& graph) {
    graph.createImage("image", kColor);
    Pass pass = graph.addPass("pass", PassKind::compute);
    pass.sample(foreign);
  });
}

TEST(Misuse, HandleFromBeforeReset) {
  expectProblem(Misuse::foreignHandle, "pass", "", "in this graph", [](Graph& graph) {
    const Image old = graph.createImage("image", kColor);
    graph.reset();
    graph.createImage("image", kColor);
    Pass pass = graph.addPass("pass", PassKind::compute);
    pass.sample(old);
  });
}

TEST(Misuse, OverLimit) {
  ImageDesc desc = kColor;
  desc.width = 20000;
  expectProblem(Misuse::overLimit, "", "wide", "16384", [&](Graph& graph) { graph.createImage("wide", desc); });
  desc = kColor;
  desc.layers = 5000;
  expectProblem(Misuse::overLimit, "", "deep", "2048", [&](Graph& graph) { graph.createImage("deep", desc); });
  desc = kColor;
  desc.height = 0;
  expectProblem(Misuse::overLimit, "", "flat", "at least 1", [&](Graph& graph) { graph.createImage("flat", desc); });
  desc = kColor;
  desc.mips = 8;
  expectProblem(Misuse::overLimit, "", "chain", "at most 7", [&](Graph& graph) { graph.createImage("chain", desc); });
  expectProblem(Misuse::overLimit, "", "huge", "2147483648",
                [&](Graph& graph) { graph.createBuffer("huge", {.size = VkDeviceSize{1} << 32}); });
  expectProblem(Misuse::overLimit, "", "none", "one byte", [&](Graph& graph) { graph.createBuffer("none", {}); });
}

/// A device that binds less of a buffer than it can make.
class NarrowBindings : public NominalDevice {
 public:
  VkDeviceSize maxStorageRange() const override { return 1024; }
  VkDeviceSize maxUniformRange() const override { return 256; }
};

TEST(Misuse, OnlyWhatIsBoundMustFitABinding) {
  const auto problemOf = [](VkDeviceSize size, Usage usage, bool isCopied) -> std::string {
    Graph graph;
    Buffer buffer = graph.createBuffer("buffer", {.size = size});
    if (isCopied) {
      Pass fill = graph.addPass("fill", PassKind::transfer);
      buffer = fill.write(buffer, Usage::transferDestination);
    }
    Pass pass = graph.addPass("pass", PassKind::compute);
    if (usage == Usage::uniform) pass.read(buffer, usage);
    if (usage == Usage::storage) graph.exportBuffer(pass.write(buffer, usage), {});
    try {
      compile(graph.declaration(), {}, NarrowBindings());
    } catch (const GraphError& error) {
      EXPECT_EQ(error.misuse(), Misuse::overLimit);
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(problemOf(1024, Usage::storage, false), "");
  EXPECT_THAT(problemOf(1025, Usage::storage, false), HasSubstr("bound as storage buffer, and its size of 1025"));
  EXPECT_EQ(problemOf(256, Usage::uniform, true), "");
  EXPECT_THAT(problemOf(257, Usage::uniform, true), HasSubstr("stay within 256"));
  EXPECT_EQ(problemOf(VkDeviceSize{1} << 30, Usage::transferSource, true), "") << "copied, never bound";
}

TEST(Misuse, ImportState) {
  expectProblem(Misuse::importState, "pass", "target", "layout in which the host left it", [](Graph& graph) {
    const Image target = graph.importImage("target", kColor, {.usage = VK_IMAGE_USAGE_SAMPLED_BIT});
    Pass pass = graph.addPass("pass", PassKind::compute);
    pass.sample(target);
  });
  expectProblem(Misuse::importState, "", "target", "pipeline stages", [](Graph& graph) {
    graph.importImage("target", kColor, {.before = {0, VK_ACCESS_2_MEMORY_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL}});
  });
  expectProblem(Misuse::importState, "", "image", "name the layout", [](Graph& graph) {
    Image image = graph.createImage("image", kColor);
    Pass pass = graph.addPass("pass", PassKind::compute);
    image = pass.write(image, Usage::storage);
    graph.exportImage(image, {});
  });
}

TEST(Misuse, SubresourceRange) {
  expectProblem(Misuse::subresourceRange, "pass", "image", "that the image has", [](Graph& graph) {
    Image image = graph.createImage("image", kColor);
    Pass pass = graph.addPass("pass", PassKind::compute);
    image = pass.write(image, Usage::storage, mip(1));
  });
  expectProblem(Misuse::subresourceRange, "pass", "image", "that the image has", [](Graph& graph) {
    Image image = graph.createImage("image", kColor);
    Pass pass = graph.addPass("pass", PassKind::compute);
    image = pass.write(image, Usage::storage, {.firstLayer = 0, .layerCount = UINT32_MAX - 1});
  });
  expectProblem(Misuse::subresourceRange, "pass", "chain", "one mip", [](Graph& graph) {
    ImageDesc desc = kColor;
    desc.mips = 2;
    Image chain = graph.createImage("chain", desc);
    Pass pass = graph.addPass("pass", PassKind::raster);
    chain = pass.color(chain, {.range = {}});
  });
}

TEST(Misuse, AllProblemsAreReportedTogether) {
  const auto problems = problemsOf([](Graph& graph) {
    Image image = graph.createImage("image", kColor);
    const Image empty = graph.createImage("empty", kColor);
    Pass pass = graph.addPass("pass", PassKind::compute);
    image = pass.write(image, Usage::storage, mip(3));
    pass.sample(empty);
    graph.createBuffer("none", {});
  });
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_EQ(problems[0].misuse, Misuse::subresourceRange);
  EXPECT_EQ(problems[1].misuse, Misuse::overLimit);
  EXPECT_EQ(problems[2].misuse, Misuse::unwrittenRead);
}

TEST(Misuse, EveryKindHasAName) {
  for (int i = 0; i <= static_cast<int>(Misuse::device); ++i) {
    EXPECT_NE(nameOf(static_cast<Misuse>(i)), "?");
  }
}

}  // namespace lensgraph
