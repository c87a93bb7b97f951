// SceneEmit::opaqueLayers and transparentLayers: premultiplied radiance, as half floats hold it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface.glsl"

// Without discard the device may test depth before shading.
layout(constant_id = 0) const bool discards = false;

layout(location = 0) out vec4 radiance;

#include "half_float.glsl"

void main() {
  const vec4 color = surface();
  if (discards && !(color.a > 0.0)) discard;
  const float alpha = min(color.a, 1.0);
  radiance = roundedToHalf(vec4(color.rgb * alpha, alpha));
}
