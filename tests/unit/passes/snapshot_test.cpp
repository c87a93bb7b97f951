// What each technique declares, as text, against the files in snapshots/: a change of nodes, barriers or
// memory is seen in review. Rewrite the files with LENSGRAPH_UPDATE_SNAPSHOTS=1 in the environment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "passes/registry.h"
#include "rendergraph/compiler.h"
#include "rendergraph/dump.h"

namespace {

struct Snapshot {
  std::string file;
  std::string technique;
  passes::ParameterSet parameters = {};
  bool hasTransparency = false;
  float cocScale = 20.0f;  // px·m
};

const rendergraph::AccessState kSampled = {.stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                           .access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                           .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
constexpr rendergraph::AccessState kHostRead = {.stages = VK_PIPELINE_STAGE_2_HOST_BIT,
                                                .access = VK_ACCESS_2_HOST_READ_BIT};

/// The plan of a technique whose outputs are all asked for, on a device that does not exist.
std::string textOf(const Snapshot& snapshot) {
  const auto* technique = passes::findTechnique(snapshot.technique);
  rendergraph::Graph graph;
  passes::SceneDraw scene;
  scene.hasTransparency = snapshot.hasTransparency;
  passes::DofInputs inputs;
  inputs.extent = {640, 360};
  inputs.lens = {.cocScale = snapshot.cocScale,
                 .focusVergence = 0.5f,
                 .maxCocRadius = 1e30f,
                 .vergenceScale = 100.0f,
                 .vergenceOffset = 0.0f};
  inputs.aperture.anamorphicRatio = 1.0f;
  inputs.projection = {.pixelsPerTangent = 494.5f, .nearPlane = 0.01f};
  if (technique->input == passes::TechniqueInput::scene) {
    inputs.scene = &scene;
  } else {
    const auto host = [&](std::string_view name, VkFormat format) {
      return graph.importImage(name, {.format = format, .width = 640, .height = 360},
                               {.usage = VK_IMAGE_USAGE_SAMPLED_BIT, .before = kSampled, .after = kSampled});
    };
    inputs.color = host("host.color", VK_FORMAT_R32G32B32A32_SFLOAT);
    inputs.depth = host("host.depth", VK_FORMAT_D32_SFLOAT);
  }
  const auto out = technique->declare(graph, inputs, snapshot.parameters);
  graph.exportImage(out.color, kSampled);
  if (out.standardError) graph.exportImage(out.standardError, kSampled);
  if (out.statistics) graph.exportBuffer(out.statistics, kHostRead);
  std::ostringstream text;
  writeText(text, graph, compile(graph.declaration(), {}, rendergraph::NominalDevice()));
  return text.str();
}

std::vector<Snapshot> snapshots() {
  const passes::ParameterSet twoViews = {{"lensSamples", int64_t{2}}, {"viewsPerFrame", int64_t{2}}};
  return {
      {.file = "pinhole", .technique = "pinhole"},
      {.file = "pinhole_transparency", .technique = "pinhole", .hasTransparency = true},
      {.file = "pinhole_4_samples", .technique = "pinhole", .parameters = {{"pixelSamples", int64_t{4}}}},
      {.file = "accumulation_2_views", .technique = "accumulation", .parameters = twoViews},
      {.file = "accumulation_2_views_transparency",
       .technique = "accumulation",
       .parameters = twoViews,
       .hasTransparency = true},
      {.file = "accumulation_no_aperture", .technique = "accumulation", .parameters = twoViews, .cocScale = 0.0f},
      {.file = "two_pass_filter", .technique = "two_pass_filter"},
  };
}

class Declarations : public testing::TestWithParam<Snapshot> {};

TEST_P(Declarations, AreTheSnapshot) {
  const auto path =
      std::filesystem::path(LENSGRAPH_SOURCE_DIR) / "tests/unit/passes/snapshots" / (GetParam().file + ".txt");
  const std::string text = textOf(GetParam());
  EXPECT_EQ(text, textOf(GetParam())) << "a declaration must not depend on anything but its inputs";
  if (std::getenv("LENSGRAPH_UPDATE_SNAPSHOTS") != nullptr) {
    std::ofstream(path, std::ios::binary) << text;
    GTEST_SKIP() << "wrote " << path;
  }
  std::ifstream file(path, std::ios::binary);
  ASSERT_TRUE(file.is_open()) << path << " is missing; LENSGRAPH_UPDATE_SNAPSHOTS=1 writes it";
  const std::string expected((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_EQ(text, expected) << "if the change is meant, LENSGRAPH_UPDATE_SNAPSHOTS=1 rewrites " << path;
}

INSTANTIATE_TEST_SUITE_P(Every, Declarations, testing::ValuesIn(snapshots()),
                         [](const auto& info) { return info.param.file; });

// A technique that is added must bring its snapshot.
TEST(Snapshots, ExistForEveryTechnique) {
  const auto all = snapshots();
  for (const auto& technique : passes::techniques()) {
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.technique == technique.name; }))
        << technique.name << " has no snapshot";
  }
}

}  // namespace
