// As horizontal.comp, for pictures with alpha.
#version 460
#extension GL_GOOGLE_include_directive : require

#define KEEPS_ALPHA
const ivec2 kAxis = ivec2(1, 0);

#include "two_pass_filter/filter.glsl"

void store(ivec2 pixel, vec4 rgba, float radius) { imageStore(target, pixel, rgba); }
