// The exclusive prefix sum of a buffer of counts, in place: where each list begins when all stand one behind another.
#pragma once

#include <string>

#include "rendergraph/graph.h"

namespace lensgraph::passes {

/// Which values of a buffer of uint32_t are summed.
struct PrefixSumRange {
  uint32_t first = 0;  ///< Index of the first value.
  uint32_t count = 0;  ///< Values; 0 sums nothing and writes the sum behind.
  /// Start from values[first - 1] instead of 0: with the range before ending there, sums run on. Needs first > 0.
  bool continues = false;
};

/// Declares `prefix`.blocks, .totals and .add: values[first + i] becomes the sum of the i values from `first` on, and
/// values[first + count] the sum of all. So the buffer holds first + count + 1 values at least. Sums wrap at 2^32.
/// At most 65 535 · 1024 values (the work groups of one dispatch that every device grants). Advances `values`.
void declarePrefixSum(rendergraph::Graph& graph, const std::string& prefix, rendergraph::Buffer& values,
                      const PrefixSumRange& range);

}  // namespace lensgraph::passes
