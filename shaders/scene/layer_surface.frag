// SceneEmit::opaqueSurfaceLayers: what a surface sends alike into all directions, and what its gloss depends on.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface.glsl"

// Without discard the device may test depth before shading.
layout(constant_id = 0) const bool discards = false;

layout(location = 0) out vec4 steadyRadiance;
layout(location = 1) out vec4 gloss;
layout(location = 2) out vec4 facing;

#include "half_float.glsl"

void main() {
  const Surface parts = surfaceParts();
  if (discards && !(parts.alpha > 0.0)) discard;
  steadyRadiance = roundedToHalf(vec4(parts.steady, 1.0));
  gloss = vec4(parts.shaded.specularColor, parts.shaded.roughness);
  facing = vec4(parts.shaded.normal, parts.shaded.occlusion);
}
