// The exclusive prefix sum of a block's values: each invocation adds up its run, a tree in shared memory sums the runs.
// Include in a work group of kPrefixSumThreads. Every invocation calls scanBlock() with its own run of values, which it
// gets back as sums of all values before them in the block; the return value is the block's total.
#include "shaders/shared/prefix_sum.h"

shared uint runTotals[kPrefixSumThreads];

uint scanBlock(inout uint values[kPrefixSumRun]) {
  uint total = 0u;
  for (uint i = 0u; i < kPrefixSumRun; ++i) {
    const uint value = values[i];
    values[i] = total;
    total += value;
  }
  const uint own = gl_LocalInvocationID.x;
  runTotals[own] = total;
  barrier();
  for (uint step = 1u; step < kPrefixSumThreads; step *= 2u) {  // Hillis, Steele 1986
    const uint before = own >= step ? runTotals[own - step] : 0u;
    barrier();
    runTotals[own] += before;
    barrier();
  }
  const uint before = runTotals[own] - total;
  const uint blockTotal = runTotals[kPrefixSumThreads - 1u];
  for (uint i = 0u; i < kPrefixSumRun; ++i) values[i] += before;
  barrier();  // The totals may be written again.
  return blockTotal;
}
