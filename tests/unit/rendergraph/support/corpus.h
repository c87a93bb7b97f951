// The declarations on which packing, ordering and speed are judged: three shapes of graph over ten texture sizes.
// The same workload, seed and length give the same graph on every platform.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "rendergraph/graph.h"

namespace lensgraph::corpus {

enum class Workload : uint8_t {
  chain2,  ///< Pass i reads the outputs of i - 1 and i - 2.
  dag16,   ///< Pass i reads the output of i - 1 and that of one of the 16 before it, drawn at random.
  wide8,   ///< Eight lanes side by side, seven passes deep, then one pass that joins them and feeds the next eight.
};

struct NamedWorkload {
  Workload workload;
  std::string_view name;
};
inline constexpr std::array<NamedWorkload, 3> kWorkloads = {
    {{Workload::chain2, "chain2"}, {Workload::dag16, "dag16"}, {Workload::wide8, "wide8"}}};

/// A workload as numbers: which earlier passes each pass reads, and which of the sizes it writes.
struct Shape {
  std::vector<std::vector<uint32_t>> inputs;
  std::vector<uint32_t> sizes;   ///< Index among the ten texture sizes, by pass.
  std::vector<uint32_t> unread;  ///< Passes whose output no other reads.
};
Shape makeShape(Workload workload, uint32_t seed, uint32_t passes);

/// Every pass writes one new texture; a last pass reads the outputs that nothing else reads and writes an exported
/// image. Adds passes + 1 passes to the graph. `outputs` is scratch, whose memory is kept by whoever measures.
void declare(rendergraph::Graph& graph, const Shape& shape, std::vector<rendergraph::Image>& outputs);
inline void declare(rendergraph::Graph& graph, const Shape& shape) {
  std::vector<rendergraph::Image> outputs;
  declare(graph, shape, outputs);
}

}  // namespace lensgraph::corpus
