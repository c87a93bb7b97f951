// Replaces texels that are not finite by black, in place, and counts them. Finite texels are read, never written.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/sanitize.h"
#include "shaders/shared/statistics.h"

layout(local_size_x = kSanitizeTile, local_size_y = kSanitizeTile) in;
layout(set = 0, binding = 0, rgba32f) uniform image2D color;
layout(std430, set = 0, binding = 1) buffer Statistics { FrameStatistics statistics; };

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(color)))) return;
  const vec4 texel = imageLoad(color, pixel);
  if (!any(isnan(texel)) && !any(isinf(texel))) return;
  imageStore(color, pixel, vec4(0.0, 0.0, 0.0, 1.0));
  atomicAdd(statistics.replacedTexels, 1u);
}
