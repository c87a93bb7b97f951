// Adds to each block's sums those of all blocks before.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/prefix_sum.h"

layout(local_size_x = kPrefixSumThreads) in;
layout(std430, set = 0, binding = 0) buffer Values { uint values[]; };
layout(std430, set = 0, binding = 1) readonly buffer Totals { uint totals[]; };
layout(push_constant) uniform Push { PrefixSumPush push; };

void main() {
  const uint before = totals[gl_WorkGroupID.x];
  const uint begin = gl_WorkGroupID.x * kPrefixSumBlock + gl_LocalInvocationID.x;
  for (uint i = 0u; i < kPrefixSumBlock; i += kPrefixSumThreads) {
    if (begin + i < push.count) values[push.first + begin + i] += before;
  }
}
