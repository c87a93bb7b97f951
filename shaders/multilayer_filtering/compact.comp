// Copies each pixel's sorted list to its place in consecutive arrays: level 0 of the hierarchy. Depth becomes vergence,
// radiance premultiplied; what is not finite becomes black and is counted.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/emit.h"
#include "shaders/shared/multilayer_filtering.h"
#include "shaders/shared/statistics.h"

layout(constant_id = 0) const bool kHasCoverage = false;

layout(local_size_x = kMultilayerTile, local_size_y = kMultilayerTile) in;
layout(set = 0, binding = 0, r32ui) readonly uniform uimage2D heads;
layout(std430, set = 0, binding = 1) readonly buffer Nodes { FragmentNode nodes[]; };
layout(std430, set = 0, binding = 2) readonly buffer Allocator { uint nodesAskedFor; };
layout(std430, set = 0, binding = 3) readonly buffer Lists { uint lists[]; };
layout(std430, set = 0, binding = 4) writeonly buffer Vergences { float vergences[]; };
layout(std430, set = 0, binding = 5) writeonly buffer Colors { uvec2 colors[]; };
layout(std430, set = 0, binding = 6) writeonly buffer Coverages { float coverages[]; };
layout(std430, set = 0, binding = 7) buffer Statistics { FrameStatistics statistics; };
layout(push_constant) uniform Push { CompactPush push; };

// By its bits: isnan() may be optimised away where a device does not promise to keep NaN.
bool isFinite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel == ivec2(0)) {
    const uint room = uint(nodes.length()) - push.reservedNodes;
    statistics.fragmentNodes = nodesAskedFor;
    statistics.fragmentNodesDropped = nodesAskedFor > room ? nodesAskedFor - room : 0u;
  }
  if (any(greaterThanEqual(pixel, push.size))) return;
  const uint list = pixel.y * push.size.x + pixel.x;
  const uint begin = min(lists[list], push.room), end = min(lists[list + 1u], push.room);
  uint node = imageLoad(heads, pixel).r;
  uint replaced = 0u;
  bool isLimited = false;
  for (uint i = begin; i < end; ++i) {
    const FragmentNode fragment = nodes[node - 1u];
    node = fragment.next & kFragmentNextMask;
    const vec2 redGreen = unpackHalf2x16(fragment.redGreen), blueAlpha = unpackHalf2x16(fragment.blueAlpha);
    vec3 rgb = vec3(redGreen, blueAlpha.x);
    if (!(isFinite(rgb.r) && isFinite(rgb.g) && isFinite(rgb.b))) {
      rgb = vec3(0.0);
      ++replaced;
    }
    rgb *= blueAlpha.y;
    const float vergence = max(vergenceFromDepthBuffer(push.lens, uintBitsToFloat(fragment.vergence)), 0.0);
    isLimited = isLimited || abs(signedCocRadius(push.lens, vergence)) >= push.lens.maxCocRadius;
    vergences[i] = vergence;
    colors[i] = uvec2(packHalf2x16(rgb.rg), packHalf2x16(vec2(rgb.b, blueAlpha.y)));
    if (kHasCoverage) coverages[i] = 1.0;
  }
  if (replaced > 0u) atomicAdd(statistics.replacedTexels, replaced);
  if (isLimited) atomicAdd(statistics.clampedCoc, 1u);
}
