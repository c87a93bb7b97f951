// The source tree keeps its shape: directions between folders, no cycles, small folders, a comment that opens each file.
// A change that must break one of these rules changes the table here, where a reader sees it.
#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <regex>

#include "include_graph.h"

namespace lensgraph::structure {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

const std::filesystem::path kRoot = LENSGRAPH_SOURCE_DIR;

// rendergraph/ARCHITECTURE.md and README.md say in words what stands here.
const std::string kGraph = "rendergraph", kShared = "shaders/shared";
const Directions kDirections = {
    {kShared, {}},

    // The headers at the root of rendergraph are its public ones.
    {kGraph, {}},
    {"rendergraph/declare", {kGraph}},
    {"rendergraph/compile/flow", {kGraph, "rendergraph/declare"}},
    {"rendergraph/compile/schedule", {kGraph, "rendergraph/declare", "rendergraph/compile/flow"}},
    {"rendergraph/compile/memory",
     {kGraph, "rendergraph/declare", "rendergraph/compile/flow", "rendergraph/compile/schedule"}},
    {"rendergraph/compile/sync",
     {kGraph, "rendergraph/declare", "rendergraph/compile/flow", "rendergraph/compile/schedule",
      "rendergraph/compile/memory"}},
    {"rendergraph/compile", {kGraph, "rendergraph/declare", "rendergraph/compile/*"}},
    {"rendergraph/inspect", {kGraph, "rendergraph/declare"}},
    {"rendergraph/execute/resources", {kGraph, "rendergraph/declare"}},
    {"rendergraph/execute/frame",
     {kGraph, "rendergraph/declare", "rendergraph/inspect", "rendergraph/execute/resources"}},

    {"passes", {kGraph, kShared}},
    {"passes/lens", {"passes", kGraph, kShared}},
    {"passes/nodes", {"passes", "passes/lens", kGraph, kShared}},
    // Techniques. Each may declare the pinhole view, and none knows the list of all.
    {"passes/*", {"passes", "passes/lens", "passes/nodes", "passes/pinhole", kGraph, kShared}},
    {"passes/registry", {"passes", "passes/*", kGraph, kShared}},
    // Copied, these go to shaders/shared and tests/gpu/techniques.
    {"passes/_template/shaders/shared", {kShared}},
    {"passes/_template/tests", {"passes/_template"}},

    {"engine", {}},
    {"engine/vulkan", {"engine", kGraph}},
    {"engine/graph", {"engine", "engine/vulkan", kGraph}},
    {"engine/files", {"engine"}},
    {"engine/image", {"engine", "engine/files", kGraph}},
    {"engine/metrics", {"engine", "engine/image"}},
    {"engine/scene", {"engine"}},
    {"engine/gltf/read", {"engine"}},
    {"engine/gltf/geometry", {"engine", "engine/scene", "engine/gltf/read"}},
    {"engine/gltf", {"engine", "engine/scene", "engine/gltf/*"}},
    {"engine/draw", {"engine", "engine/graph", "engine/image", "engine/scene", "engine/vulkan", kGraph, kShared}},

    // Rays and shading of its own: of the drawing it sees the environment map's data alone.
    {"engine/raytracer", {"engine", "engine/draw", "engine/files", "engine/image", "engine/scene"}},

    {"samples/host",
     {"engine", "engine/*", "passes", "passes/*", "samples/host/limits", "samples/host/raytraced", kGraph, kShared}},
    {"samples/host/measures", {"engine", "engine/*", "passes", "passes/*", "samples/host", kGraph, kShared}},
    {"samples/host/raytraced", {"engine/raytracer", "passes", "passes/lens"}},
    {"samples/host/limits", {"engine", "passes", kGraph, kShared}},
    {"samples/lensgraph", {"engine", "engine/*", "passes", "passes/*", "samples/host", kGraph, kShared}},
    {"samples/lensgraph/arguments", {"engine", "passes", "samples/host", "samples/lensgraph"}},
    {"samples/lensgraph/compare",
     {"engine", "engine/*", "samples/host", "samples/host/measures", "samples/lensgraph", kGraph, kShared}},
    {"samples/lensgraph/capture",
     {"engine", "engine/*", "passes", "passes/*", "samples/host", "samples/host/measures", "samples/lensgraph", kGraph,
      kShared}},
    {"samples/lensgraph/bench/turns", {"engine", "engine/*", "passes", "samples/host", "samples/lensgraph", kGraph}},
    {"samples/lensgraph/bench",
     {"engine", "engine/*", "passes", "passes/*", "samples/host", "samples/host/measures", "samples/lensgraph",
      "samples/lensgraph/capture", "samples/lensgraph/bench/turns", kGraph, kShared}},
    {"samples/lensgraph/bench/results",
     {"engine", "samples/host", "samples/lensgraph/bench", "samples/lensgraph/capture", kGraph}},
    {"samples/lensgraph/pages", {"engine", "engine/*", "samples/host", "samples/lensgraph", kGraph, kShared}},
    {"samples/lensgraph/commands",
     {"engine", "engine/*", "passes", "passes/*", "samples/host", "samples/host/measures", "samples/lensgraph",
      "samples/lensgraph/*", "samples/lensgraph/bench/*", kGraph, kShared}},
    {"samples/scenes", {"samples/scenes/generate", "samples/scenes/heavy"}},
    {"samples/scenes/generate", {}},
    {"samples/scenes/parts", {"samples/scenes/generate"}},
    {"samples/scenes/heavy", {"samples/scenes/generate", "samples/scenes/parts"}},
};

const std::vector<SourceFile>& sources() {
  static const std::vector<SourceFile> files =
      readSources(kRoot, {"shaders/shared", "rendergraph", "passes", "engine", "samples"});
  return files;
}

TEST(Structure, EveryIncludeFollowsTheTableOfDirections) {
  ASSERT_GT(sources().size(), 200u);
  EXPECT_THAT(againstDirections(sources(), kDirections), IsEmpty());
}

TEST(Structure, NoModuleIncludesItselfThroughAnother) {
  EXPECT_EQ(cycleOfModules(sources()), "");
}

TEST(Structure, NoFolderIncludesItselfThroughAnother) {
  EXPECT_EQ(cycleOfFolders(sources()), "");
}

// house rule: what one folder holds can be read at a glance.
TEST(Structure, NoFolderHoldsMoreThan25SourcesAndThePublicRootNoMoreThan28Headers) {
  std::map<std::string, std::size_t> count;
  for (const SourceFile& file :
       readSources(kRoot, {"shaders", "rendergraph", "passes", "engine", "samples", "tests"})) {
    ++count[folderOf(file.path)];
  }
  for (const auto& [folder, files] : count) EXPECT_LE(files, folder == kGraph ? 28u : 25u) << folder;
}

TEST(Structure, EverySourceOpensWithAComment) {
  for (const SourceFile& file :
       readSources(kRoot, {"rendergraph", "passes", "engine", "samples", "shaders", "tests"})) {
    std::ifstream stream(kRoot / file.path);
    std::string line;
    std::getline(stream, line);
    EXPECT_TRUE(line.starts_with("//")) << file.path;
  }
}

TEST(Structure, TheRenderGraphKnowsNoDepthOfField) {
  const std::regex words("\\b(coc|lens|bokeh|dof|aperture)\\b", std::regex::icase);
  for (const SourceFile& file : readSources(kRoot, {"rendergraph"})) {
    std::ifstream stream(kRoot / file.path);
    for (std::string line; std::getline(stream, line);) {
      EXPECT_FALSE(std::regex_search(line, words)) << file.path << ": " << line;
    }
  }
}

// The checks themselves, on trees that break the rules.

TEST(IncludeGraph, ReportsAPrivateHeaderThatPassesInclude) {
  const std::vector<SourceFile> files = {
      {"passes/pinhole/pinhole.cpp", {"rendergraph/graph.h", "rendergraph/declare/declaration.h"}}};
  const auto lines = againstDirections(files, kDirections);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines.front(), HasSubstr("passes/pinhole may not include rendergraph/declare"));
}

