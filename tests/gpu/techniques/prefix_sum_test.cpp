// The prefix sum against the host's, over sizes around its blocks.
#include "passes/nodes/prefix_sum.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "engine/graph/graph_backend.h"
#include "tests/support/gpu/device_buffers.h"
#include "tests/support/gpu/gpu_test.h"

namespace lensgraph {

namespace {

constexpr uint32_t kBefore = 3;  // values that are not summed
constexpr uint32_t kUntouched = 0xabcd0123u;

class PrefixSum : public support::GpuTest, public testing::WithParamInterface<uint32_t> {
 protected:
  static std::vector<uint32_t> onDevice(const std::vector<uint32_t>& values, const passes::PrefixSumRange& range) {
    const support::FilledBuffer buffer(std::as_bytes(std::span(values)));
    engine::GraphBackend backend(support::device());
    rendergraph::Executor executor(backend);
    rendergraph::Graph graph;
    auto handle = buffer.importInto(graph, "values");
    passes::declarePrefixSum(graph, "sum", handle, range);
    const auto back = support::declareReadBack(graph, handle);
    executor.execute(graph);
    return support::contentOf<uint32_t>(executor, back);
  }
};

TEST_P(PrefixSum, EqualsTheHosts) {
  const uint32_t count = GetParam();
  std::mt19937 random(count);
  for (const bool continues : {false, true}) {
    std::vector<uint32_t> values(kBefore + count + 2, kUntouched);
    values[kBefore - 1] = 77;
    for (uint32_t i = 0; i < count; ++i) values[kBefore + i] = random() % 3 == 0 ? random() % 1000 : random() % 4;
    auto expected = values;
    uint32_t sum = continues ? 77 : 0;
    for (uint32_t i = 0; i < count; ++i) sum += std::exchange(expected[kBefore + i], sum);
    expected[kBefore + count] = sum;
    EXPECT_TRUE(onDevice(values, {.first = kBefore, .count = count, .continues = continues}) == expected) << continues;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, PrefixSum,
                         testing::Values(0, 1, 2, 7, 8, 127, 1009, 1023, 1024, 1025, 2048, 99991, 1048576, 1300003),
                         testing::PrintToStringParamName());

TEST_F(PrefixSum, WrapsAsIntegersDo) {
  const auto sums = onDevice({0, 0, 0, 0xfffffff0u, 0x20u, 5u, 0u}, {.first = 3, .count = 3});
  EXPECT_EQ(sums[5], 0x10u);
  EXPECT_EQ(sums[6], 0x15u);
}

}  // namespace

}  // namespace lensgraph
