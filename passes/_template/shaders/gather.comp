// The mean of the picture over the disc of each pixel's own circle of confusion, by taps on a spiral.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/lens.h"
#include "shaders/shared/statistics.h"
#include "shared/template_technique.h"

layout(local_size_x = kTemplateTechniqueTile, local_size_y = kTemplateTechniqueTile) in;

// In the order of the chain of calls in template_technique.cpp.
layout(binding = 0) uniform sampler2D color;
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2, rgba32f) writeonly uniform image2D result;
layout(binding = 3) buffer Statistics { FrameStatistics statistics; };
layout(push_constant) uniform Push { TemplateTechniquePush push; };

const float kGoldenAngle = 2.39996323;     // rad
const float kMostRadiance = 1e30;          // Sums of as many taps as there may be stay below float's maximum.

// By its bits: isnan() may be optimised away where a device does not promise to keep NaN.
bool isFinite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool isFinite(vec4 v) { return isFinite(v.r) && isFinite(v.g) && isFinite(v.b) && isFinite(v.a); }

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, push.size))) return;

  const float z = texelFetch(depth, pixel, 0).r;
  const float vergence = isFinite(z) ? max(vergenceFromDepthBuffer(push.lens, z), 0.0) : 0.0;  // Unknown depth: the sky's.
  const float radius = min(abs(signedCocRadius(push.lens, vergence)), float(max(push.size.x, push.size.y)));
  if (!isFinite(texelFetch(color, pixel, 0)) || !isFinite(z)) atomicAdd(statistics.replacedTexels, 1u);

  vec4 sum = vec4(0.0);
  float count = 0.0;
  for (uint i = 0; i < push.samples; ++i) {
    const float share = (float(i) + 0.5) / float(push.samples);
    const float angle = float(i) * kGoldenAngle;
    const vec2 offset = radius * sqrt(share) * vec2(cos(angle), sin(angle));
    const ivec2 tap = clamp(pixel + ivec2(round(offset)), ivec2(0), push.size - 1);
    const vec4 rgba = texelFetch(color, tap, 0);
    if (!isFinite(rgba)) continue;
    sum += clamp(rgba, -kMostRadiance, kMostRadiance);
    count += 1.0;
  }
  imageStore(result, pixel, count > 0.0 ? sum / count : vec4(0.0, 0.0, 0.0, 1.0));
}