TEST(IncludeGraph, ReportsAnIncludeAgainstTheDirection) {
  const std::vector<SourceFile> files = {
      {"rendergraph/compile/flow/cells.h", {"rendergraph/compile/sync/visibility.h"}},
      {"passes/dof_io.h", {"engine/error.h"}},
      {"engine/draw/scene_gpu.cpp", {"passes/dof_io.h"}},
      {"rendergraph/graph.h", {"rendergraph/declare/declaration.h"}}};
  EXPECT_EQ(againstDirections(files, kDirections).size(), 4u);
}

TEST(IncludeGraph, ReportsAFolderWithoutARow) {
  EXPECT_THAT(againstDirections({{"rendergraph/attic/old.h", {}}}, kDirections), Contains(HasSubstr("has no row")));
}

TEST(IncludeGraph, FindsACycleOfModulesThroughASource) {
  const std::vector<SourceFile> files = {{"a/one.h", {}},
                                         {"a/below/one.cpp", {"a/one.h", "a/two.h"}},
                                         {"a/two.h", {"a/three.h"}},
                                         {"a/three.h", {}},
                                         {"a/three.cpp", {"a/three.h", "a/one.h"}}};
  EXPECT_EQ(cycleOfModules(files), "a/one -> a/two -> a/three -> a/one");
}

TEST(IncludeGraph, FindsACycleOfFolders) {
  EXPECT_EQ(cycleOfFolders({{"a/x.h", {"b/y.h"}}, {"b/z.h", {"a/w.h"}}}), "a -> b -> a");
  EXPECT_EQ(cycleOfFolders({{"a/x.h", {"b/y.h"}}, {"b/z.h", {"c/w.h"}}}), "");
}

}  // namespace
}  // namespace lensgraph::structure
