// What each technique declares, as text, against the files in snapshots/: a change of nodes, barriers or
// memory is seen in review. Rewrite the files with LENSGRAPH_UPDATE_SNAPSHOTS=1 in the environment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "bare_technique.h"
#include "passes/registry/registry.h"
#include "rendergraph/compiler.h"
#include "rendergraph/dump.h"

namespace lensgraph {

namespace {

struct Snapshot {
  std::string file;
  std::string technique;
  BareOptions options = {};
};

/// The plan of a technique whose outputs are all asked for, on a device that does not exist.
std::string textOf(const Snapshot& snapshot) {
  rendergraph::Graph graph;
  passes::SceneDraw scene;
  declareBare(graph, *passes::findTechnique(snapshot.technique), snapshot.options, scene);
  std::ostringstream text;
  writeText(text, graph, compile(graph.declaration(), {}, rendergraph::NominalDevice()));
  return text.str();
}

std::vector<Snapshot> snapshots() {
  const passes::ParameterSet twoViews = {{"lensSamples", int64_t{2}}, {"viewsPerFrame", int64_t{2}}};
  return {
      {.file = "pinhole", .technique = "pinhole"},
      {.file = "pinhole_transparency", .technique = "pinhole", .options = {.hasTransparency = true}},
      {.file = "pinhole_4_samples", .technique = "pinhole", .options = {.parameters = {{"pixelSamples", int64_t{4}}}}},
      {.file = "accumulation_2_views", .technique = "accumulation", .options = {.parameters = twoViews}},
      {.file = "accumulation_2_views_transparency",
       .technique = "accumulation",
       .options = {.parameters = twoViews, .hasTransparency = true}},
      {.file = "accumulation_no_aperture",
       .technique = "accumulation",
       .options = {.parameters = twoViews, .cocScale = 0.0f}},
      {.file = "two_pass_filter", .technique = "two_pass_filter"},
      {.file = "multiview_synthesis", .technique = "multiview_synthesis"},
      {.file = "multilayer_filtering", .technique = "multilayer_filtering"},
      {.file = "multilayer_filtering_transparency",
       .technique = "multilayer_filtering",
       .options = {.parameters = {{"mipSteps", int64_t{1}}, {"stackSteps", int64_t{1}}}, .hasTransparency = true}},
      {.file = "multiview_synthesis_2_views_transparency",
       .technique = "multiview_synthesis",
       .options = {.parameters = {{"views", int64_t{2}}}, .hasTransparency = true}},
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

}  // namespace lensgraph
