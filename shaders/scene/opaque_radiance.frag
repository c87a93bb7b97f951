// SceneEmit::opaqueRadiance: opaque and alpha-masked surfaces into a colour attachment.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface.glsl"

layout(location = 0) out vec4 radiance;

void main() {
  const vec4 color = surface();
  if (color.a == 0.0) discard;
  radiance = vec4(color.rgb, 1.0);
}
