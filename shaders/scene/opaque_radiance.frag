// SceneEmit::opaqueRadiance: opaque and alpha-masked surfaces into a colour attachment.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface.glsl"

// Without discard the device may test depth before shading.
layout(constant_id = 0) const bool masked = false;

layout(location = 0) out vec4 radiance;

void main() {
  const vec4 color = surface();
  if (masked && color.a == 0.0) discard;
  radiance = vec4(color.rgb, 1.0);
}
