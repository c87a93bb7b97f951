// Each block's values become their exclusive prefix sums within the block; its total is noted.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "block_scan.glsl"

layout(local_size_x = kPrefixSumThreads) in;
layout(std430, set = 0, binding = 0) buffer Values { uint values[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Totals { uint totals[]; };
layout(push_constant) uniform Push { PrefixSumPush push; };

void main() {
  const uint begin = gl_WorkGroupID.x * kPrefixSumBlock + gl_LocalInvocationID.x * kPrefixSumRun;
  uint run[kPrefixSumRun];
  for (uint i = 0u; i < kPrefixSumRun; ++i) {
    run[i] = begin + i < push.count ? values[push.first + begin + i] : 0u;
  }
  const uint total = scanBlock(run);
  for (uint i = 0u; i < kPrefixSumRun; ++i) {
    if (begin + i < push.count) values[push.first + begin + i] = run[i];
  }
  if (gl_LocalInvocationID.x == 0u) totals[gl_WorkGroupID.x] = total;
}
