// Running mean over the views (Haeberli & Akeley 1990), in place, with Welford's sum of squared deviations of the luma
// for the error estimate. Texels that are not finite count as black and are counted.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/accumulation.h"
#include "shaders/shared/aperture.h"
#include "shaders/shared/statistics.h"

layout(local_size_x = kAccumulationTile, local_size_y = kAccumulationTile) in;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D viewColor;
layout(set = 0, binding = 1, rgba32f) uniform image2D mean;   // rgb: mean; a: sum of weights
layout(set = 0, binding = 2, r32f) uniform image2D spread;    // weighted sum of squared deviations of the luma
layout(std430, set = 0, binding = 3) buffer Statistics { FrameStatistics statistics; };
layout(push_constant) uniform Push { AccumulatePush push; };

// Small enough to vanish beside any real weight, in 65 536 views too.
const float kFaintWeight = 1e-12;

float luma(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, push.extent))) return;
  const ivec2 at = ivec2(pixel);
  vec3 color = imageLoad(viewColor, at).rgb;
  if (any(isnan(color)) || any(isinf(color))) {
    atomicAdd(statistics.replacedTexels, 1u);
    color = vec3(0.0);
  }
  const vec2 fromCentre = vec2(pixel) + 0.5 - 0.5 * vec2(push.extent);
  const vec2 place = fromCentre / (0.5 * length(vec2(push.extent)));
  // Where every sample so far is worth nothing, the faint weight makes it the plain mean.
  const float weight = max(push.weight * apertureVignette(push.aperture, push.lensSample, place), kFaintWeight);
  const vec4 before = push.viewIndex == 0u ? vec4(0.0) : imageLoad(mean, at);
  const float spreadBefore = push.viewIndex == 0u ? 0.0 : imageLoad(spread, at).r;
  const float total = before.a + weight;
  const float share = weight / total;
  const vec3 after = before.rgb + (color - before.rgb) * share;
  imageStore(mean, at, vec4(after, total));
  const float deviation = luma(color) - luma(before.rgb);
  imageStore(spread, at, vec4(spreadBefore + weight * deviation * (luma(color) - luma(after))));
}
