// Whole plans of small graphs: usage flags, barriers of a mip chain, barriers of several readers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rendergraph/compiler.h"
#include "rendergraph/graph.h"
#include "support/small_graphs.h"

namespace lensgraph {

using namespace rendergraph;
using namespace small_graphs;

TEST(Compile, UsageFlagsFollowFromLivingAccesses) {
  Graph graph;
  Image image = graph.createImage("image", kDesc);
  image = step(graph, "write", {}, image);
  Pass culled = graph.addPass("culled", PassKind::transfer);
  culled.read(image, Usage::transferSource);
  graph.exportImage(step(graph, "read", {image}, graph.createImage("out", kDesc)), kSampled);
  const Plan plan = planOf(graph);
  EXPECT_EQ(plan.placements[0].imageUsage, VkImageUsageFlags(VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT));
}

TEST(Compile, AMipChainIsBuiltInPlaceWithOneBarrierAStep) {
  Graph graph;
  ImageDesc desc = kDesc;
  desc.mips = 4;
  Image chain = graph.createImage("chain", desc);
  Pass first = graph.addPass("mip 0", PassKind::compute);
  chain = first.write(chain, Usage::storage, mip(0));
  for (uint32_t level = 1; level < 4; ++level) {
    Pass pass = graph.addPass("mip", PassKind::compute);
    pass.sample(chain, mip(level - 1));
    chain = pass.write(chain, Usage::storage, mip(level));
  }
  graph.exportImage(chain, kSampled);
  const Plan plan = planOf(graph);
  for (uint32_t level = 1; level < 4; ++level) {
    ASSERT_EQ(plan.passes[level].before.images.count, 2u);  // The mip that is read, the mip that is written.
    for (const ImageBarrier& barrier : plan.imagesOf(plan.passes[level].before)) {
      EXPECT_EQ(barrier.range.mipCount, 1u);
    }
  }
  const auto after = plan.imagesOf(plan.submissions.back().atEnd);
  ASSERT_EQ(after.size(), 1u);  // The others are in the layout and visible already.
  EXPECT_EQ(after[0].range.firstMip, 3u);
}

TEST(Compile, SeveralReadersWaitOnce) {
  Graph graph;
  Image image = step(graph, "write", {}, graph.createImage("image", kDesc));
  Image a = step(graph, "compute", {image}, graph.createImage("a", kDesc));
  Pass raster = graph.addPass("raster", PassKind::raster);
  raster.sample(image, {}, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
  Image b = raster.color(graph.createImage("b", kDesc));
  graph.exportImage(a, kSampled);
  graph.exportImage(b, kSampled);
  const Plan plan = planOf(graph);
  uint32_t barriers = 0;
  for (const PlannedPass& pass : plan.passes) {
    for (const ImageBarrier& barrier : plan.imagesOf(pass.before)) {
      if (barrier.resource != image.resource || barrier.from.stages == 0) continue;
      ++barriers;
      EXPECT_EQ(barrier.to.stages, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
    }
  }
  EXPECT_EQ(barriers, 1u);
}

}  // namespace lensgraph
