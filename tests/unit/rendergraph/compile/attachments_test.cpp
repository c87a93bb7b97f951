// Load and store operations of attachments.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rendergraph/compiler.h"
#include "rendergraph/graph.h"
#include "support/small_graphs.h"

namespace lensgraph {

using namespace rendergraph;
using namespace small_graphs;

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

}  // namespace lensgraph
