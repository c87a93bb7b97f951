// Three passes: blocks, the blocks' totals, totals added back.
#include "passes/nodes/prefix_sum.h"

#include <algorithm>
#include <array>

#include "rendergraph/program.h"
#include "shaders/shared/prefix_sum.h"
#include "spirv/prefix_sum/add_comp.h"
#include "spirv/prefix_sum/blocks_comp.h"
#include "spirv/prefix_sum/totals_comp.h"

namespace lensgraph::passes {
namespace {

using rendergraph::Buffer;
using rendergraph::Usage;

const rendergraph::ComputeProgram kBlocks{"prefix_sum.blocks", prefix_sum_blocks_comp};
const rendergraph::ComputeProgram kTotals{"prefix_sum.totals", prefix_sum_totals_comp};
const rendergraph::ComputeProgram kAdd{"prefix_sum.add", prefix_sum_add_comp};

static_assert(shared::kPrefixSumBlock == shared::kPrefixSumThreads * shared::kPrefixSumRun);

void recordDispatch(rendergraph::Pass& pass, const rendergraph::ComputeProgram& program, Buffer values, Buffer totals,
                    const PrefixSumRange& range, uint32_t groups) {
  const shared::PrefixSumPush push{.first = range.first, .count = range.count, .continues = range.continues ? 1u : 0u};
  pass.record([&program, values, totals, push, groups](rendergraph::PassContext& context) {
    const std::array bindings = {rendergraph::storage(values), rendergraph::storage(totals)};
    context.dispatch({.program = program,
                      .bindings = bindings,
                      .pushConstants = rendergraph::bytesOf(push),
                      .groups = {.x = groups}});
  });
}

}  // namespace

void declarePrefixSum(rendergraph::Graph& graph, const std::string& prefix, Buffer& values,
                      const PrefixSumRange& range) {
  const uint32_t blocks = std::max((range.count + shared::kPrefixSumBlock - 1) / shared::kPrefixSumBlock, 1u);
  Buffer totals = graph.createBuffer(prefix + ".block_totals", {.size = blocks * sizeof(uint32_t)});

  auto scan = graph.addPass(prefix + ".blocks", rendergraph::PassKind::compute);
  values = scan.modify(values, Usage::storage);
  totals = scan.write(totals, Usage::storage);
  recordDispatch(scan, kBlocks, values, totals, range, blocks);

  auto sum = graph.addPass(prefix + ".totals", rendergraph::PassKind::compute);
  values = sum.modify(values, Usage::storage);
  totals = sum.modify(totals, Usage::storage);
  recordDispatch(sum, kTotals, values, totals, range, 1);

  auto add = graph.addPass(prefix + ".add", rendergraph::PassKind::compute);
  values = add.modify(values, Usage::storage);
  add.read(totals, Usage::storage);
  recordDispatch(add, kAdd, values, totals, range, blocks);
}

}  // namespace lensgraph::passes
