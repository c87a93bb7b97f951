// A chain of calls declares accesses, binds them in the order of the calls, and dispatches once; its errors name the pass,
// the resource and the source line of the call.
#include "rendergraph/compute_pass.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <functional>
#include <optional>
#include <string>

#include "allocation_count.h"
#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/executor.h"
#include "support/fake_backend.h"

namespace lensgraph {

using namespace rendergraph;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

const ComputeProgram kProgram{.name = "program", .shader = {}};
const ImageDesc kDesc{.format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = 64, .height = 32, .mips = 3};

/// A graph with content to read, and a backend that keeps what was dispatched last.
struct OnePass {
  FakeBackend backend;
  Executor executor{backend};
  Graph graph;
  Image image = graph.persistentImage("image", kDesc);
  Buffer first = graph.persistentBuffer("first", {.size = 64});
  Buffer second = graph.persistentBuffer("second", {.size = 64});

  uint64_t bufferOf(std::size_t binding) const { return FakeBackend::idOf(backend.bindings.at(binding).buffer); }
};

std::optional<GraphError> errorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const GraphError& error) {
    return error;
  }
  return std::nullopt;
}

std::optional<GraphError> errorOfCompile(const Graph& graph) {
  return errorOf([&] { compile(graph.declaration(), {}, NominalDevice()); });
}

}  // namespace

TEST(ComputePass, BindsItsAccessesInTheOrderOfTheCalls) {
  OnePass one;
  Buffer result = one.graph.persistentBuffer("result", {.size = 64});
  const Buffer constants = one.graph.persistentBuffer("constants", {.size = 16});
  compute(one.graph, "pass", kProgram)
      .read(one.first)
      .sample(one.image, kNearest, mip(1))
      .modify(result)
      .uniform(constants)
      .read(one.image, mip(0))
      .groups({.x = 3, .y = 2});
  one.executor.execute(one.graph);

  using Kind = Binding::Kind;
  ASSERT_EQ(one.backend.bindings.size(), 5u);
  std::vector<Kind> kinds;
  for (const ResolvedBinding& binding : one.backend.bindings) kinds.push_back(binding.kind);
  EXPECT_THAT(kinds, ElementsAre(Kind::storageBuffer, Kind::sampledImage, Kind::storageBuffer, Kind::uniformBuffer,
                                 Kind::storageImage));
  EXPECT_EQ(one.backend.bindings[1].sampler, kNearest);
  EXPECT_NE(one.bufferOf(0), one.bufferOf(2));
  EXPECT_EQ(one.backend.count("dispatch program"), 1u);
  EXPECT_EQ(one.backend.dispatched.groups.x, 3u);
  EXPECT_EQ(one.backend.dispatched.groups.y, 2u);
}

TEST(ComputePass, DeclaresWhatALongFormDeclares) {
  const auto state = [](const auto& declare) {
    Graph graph;
    Image image = graph.persistentImage("image", kDesc);
    Buffer buffer = graph.persistentBuffer("buffer", {.size = 64});
    declare(graph, image, buffer);
    return structuralHash(graph.declaration(), CompileOptions{});
  };
  EXPECT_EQ(state([](Graph& graph, Image image, Buffer buffer) {
              compute(graph, "pass", kProgram).sample(image, {}, mip(0)).write(image, mip(1)).modify(buffer).groups({});
            }),
            state([](Graph& graph, Image image, Buffer buffer) {
              Pass pass = graph.addPass("pass", PassKind::compute);
              pass.sample(image, mip(0));
              image = pass.write(image, Usage::storage, mip(1));
              buffer = pass.modify(buffer, Usage::storage);
            }));
}

TEST(ComputePass, GivesBackTheHandlesOfItsResults) {
  OnePass one;
  const Image before = one.image;
  const Buffer bufferBefore = one.first;
  compute(one.graph, "level", kProgram).read(one.image, mip(0)).write(one.image, mip(1)).modify(one.first).groups({});
  EXPECT_EQ(one.image.resource, before.resource);
  EXPECT_EQ(one.image.version, before.version + 1);
  EXPECT_EQ(one.first.version, bufferBefore.version + 1);
  EXPECT_FALSE(errorOfCompile(one.graph));
  const auto error = errorOf([&] {
    compute(one.graph, "late", kProgram).read(before, mip(0)).groups({});
    compile(one.graph.declaration(), {}, NominalDevice());
  });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->misuse(), Misuse::staleVersion);
}

