// One work group: the blocks' totals become their exclusive prefix sums, and the sum of all stands behind the values.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "block_scan.glsl"

layout(local_size_x = kPrefixSumThreads) in;
layout(std430, set = 0, binding = 0) buffer Values { uint values[]; };
layout(std430, set = 0, binding = 1) buffer Totals { uint totals[]; };
layout(push_constant) uniform Push { PrefixSumPush push; };

void main() {
  const uint count = (push.count + kPrefixSumBlock - 1u) / kPrefixSumBlock;
  uint sum = push.continues != 0u ? values[push.first - 1u] : 0u;
  for (uint block = 0u; block < count; block += kPrefixSumBlock) {
    const uint begin = block + gl_LocalInvocationID.x * kPrefixSumRun;
    uint run[kPrefixSumRun];
    for (uint i = 0u; i < kPrefixSumRun; ++i) run[i] = begin + i < count ? totals[begin + i] : 0u;
    const uint total = scanBlock(run);
    for (uint i = 0u; i < kPrefixSumRun; ++i) {
      if (begin + i < count) totals[begin + i] = sum + run[i];
    }
    sum += total;
  }
  if (gl_LocalInvocationID.x == 0u) values[push.first + push.count] = sum;
}
