// Which passes live: those whose results are seen, and what these need.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rendergraph/compiler.h"
#include "rendergraph/graph.h"
#include "support/small_graphs.h"

namespace lensgraph {

using namespace rendergraph;
using namespace small_graphs;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Culling, KeepsOnlyWhatTheExportNeeds) {
  Graph graph;
  Image a = graph.createImage("a", kDesc), b = graph.createImage("b", kDesc), c = graph.createImage("c", kDesc);
  a = step(graph, "makeA", {}, a);
  b = step(graph, "makeB", {a}, b);
  c = step(graph, "makeC", {b}, c);
  Image d = step(graph, "makeD", {a}, graph.createImage("d", kDesc));
  graph.exportImage(d, kSampled);
  const Plan plan = planOf(graph);
  EXPECT_THAT(names(graph, plan), ElementsAre("makeA", "makeD"));
  ASSERT_EQ(plan.culled.size(), 2u);
  EXPECT_EQ(plan.culled[0].pass, 1u);
  EXPECT_THAT(plan.culled[0].reason, HasSubstr("'b' is read only by culled 'makeC'"));
  EXPECT_THAT(plan.culled[1].reason, HasSubstr("nothing reads what it writes to 'c'"));
  for (const Placement& placement : plan.placements) {  // No memory for what nobody makes.
    EXPECT_TRUE(placement.resource == a.resource || placement.resource == d.resource);
  }
}

TEST(Culling, ReplacedContentIsNotNeeded) {
  Graph graph;
  Image image = graph.createImage("image", kDesc);
  image = step(graph, "first", {}, image);
  image = step(graph, "second", {}, image);
  graph.exportImage(image, kSampled);
  EXPECT_THAT(names(graph, planOf(graph)), ElementsAre("second"));
}

TEST(Culling, WhatStaysOfAPartialWriteIsNeeded) {
  Graph graph;
  ImageDesc desc = kDesc;
  desc.mips = 2;
  Image image = graph.createImage("image", desc);
  Pass first = graph.addPass("first", PassKind::compute);
  image = first.write(image, Usage::storage);
  Pass second = graph.addPass("second", PassKind::compute);
  image = second.write(image, Usage::storage, mip(1));
  graph.exportImage(image, kSampled);
  EXPECT_THAT(names(graph, planOf(graph)), ElementsAre("first", "second"));
}

TEST(Culling, SideEffectsImportsAndPersistentContentLive) {
  Graph graph;
  Pass effect = graph.addPass("effect", PassKind::compute);
  effect.sideEffect();
  Image target = graph.importImage("target", kDesc, {.usage = VK_IMAGE_USAGE_STORAGE_BIT});
  target = step(graph, "import", {}, target);
  Image sum = graph.persistentImage("sum", kDesc);
  sum = step(graph, "persistent", {}, sum);
  graph.addPass("idle", PassKind::compute);
  const Plan plan = planOf(graph);
  EXPECT_THAT(names(graph, plan), ElementsAre("effect", "import", "persistent"));
  EXPECT_THAT(plan.culled[0].reason, HasSubstr("writes nothing"));
}

}  // namespace lensgraph
