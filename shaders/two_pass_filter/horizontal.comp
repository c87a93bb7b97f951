// Second pass of the two-pass filter: along rows (Zhou 2007 §4.2). Its result is the picture, opaque.
#version 460
#extension GL_GOOGLE_include_directive : require

const ivec2 kAxis = ivec2(1, 0);

#include "two_pass_filter/filter.glsl"

void store(ivec2 pixel, vec4 rgba, float radius) { imageStore(target, pixel, vec4(rgba.rgb, 1.0)); }
