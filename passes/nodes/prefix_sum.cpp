// Three passes: blocks, the blocks' totals, totals added back.
#include "passes/nodes/prefix_sum.h"

#include <algorithm>

#include "rendergraph/compute_pass.h"
#include "shaders/shared/prefix_sum.h"
#include "spirv/prefix_sum/add_comp.h"
#include "spirv/prefix_sum/blocks_comp.h"
#include "spirv/prefix_sum/totals_comp.h"

namespace lensgraph::passes {
namespace {

using rendergraph::Buffer;

const rendergraph::ComputeProgram kBlocks{"prefix_sum.blocks", prefix_sum_blocks_comp};
const rendergraph::ComputeProgram kTotals{"prefix_sum.totals", prefix_sum_totals_comp};
const rendergraph::ComputeProgram kAdd{"prefix_sum.add", prefix_sum_add_comp};

static_assert(shared::kPrefixSumBlock == shared::kPrefixSumThreads * shared::kPrefixSumRun);

}  // namespace

void declarePrefixSum(rendergraph::Graph& graph, const std::string& prefix, Buffer& values,
                      const PrefixSumRange& range) {
  const uint32_t blocks = std::max((range.count + shared::kPrefixSumBlock - 1) / shared::kPrefixSumBlock, 1u);
  Buffer totals = graph.createBuffer(prefix + ".block_totals", {.size = blocks * sizeof(uint32_t)});

  const shared::PrefixSumPush push{.first = range.first, .count = range.count, .continues = range.continues ? 1u : 0u};
  compute(graph, prefix + ".blocks", kBlocks).modify(values).write(totals).push(push).groups({.x = blocks});
  compute(graph, prefix + ".totals", kTotals).modify(values).modify(totals).push(push).groups({.x = 1});
  compute(graph, prefix + ".add", kAdd).modify(values).read(totals).push(push).groups({.x = blocks});
}

}  // namespace lensgraph::passes
