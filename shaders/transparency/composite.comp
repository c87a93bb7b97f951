// Alpha-blended fragments over the opaque picture, exactly, per pixel: the list is walked from the farthest node to the
// nearest, each step taking the next in a total order (depth, then the colour's bits), so the picture does not depend
// on the order of arrival and intersecting surfaces come out right.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/emit.h"
#include "shaders/shared/statistics.h"
#include "shaders/shared/transparency.h"

layout(local_size_x = kTransparencyTile, local_size_y = kTransparencyTile) in;
layout(set = 0, binding = 0, rgba32f) uniform image2D color;
layout(set = 0, binding = 1, r32ui) uniform readonly uimage2D heads;
layout(std430, set = 0, binding = 2) readonly buffer Nodes { TransparentNode nodes[]; };
layout(std430, set = 0, binding = 3) readonly buffer Allocator { uint nodesAskedFor; };
layout(std430, set = 0, binding = 4) buffer Statistics { FrameStatistics statistics; };

// True when a stands strictly before b: farther, or equally far with smaller colour bits.
bool precedes(TransparentNode a, TransparentNode b) {
  if (a.vergence != b.vergence) return a.vergence < b.vergence;
  const uvec4 x = floatBitsToUint(vec4(a.red, a.green, a.blue, a.alpha));
  const uvec4 y = floatBitsToUint(vec4(b.red, b.green, b.blue, b.alpha));
  if (x.r != y.r) return x.r < y.r;
  if (x.g != y.g) return x.g < y.g;
  if (x.b != y.b) return x.b < y.b;
  return x.a < y.a;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel == ivec2(0)) {
    atomicMax(statistics.transparentNodes, nodesAskedFor);
    const uint room = uint(nodes.length());
    atomicMax(statistics.transparentDropped, nodesAskedFor > room ? nodesAskedFor - room : 0u);
  }
  if (any(greaterThanEqual(pixel, imageSize(color)))) return;
  const uint head = imageLoad(heads, pixel).r;
  if (head == 0u) return;
  vec4 below = imageLoad(color, pixel);
  TransparentNode done;
  bool first = true;
  // A device may end loops after 65 535 iterations; the budget ends the walk before, over both loops.
  uint budget = kTransparencyBudget;
  for (;;) {
    TransparentNode best;
    uint copies = 0u;  // nodes equal in every bit stand at one place of the order
    for (uint i = head; i != 0u && budget > 0u; --budget) {
      const TransparentNode node = nodes[i - 1u];
      i = node.next;
      if (!first && !precedes(done, node)) continue;
      if (copies == 0u || precedes(node, best)) {
        best = node;
        copies = 1u;
      } else if (!precedes(best, node)) {
        ++copies;
      }
    }
    if (budget == 0u) {  // This walk may be incomplete: its find is not to be trusted.
      atomicAdd(statistics.transparentUnsorted, 1u);
      break;
    }
    if (copies == 0u) break;
    // The same fragment `copies` times over: transmittance (1 - a)^copies.
    const float transmittance = pow(max(1.0 - best.alpha, 0.0), float(copies));
    const float kept = copies == 1u ? 1.0 - best.alpha : transmittance;
    below.rgb = vec3(best.red, best.green, best.blue) * (1.0 - kept) + below.rgb * kept;
    done = best;
    first = false;
  }
  imageStore(color, pixel, below);
}
