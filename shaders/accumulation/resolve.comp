// The picture so far, opaque, and the standard error of its luma. The error takes the views as independent; for
// quasi-random patterns that is an upper estimate.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/accumulation.h"

layout(local_size_x = kAccumulationTile, local_size_y = kAccumulationTile) in;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D mean;
layout(set = 0, binding = 1, r32f) uniform readonly image2D spread;
layout(set = 0, binding = 2, rgba32f) uniform writeonly image2D color;
layout(set = 0, binding = 3, r32f) uniform writeonly image2D standardError;
layout(push_constant) uniform Push { ResolvePush push; };

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, push.extent))) return;
  const ivec2 at = ivec2(pixel);
  const vec4 value = imageLoad(mean, at);
  imageStore(color, at, vec4(value.rgb, 1.0));
  const float views = float(push.viewCount);
  const float variance = push.viewCount > 1u && value.a > 0.0
                             ? max(imageLoad(spread, at).r, 0.0) / value.a / (views - 1.0)
                             : 0.0;
  imageStore(standardError, at, vec4(sqrt(variance)));
}
