// One direction of the two-pass filter, Zhou 2007 §4.2. Include after defining kAxis (ivec2) and, where the picture has
// alpha, KEEPS_ALPHA; define store() afterwards, which keeps the result of a pixel.
//
//   W(P) = O(r_p) I(r_p) L(z_p),  W(C) = I(r_c)
//   O = clamp(r_p - d_p, 0, 1)    how far the blur of P reaches over C; both in px
//   I = 1/max(r, r_min)²          light spread over the disc; r_min is ours, the paper is singular in focus
//   L = min(1, k r_c) for P behind the focal plane, else 1: no background over what is in focus
// Alpha is filtered as a fourth colour. It has a buffer of its own, since the image's alpha holds the CoC.
// Taps beyond the border read the border's texel at their own distance ("clamp to edge", §5).
#include "shaders/shared/two_pass_filter.h"

layout(local_size_x = kTwoPassFilterTile, local_size_y = kTwoPassFilterTile) in;

layout(binding = 0, rgba32f) readonly uniform image2D source;  // rgb, signed CoC radius (px) of the pixel itself
layout(binding = 1, rgba32f) writeonly uniform image2D target;
layout(binding = 2) readonly buffer TileTaps { uvec2 tileTaps[]; };
#ifdef KEEPS_ALPHA
layout(binding = 3) readonly buffer SourceAlphas { float sourceAlphas[]; };
#endif
layout(push_constant) uniform Constants { TwoPassFilterConstants constants; };

float intensity(float radius) {
  float bounded = max(radius, constants.minRadius);
  return 1.0 / (bounded * bounded);
}

int indexOf(ivec2 pixel) { return pixel.y * constants.size.x + pixel.x; }

float alphaAt(ivec2 pixel) {
#ifdef KEEPS_ALPHA
  return sourceAlphas[indexOf(pixel)];
#else
  return 1.0;
#endif
}

/// Defined by who includes this file.
void store(ivec2 pixel, vec4 rgba, float radius);

void addTap(ivec2 anywhere, float apart, float leakage, inout vec4 sum, inout float weights) {
  ivec2 pixel = clamp(anywhere, ivec2(0), constants.size - 1);
  vec4 tap = imageLoad(source, pixel);
  float radius = abs(tap.a);
  float weight = clamp(radius - apart, 0.0, 1.0) * intensity(radius) * (tap.a > 0.0 ? leakage : 1.0);
  sum += weight * vec4(tap.rgb, alphaAt(pixel));
  weights += weight;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, constants.size))) return;
  vec4 centre = imageLoad(source, pixel);

  uvec2 tileTap = tileTaps[gl_WorkGroupID.y * uint(constants.tiles.x) + gl_WorkGroupID.x];
  int taps = int(kAxis.x > 0 ? tileTap.x : tileTap.y);
  float leakage = min(1.0, constants.leakage * abs(centre.a));
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  // From the centre outwards on both sides: taps that a larger bound would add weigh 0 and change no bit.
  for (int i = 1; i <= taps; ++i) {
    addTap(pixel - i * kAxis, float(i), leakage, sum, weights);
    addTap(pixel + i * kAxis, float(i), leakage, sum, weights);
  }
  vec4 rgba = vec4(centre.rgb, alphaAt(pixel));
  if (weights > 0.0) {  // Else exactly the input.
    float centreWeight = intensity(abs(centre.a));
    rgba = (centreWeight * rgba + sum) / (centreWeight + weights);
  }
  store(pixel, rgba, centre.a);
}
