// As vertical.comp, for pictures with alpha, which goes beside them.
#version 460
#extension GL_GOOGLE_include_directive : require

#define KEEPS_ALPHA
const ivec2 kAxis = ivec2(0, 1);

#include "two_pass_filter/filter.glsl"

layout(binding = 4) writeonly buffer TargetAlphas { float targetAlphas[]; };

void store(ivec2 pixel, vec4 rgba, float radius) {
  imageStore(target, pixel, vec4(rgba.rgb, radius));
  targetAlphas[indexOf(pixel)] = rgba.a;
}