TEST(ComputePass, CopiesConstants) {
  OnePass one;
  struct Push {
    float a;
    uint32_t b;
  };
  enum class Mode : uint8_t { slow, fast };
  {
    Push push{.a = 1.5f, .b = 7};
    auto pass = compute(one.graph, "pass", kProgram);
    pass.modify(one.first).push(push).specialize({true, 5, Mode::fast, 0.25f, uint32_t{9}, -1});
    pass.read(one.second).groups({});  // A binding after constants: the list has to move in the arena.
    push = {};
  }
  one.executor.execute(one.graph);
  Push pushed{};
  ASSERT_EQ(one.backend.dispatched.pushConstants.size(), sizeof pushed);
  std::memcpy(&pushed, one.backend.dispatched.pushConstants.data(), sizeof pushed);
  EXPECT_EQ(pushed.a, 1.5f);
  EXPECT_EQ(pushed.b, 7u);
  EXPECT_THAT(one.backend.dispatched.specialization,
              ElementsAre(1u, 5u, 1u, std::bit_cast<uint32_t>(0.25f), 9u, UINT32_MAX));
  ASSERT_EQ(one.backend.bindings.size(), 2u);
  EXPECT_NE(one.bufferOf(0), one.bufferOf(1));
}

TEST(ComputePass, TakesItsGroupsFromABuffer) {
  OnePass one;
  compute(one.graph, "pass", kProgram).modify(one.first).indirect(one.second, 16);
  one.executor.execute(one.graph);
  EXPECT_NE(one.backend.dispatched.indirect, VkBuffer{VK_NULL_HANDLE});
  EXPECT_NE(FakeBackend::idOf(one.backend.dispatched.indirect), one.bufferOf(0));
  EXPECT_EQ(one.backend.dispatched.indirectOffset, 16u);
  EXPECT_EQ(one.backend.bindings.size(), 1u);
}

TEST(ComputePass, APlaceholderBindsTheStorageBufferBeforeIt) {
  OnePass one;
  compute(one.graph, "pass", kProgram)
      .read(one.first)
      .modify(one.second)
      .read(one.image, mip(0))
      .placeholder()
      .groups({});
  one.executor.execute(one.graph);
  ASSERT_EQ(one.backend.bindings.size(), 4u);
  EXPECT_EQ(one.backend.bindings[3].kind, Binding::Kind::storageBuffer);
  EXPECT_EQ(one.bufferOf(3), one.bufferOf(1));
}

TEST(ComputePass, APlaceholderWithoutAStorageBufferIsReported) {
  OnePass one;
  auto pass = compute(one.graph, "lonely", kProgram);
  pass.modify(one.image, mip(0));
  const uint32_t line = __LINE__ + 1;
  pass.placeholder();
  pass.groups({});
  const auto error = errorOfCompile(one.graph);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->problems()[0].where.line(), line);
  EXPECT_THAT(error->what(), HasSubstr("pass 'lonely'"));
  EXPECT_THAT(error->what(), HasSubstr("bind a storage buffer before"));
}

TEST(ComputePass, WithoutAnEndIsRefusedByName) {
  OnePass one;
  const uint32_t line = __LINE__ + 1;
  auto pass = compute(one.graph, "endless", kProgram);
  pass.modify(one.first);
  for (const auto& error : {errorOfCompile(one.graph), errorOf([&] { one.executor.execute(one.graph); })}) {
    ASSERT_TRUE(error);
    EXPECT_EQ(error->misuse(), Misuse::unfinishedPass);
    EXPECT_EQ(error->problems().size(), 1u);
    EXPECT_EQ(error->problems()[0].pass, "endless");
    EXPECT_EQ(error->problems()[0].where.line(), line);
    EXPECT_THAT(error->what(), HasSubstr("end it with groups() or indirect()"));
  }
  pass.groups({});
  one.executor.execute(one.graph);
  EXPECT_EQ(one.backend.count("dispatch program"), 1u);
}

TEST(ComputePass, WithoutAnEndIsRefusedThoughItsPlanIsKnown) {
  OnePass one;
  const auto declare = [&](bool ends) {
    one.graph.reset();
    Buffer buffer = one.graph.persistentBuffer("buffer", {.size = 64});
    auto pass = compute(one.graph, "pass", kProgram);
    pass.modify(buffer);
    if (ends) pass.groups({});
  };
  declare(true);
  one.executor.execute(one.graph);
  declare(false);
  EXPECT_TRUE(errorOf([&] { one.executor.execute(one.graph); }));
  declare(true);
  one.executor.execute(one.graph);
  EXPECT_EQ(one.backend.count("dispatch program"), 2u);
}

