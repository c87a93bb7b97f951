// The example of rendergraph/README.md: it compiles, does what the text says, and the README shows it as it stands here.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "support/fake_backend.h"

// clang-format off
// [example]
#include "rendergraph/executor.h"
#include "rendergraph/graph.h"

using namespace lensgraph::rendergraph;

const ComputeProgram kBright{.name = "bright", .shader = {}}, kBlur{.name = "blur", .shader = {}},
    kAdd{.name = "add", .shader = {}};  // .shader: your SPIR-V

/// Glow around bright parts, blurred at half size: handles in, handle out.
Image addGlow(Graph& graph, Image color, float threshold) {
  const ImageDesc full = graph.desc(color), half = dividedBy(full, 2);

  Pass select = graph.addPass("glow.select", PassKind::compute);
  select.sample(color);
  const Image bright = select.write(graph.createImage("glow.bright", half), Usage::storage);
  select.record([=](PassContext& context) {
    const Binding bindings[] = {sampled(color), storage(bright)};
    context.dispatch({.program = kBright, .bindings = bindings, .pushConstants = bytesOf(threshold),
                      .groups = groupsFor(context.extent(bright), 8)});
  });

  Pass blur = graph.addPass("glow.blur", PassKind::compute);
  blur.sample(bright);
  const Image blurred = blur.write(graph.createImage("glow.blurred", half), Usage::storage);
  blur.record([=](PassContext& context) {
    const Binding bindings[] = {sampled(bright), storage(blurred)};
    context.dispatch({.program = kBlur, .bindings = bindings, .groups = groupsFor(context.extent(blurred), 8)});
  });

  Pass add = graph.addPass("glow.add", PassKind::compute);
  add.sample(color);
  add.sample(blurred);
  const Image sum = add.write(graph.createImage("glow.sum", full), Usage::storage);
  add.record([=](PassContext& context) {
    const Binding bindings[] = {sampled(color), sampled(blurred), storage(sum)};
    context.dispatch({.program = kAdd, .bindings = bindings, .groups = groupsFor(context.extent(sum), 8)});
  });
  return sum;
}

void drawFrame(Executor& executor, Graph& graph, const ImageDesc& desc, const ImportedImage& scene) {
  graph.reset();  // Keeps its memory; an unchanged frame finds its plan in the executor's cache.
  const Image sum = addGlow(graph, graph.importImage("scene", desc, scene), 1.0f);
  graph.exportImage(sum, {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                          VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
  executor.execute(graph);
}
// [example]
// clang-format on

namespace lensgraph {
namespace {

const ImportedImage kScene{.image = FakeBackend::as<VkImage>(7),
                           .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                           .before = {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                      VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
                           .after = {}};

std::string readme() {
  std::ifstream file(LENSGRAPH_SOURCE_DIR "/rendergraph/README.md", std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
}

}  // namespace

TEST(ReadmeExample, RunsThreePassesAndCompilesOnce) {
  FakeBackend backend;
  Executor executor(backend);
  Graph graph;
  const ImageDesc desc{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = 64, .height = 32};
  for (int frame = 0; frame < 3; ++frame) drawFrame(executor, graph, desc, kScene);
  EXPECT_EQ(backend.count("dispatch bright"), 3u);
  EXPECT_EQ(backend.count("dispatch blur"), 3u);
  EXPECT_EQ(backend.count("dispatch add"), 3u);
  EXPECT_EQ(executor.plansCompiled(), 1u);
  EXPECT_EQ(executor.plansReused(), 2u);
}

TEST(ReadmeExample, IsShownAsItStandsHere) {
  std::ifstream file(__FILE__, std::ios::binary);
  const std::string source((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::string mark = "// [example]\n";
  const std::size_t begin = source.find(mark) + mark.size();
  const std::string example = source.substr(begin, source.find(mark, begin) - begin);
  ASSERT_GT(example.size(), 1000u);
  EXPECT_NE(readme().find("```cpp\n" + example + "```\n"), std::string::npos)
      << "rendergraph/README.md must show the example exactly as it stands in " << __FILE__;
}

}  // namespace lensgraph
