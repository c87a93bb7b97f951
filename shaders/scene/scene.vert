// Vertices of the scene, for every emit: object to view space, then the projection of one lens point.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/scene.h"
#include "shaders/shared/view.h"

layout(push_constant) uniform Push { ViewConstants view; };
layout(std430, set = 0, binding = 0) readonly buffer Draws { DrawConstants draws[]; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv0;
layout(location = 3) in vec2 uv1;
layout(location = 4) in vec4 color;

layout(location = 0) out vec3 viewPosition;
layout(location = 1) out vec3 viewNormal;
layout(location = 2) out vec4 texCoords;
layout(location = 3) out vec4 vertexColor;
layout(location = 4) flat out uint materialIndex;
layout(location = 5) flat out uint isMirrored;  // the object's winding is turned round
layout(location = 6) flat out uint bothFaces;   // back faces are drawn too

void main() {
  const DrawConstants draw = draws[gl_InstanceIndex];
  const vec4 inView = draw.viewFromObject * vec4(position, 1.0);
  viewPosition = inView.xyz;
  viewNormal = mat3(draw.normalColumns[0].xyz, draw.normalColumns[1].xyz, draw.normalColumns[2].xyz) * normal;
  texCoords = vec4(uv0, uv1);
  vertexColor = color;
  materialIndex = draw.material;
  isMirrored = draw.normalColumns[0].w != 0.0 ? 1u : 0u;
  bothFaces = draw.bothFaces;
  gl_Position = view.clipFromView * vec4(inView.xyz, 1.0);
}