TEST(ComputePass, ErrorsNameTheCall) {
  OnePass one;
  const Image empty = one.graph.createImage("empty", {.format = kDesc.format, .width = 8, .height = 8});
  auto pass = compute(one.graph, "reader", kProgram);
  pass.modify(one.first);
  const uint32_t line = __LINE__ + 1;
  pass.read(empty);
  pass.groups({});
  const auto error = errorOfCompile(one.graph);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->misuse(), Misuse::unwrittenRead);
  EXPECT_EQ(error->problems()[0].pass, "reader");
  EXPECT_EQ(error->problems()[0].resource, "empty");
  EXPECT_EQ(error->problems()[0].where.line(), line);
  EXPECT_THAT(error->problems()[0].where.file_name(), HasSubstr("compute_pass_test.cpp"));
}

TEST(ComputePass, UnknownHandlesThrowAtTheCall) {
  OnePass one;
  const auto error = errorOf([&] { compute(one.graph, "pass", kProgram).read(Buffer{}).groups({}); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->misuse(), Misuse::unknownHandle);
  EXPECT_EQ(error->problems()[0].pass, "pass");
}

TEST(ComputePass, AViewThatNoShaderCanHaveIsRefused) {
  OnePass one;
  const Image layers =
      one.graph.persistentImage("layers", {.format = kDesc.format, .width = 8, .height = 8, .layers = 2});
  auto pass = compute(one.graph, "pass", kProgram);
  const uint32_t line = __LINE__ + 1;
  pass.modify(one.image);
  pass.read(layers).read(one.first).groups({});
  const auto error = errorOfCompile(one.graph);
  ASSERT_TRUE(error);
  ASSERT_EQ(error->problems().size(), 2u);
  for (const GraphError::Problem& problem : error->problems()) EXPECT_EQ(problem.misuse, Misuse::subresourceRange);
  EXPECT_EQ(error->problems()[0].resource, "image");
  EXPECT_EQ(error->problems()[0].where.line(), line);
  EXPECT_THAT(error->what(), HasSubstr("name one mip"));
  EXPECT_EQ(error->problems()[1].resource, "layers");
  EXPECT_THAT(error->what(), HasSubstr("2D_ARRAY"));
}

TEST(ComputePass, SamplesTheDepthOfADepthStencilImage) {
  OnePass one;
  const Image depth =
      one.graph.persistentImage("depth", {.format = VK_FORMAT_D32_SFLOAT_S8_UINT, .width = 8, .height = 8});
  compute(one.graph, "pass", kProgram).sample(depth, kNearest).modify(one.first).groups({});
  one.executor.execute(one.graph);
  EXPECT_EQ(one.backend.bindings[0].layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  EXPECT_EQ(one.backend.countLiving("view"), 1u);
  EXPECT_EQ(one.backend.viewedAspects, VkImageAspectFlags{VK_IMAGE_ASPECT_DEPTH_BIT});
}

TEST(ComputePass, LeftOutByItsConditionKeepsTheContentFromBefore) {
  OnePass one;
  const Buffer before = one.first;
  compute(one.graph, "pass", kProgram).onlyIf(false).modify(one.first).groups({});
  EXPECT_EQ(one.first.version, before.version);
  one.executor.execute(one.graph);
  EXPECT_EQ(one.backend.count("dispatch program"), 0u);
}

TEST(ComputePass, PrefersAQueueAndHasSideEffects) {
  OnePass one;
  compute(one.graph, "pass", kProgram).prefer(QueuePreference::asyncCompute).sideEffect().read(one.first).groups({});
  EXPECT_EQ(one.graph.declaration().passes[0].queue, QueuePreference::asyncCompute);
  one.executor.execute(one.graph);
  EXPECT_EQ(one.backend.count("dispatch program"), 1u);
}

TEST(ComputePass, ASteadyFrameAllocatesNothing) {
  OnePass one;
  one.backend.silent = true;
  const auto frame = [&] {
    one.graph.reset();
    Buffer buffer = one.graph.persistentBuffer("buffer", {.size = 64});
    for (int i = 0; i < 20; ++i) {
      compute(one.graph, "pass", kProgram).modify(buffer).placeholder().push(kDesc).specialize({1, 2.0f}).groups({});
    }
    one.executor.execute(one.graph);
  };
  for (int warmUp = 0; warmUp < 10; ++warmUp) frame();
  const uint64_t before = test_support::allocationsSoFar();
  for (int i = 0; i < 20; ++i) frame();
  EXPECT_EQ(test_support::allocationsSoFar() - before, 0u);
}

}  // namespace lensgraph
