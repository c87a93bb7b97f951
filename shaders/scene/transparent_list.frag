// SceneEmit::transparentList: every visible fragment of an alpha-blended surface joins the list of its pixel.
// The order in a list is the order of arrival; whoever reads it sorts. A full pool drops fragments; the allocator tells how many were asked for.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface.glsl"
#include "shaders/shared/emit.h"

// Hidden fragments must not be appended, so the depth test comes first.
layout(early_fragment_tests) in;

layout(set = 2, binding = 0, r32ui) uniform coherent uimage2D heads;
layout(std430, set = 2, binding = 1) writeonly buffer Nodes { TransparentNode nodes[]; };
layout(std430, set = 2, binding = 2) buffer Allocator { uint nodesAskedFor; };

void main() {
  const vec4 color = surface();
  // Helper invocations have no side effects; NaN alpha is no surface.
  if (!(color.a > 0.0)) return;
  const uint index = atomicAdd(nodesAskedFor, 1u);
  if (index >= nodes.length()) return;
  const uint next = imageAtomicExchange(heads, ivec2(gl_FragCoord.xy), index + 1u);
  nodes[index] = TransparentNode(color.r, color.g, color.b, min(color.a, 1.0), gl_FragCoord.z, next);
}
