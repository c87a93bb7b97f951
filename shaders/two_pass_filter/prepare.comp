// Makes what the filter reads: one RGBA32F texel a pixel, rgb and the signed CoC radius, all finite.
// Depth to CoC: Zhou 2007 §4.1 and eq. 2, in vergence (shaders/shared/lens.h).
//
// One packed image, because each of the many taps is then one imageLoad; the inputs are read once a pixel here, with
// texelFetch, which takes any format, depth formats included.
// Also each tile's largest CoC radius, and counts of what had to be changed.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/lens.h"
#include "shaders/shared/statistics.h"
#include "shaders/shared/two_pass_filter.h"

layout(local_size_x = kTwoPassFilterTile, local_size_y = kTwoPassFilterTile) in;

layout(binding = 0) uniform sampler2D color;
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2, rgba32f) writeonly uniform image2D prepared;
layout(binding = 3) writeonly buffer TileRadii { float tileRadii[]; };  // px
layout(binding = 4) buffer Statistics { FrameStatistics statistics; };
layout(push_constant) uniform Constants { TwoPassFilterConstants constants; };

shared uint largestRadiusBits;  // Non-negative floats sort like their bits.
shared uint replacedTexels;
shared uint clampedRadii;

// By its bits: isnan() may be optimised away where a device does not promise to keep NaN.
bool isFinite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

// px, signed; raises the counters.
float filteredCoc(float vergence) {
  float radius = constants.lens.cocScale * (constants.lens.focusVergence - vergence);
  float limit = min(constants.lens.maxCocRadius, constants.maxRadius);
  if (abs(radius) > limit) atomicAdd(clampedRadii, 1u);
  return clamp(radius, -limit, limit);
}

vec4 preparedTexel(ivec2 pixel) {
  vec3 rgb = texelFetch(color, pixel, 0).rgb;
  float z = texelFetch(depth, pixel, 0).r;
  bvec4 good = bvec4(isFinite(rgb.r), isFinite(rgb.g), isFinite(rgb.b), isFinite(z));
  float vergence = vergenceFromDepthBuffer(constants.lens, z);  // May overflow to +Inf: the nearest there is.
  if (!all(good)) {
    // The whole colour goes: the other channels of a broken texel mean nothing. Unknown depth is the sky's.
    if (!all(good.xyz)) rgb = vec3(0.0);
    if (!good.w) vergence = 0.0;
    atomicAdd(replacedTexels, 1u);
  }
  rgb = clamp(rgb, -kTwoPassFilterMaxRadiance, kTwoPassFilterMaxRadiance);
  return vec4(rgb, filteredCoc(max(vergence, 0.0)));  // Nothing lies behind the eye.
}

void main() {
  if (gl_LocalInvocationIndex == 0u) {
    largestRadiusBits = 0u;
    replacedTexels = 0u;
    clampedRadii = 0u;
  }
  barrier();

  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(pixel, constants.size))) {
    vec4 texel = preparedTexel(pixel);
    imageStore(prepared, pixel, texel);
    atomicMax(largestRadiusBits, floatBitsToUint(abs(texel.a)));
  }
  barrier();

  if (gl_LocalInvocationIndex == 0u) {
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    tileRadii[tile.y * constants.tiles.x + tile.x] = uintBitsToFloat(largestRadiusBits);
    if (replacedTexels > 0u) atomicAdd(statistics.replacedTexels, replacedTexels);
    if (clampedRadii > 0u) atomicAdd(statistics.clampedCoc, clampedRadii);
  }
}
