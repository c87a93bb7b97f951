// Makes what the filter reads: one RGBA32F texel a pixel, rgb and the signed CoC radius, all finite; and alpha apart, where
// it is kept.
// Depth to CoC: Zhou 2007 §4.1 and eq. 2, in vergence (shaders/shared/lens.h).
//
// One packed image, because each of the many taps is then one imageLoad; the inputs are read once a pixel here, with
// texelFetch, which takes any format, depth formats included.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/lens.h"
#include "shaders/shared/statistics.h"
#include "shaders/shared/two_pass_filter.h"

layout(constant_id = 0) const bool kKeepsAlpha = false;

layout(local_size_x = kTwoPassFilterTile, local_size_y = kTwoPassFilterTile) in;

layout(binding = 0) uniform sampler2D color;
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2, rgba32f) writeonly uniform image2D prepared;
layout(binding = 3) buffer Statistics { FrameStatistics statistics; };
layout(binding = 4) writeonly buffer Alphas { float alphas[]; };
layout(push_constant) uniform Constants { TwoPassFilterConstants constants; };

// By its bits: isnan() may be optimised away where a device does not promise to keep NaN.
bool isFinite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, constants.size))) return;

  vec4 texel = texelFetch(color, pixel, 0);
  vec3 rgb = texel.rgb;
  float z = texelFetch(depth, pixel, 0).r;
  float vergence = vergenceFromDepthBuffer(constants.lens, z);  // May overflow to +Inf: the nearest there is.
  bvec4 good = bvec4(isFinite(rgb.r), isFinite(rgb.g), isFinite(rgb.b), isFinite(z));
  if (!all(good)) {
    // The whole colour goes: the other channels of a broken texel mean nothing. Unknown depth is the sky's.
    if (!all(good.xyz)) rgb = vec3(0.0);
    if (!good.w) vergence = 0.0;
    atomicAdd(statistics.replacedTexels, 1u);
  }
  rgb = clamp(rgb, -kTwoPassFilterMaxRadiance, kTwoPassFilterMaxRadiance);
  float radius = signedCocRadius(constants.lens, max(vergence, 0.0));  // Nothing lies behind the eye.
  radius = clamp(radius, -radiusLimit(constants), radiusLimit(constants));
  imageStore(prepared, pixel, vec4(rgb, radius));
  if (kKeepsAlpha) {
    float alpha = isFinite(texel.a) ? texel.a : 1.0;
    alphas[pixel.y * constants.size.x + pixel.x] =
        clamp(alpha, -kTwoPassFilterMaxRadiance, kTwoPassFilterMaxRadiance);
  }
}
