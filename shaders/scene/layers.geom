// Routes triangles to layers of view depth (Lee, Eisemann, Seidel 2009, §4.2). The paper sends a triangle whole to the
// layer of its farthest vertex, where it may delete what belongs there. Split, it goes to each layer that it crosses,
// clipped to that layer's borders: distances to a plane of constant depth are linear in clip space, where w is the depth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/emit.h"
#include "shaders/shared/view.h"

// Invocation i sends layers i·8 … i·8 + 7, counted from the farthest. What a triangle has in front of the 32nd goes into
// that one whole: 24 vertices of 22 components stay below the 1024 that devices grant a stage.
const uint kLayersPerInvocation = 8u;
const uint kInvocations = 4u;

layout(triangles, invocations = 4) in;
layout(triangle_strip, max_vertices = 24) out;

layout(push_constant) uniform Push { ViewConstants view; };
layout(std430, set = 2, binding = 0) readonly buffer Tables { SceneLayerTable tables[]; };

layout(location = 0) in vec3 viewPosition[];
layout(location = 1) in vec3 viewNormal[];
layout(location = 2) in vec4 texCoords[];
layout(location = 3) in vec4 vertexColor[];
layout(location = 4) flat in uint materialIndex[];

layout(location = 0) out vec3 outViewPosition;
layout(location = 1) out vec3 outViewNormal;
layout(location = 2) out vec4 outTexCoords;
layout(location = 3) out vec4 outVertexColor;
layout(location = 4) flat out uint outMaterialIndex;

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[2];
};

uint table;  // of this draw

// The layer that a view depth lies in; where layers overlap, the farthest. Depths behind the eye are nearest of all.
uint layerOf(float depth) {
  uint low = 0u, high = tables[table].layerCount - 1u;
  while (low < high) {  // The last layer whose nearest vergence is not in front of the depth.
    const uint middle = (low + high + 1u) / 2u;
    if (depth > 0.0 && depth * tables[table].layers[middle].nearest >= 1.0) {
      low = middle;
    } else {
      high = middle - 1u;
    }
  }
  return low;
}

void send(uint layer, bool clipNear, bool clipFar) {
  for (int i = 0; i < 3; ++i) {
    const float depth = gl_in[i].gl_Position.w;
    gl_Position = gl_in[i].gl_Position;
    gl_ClipDistance[0] = clipNear ? depth * tables[table].layers[layer].nearest - 1.0 : 1.0;
    gl_ClipDistance[1] = clipFar ? 1.0 - depth * tables[table].layers[layer].farthest : 1.0;
    gl_Layer = int(layer);
    gl_PrimitiveID = gl_PrimitiveIDIn;
    outViewPosition = viewPosition[i];
    outViewNormal = viewNormal[i];
    outTexCoords = texCoords[i];
    outVertexColor = vertexColor[i];
    outMaterialIndex = materialIndex[i];
    EmitVertex();
  }
  EndPrimitive();
}

void main() {
  table = uint(view.lensPoint.w);
  const vec3 depths = vec3(gl_in[0].gl_Position.w, gl_in[1].gl_Position.w, gl_in[2].gl_Position.w);
  const float farthest = max(depths.x, max(depths.y, depths.z));
  if (!(farthest > 0.0)) return;
  const uint last = layerOf(farthest);
  if (tables[table].splitTriangles == 0u) {
    if (gl_InvocationID == 0) send(last, false, false);
    return;
  }
  // Layers overlap: the nearest that a depth belongs to is the one before, or the same.
  const float nearest = min(depths.x, min(depths.y, depths.z));
  uint first = layerOf(nearest);
  if (first > 0u && nearest * tables[table].layers[first - 1u].farthest <= 1.0) --first;
  const uint begin = uint(gl_InvocationID) * kLayersPerInvocation;
  for (uint i = begin; i < begin + kLayersPerInvocation && first + i <= last; ++i) {
    const bool takesRest = i + 1u == kLayersPerInvocation * kInvocations;
    send(last - i, !takesRest && last - i > 0u, last - i + 1u < tables[table].layerCount);
  }
}
