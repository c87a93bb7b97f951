// The example of rendergraph/README.md: it compiles, does what the text says, and the README shows it as it stands here.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "support/fake_backend.h"

// clang-format off
// [example]
#include "rendergraph/compute_pass.h"
#include "rendergraph/executor.h"

using namespace lensgraph::rendergraph;

const ComputeProgram kBright{.name = "bright", .shader = {}}, kBlur{.name = "blur", .shader = {}},
    kAdd{.name = "add", .shader = {}};  // .shader: your SPIR-V

/// Glow around bright parts, blurred at half size: handles in, handle out.
Image addGlow(Graph& graph, Image color, float threshold) {
  const ImageDesc full = graph.desc(color), half = dividedBy(full, 2);
  Image bright = graph.createImage("glow.bright", half), blurred = graph.createImage("glow.blurred", half);
  Image sum = graph.createImage("glow.sum", full);
  const Groups quarter = groupsFor(mipExtent(half, 0), 8), all = groupsFor(mipExtent(full, 0), 8);

  // An access is a binding: the order of the calls numbers them. A write makes the handle that of the result.
  compute(graph, "glow.select", kBright).sample(color).write(bright).push(threshold).groups(quarter);
  compute(graph, "glow.blur", kBlur).sample(bright).write(blurred).groups(quarter);
  compute(graph, "glow.add", kAdd).sample(color).sample(blurred).write(sum).groups(all);
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
  std::ifstream file(LENSGRAPH_SOURCE_DIR "/tests/unit/rendergraph/inspect/readme_example_test.cpp", std::ios::binary);
  const std::string source((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::string mark = "// [example]\n";
  const std::size_t begin = source.find(mark) + mark.size();
  const std::string example = source.substr(begin, source.find(mark, begin) - begin);
  ASSERT_GT(example.size(), 1000u);
  EXPECT_NE(readme().find("```cpp\n" + example + "```\n"), std::string::npos)
      << "rendergraph/README.md must show the example exactly as it stands in " << __FILE__;
}

}  // namespace lensgraph
