// Dumps: a snapshot of the text, and that JSON and DOT name everything and nest correctly.
#include "rendergraph/dump.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "rendergraph/compiler.h"
#include "rendergraph/declare/declaration.h"
#include "rendergraph/graph.h"

namespace lensgraph {

using namespace rendergraph;
using testing::HasSubstr;

namespace {

void declare(Graph& graph) {
  const ImageDesc desc{.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 64, .height = 64};
  Image scene = graph.createImage("scene \"a\"", desc);
  Image depth = graph.createImage("depth", {.format = VK_FORMAT_D32_SFLOAT, .width = 64, .height = 64});
  Buffer tiles = graph.createBuffer("tiles", {.size = 256});
  Image out = graph.createImage("out", desc);
  Pass draw = graph.addPass("draw", PassKind::raster);
  scene = draw.color(scene);
  depth = draw.depth(depth);
  Pass classify = graph.addPass("classify", PassKind::compute);
  classify.sample(scene);
  tiles = classify.write(tiles, Usage::storage);
  Pass filter = graph.addPass("filter", PassKind::compute);
  filter.sample(scene);
  filter.read(tiles, Usage::storage);
  out = filter.write(out, Usage::storage);
  Pass debug = graph.addPass("debug", PassKind::transfer);
  debug.read(out, Usage::transferSource);
  graph.exportImage(out, {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                          VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
}

/// Brackets and quotes close in order: enough to catch a forgotten comma's neighbours without a parser.
bool nests(const std::string& json) {
  std::string open;
  bool text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (text) {
      if (c == '\\') ++i;
      text = c != '"';
      continue;
    }
    if (c == '"') text = true;
    if (c == '{' || c == '[') open += c;
    if (c == '}' || c == ']') {
      if (open.empty() || open.back() != (c == '}' ? '{' : '[')) return false;
      open.pop_back();
    }
    if (c == ',' && (json[i + 1] == '}' || json[i + 1] == ']')) return false;
  }
  return open.empty() && !text;
}

}  // namespace

TEST(Dump, TextSnapshot) {
  Graph graph;
  declare(graph);
  std::ostringstream out;
  writeText(out, graph, compile(graph.declaration(), {}, NominalDevice()));
  EXPECT_EQ(out.str(), R"(0 raster draw: write scene "a" v0 as color attachment, write depth v0 as depth attachment
  barrier scene "a": none/none -> colorOutput/colorWrite, undefined -> colorAttachment (layout)
  barrier depth: none/none -> earlyTests+lateTests/depthRead+depthWrite, undefined -> depthAttachment (layout)
  attachment scene "a": clear, store, colorAttachment
  attachment depth: clear, dontCare, depthAttachment
1 compute classify: read scene "a" v1 as sampled, write tiles v0 as storage
  barrier scene "a": colorOutput/colorWrite -> compute/sampledRead, colorAttachment -> shaderReadOnly (read after write)
  barrier tiles: earlyTests+lateTests/depthWrite -> compute/storageWrite (alias)
2 compute filter: read scene "a" v1 as sampled, read tiles v1 as storage, write out v0 as storage
  barrier out: none/none -> compute/storageWrite, undefined -> general (layout)
  barrier tiles: compute/storageWrite -> compute/storageRead (read after write)
after
  barrier out: compute/storageWrite -> fragment/sampledRead, general -> shaderReadOnly (read after write)
culled debug: it writes nothing and has no declared side effect
memory scene "a": heap 0 +0, 65536 bytes, steps 0-2
memory depth: heap 0 +65536, 65536 bytes, steps 0-0
memory tiles: heap 0 +65536, 65536 bytes, steps 1-2
memory out: heap 0 +131072, 65536 bytes, steps 2-3
)");
}

TEST(Dump, JsonNestsAndNamesEverything) {
  Graph graph;
  declare(graph);
  std::ostringstream out;
  writeJson(out, graph, compile(graph.declaration(), {}, NominalDevice()));
  const std::string json = out.str();
  EXPECT_TRUE(nests(json)) << json;
  for (const char* part : {R"("scene \"a\"")", R"("draw")", R"("filter")", R"("culled")", R"("reason": "alias")",
                           R"("peakBytes": 196608)", R"("barrierBatches": 4)"}) {
    EXPECT_THAT(json, HasSubstr(part));
  }
}

TEST(Dump, DotShowsFlowAndCulledPasses) {
  Graph graph;
  declare(graph);
  std::ostringstream out;
  writeDot(out, graph, compile(graph.declaration(), {}, NominalDevice()));
  const std::string dot = out.str();
  EXPECT_THAT(dot, HasSubstr("digraph"));
  EXPECT_THAT(dot, HasSubstr("p0 -> r0 [label=\"color attachment\"]"));
  EXPECT_THAT(dot, HasSubstr("r0 -> p1 [label=\"sampled\"]"));
  EXPECT_THAT(dot, HasSubstr("style=dashed, label=\"debug\""));
  EXPECT_THAT(dot, HasSubstr("r3 [shape=ellipse, label=\"out\", peripheries=2]"));
}

}  // namespace lensgraph
