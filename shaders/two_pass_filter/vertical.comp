// First pass of the two-pass filter: along columns. Alpha carries each pixel's own CoC on to the second pass, as the
// paper wanted and 8-bit alpha did not allow it (Zhou 2007 §5).
#version 460
#extension GL_GOOGLE_include_directive : require

const ivec2 kAxis = ivec2(0, 1);

#include "two_pass_filter/filter.glsl"

void store(ivec2 pixel, vec4 rgba, float radius) { imageStore(target, pixel, vec4(rgba.rgb, radius)); }
