// appendFragment(): a fragment joins the list of its pixel (Yang, Hensley, Grün, Thibieroz 2010). Include where bindings 0
// to 2 of set 2 are those of SceneEmit::fragmentList.
//
// The first fragment of a pixel takes the pixel's reserved node, so that there is always one, and that with a single atomic.
// Further ones take a node of the pool, are written, and only then linked in by compare-and-swap: whoever walks a list
// while others append meets complete nodes, or reserved ones that say they are pending. When the pool is full, a fragment
// takes the place of the farthest in its list if it is nearer itself. So no pixel loses its nearest surface.
//
// Helper invocations change nothing, and what atomics give them is undefined: loops are bounded and indices checked.
#include "shaders/shared/emit.h"

layout(set = 2, binding = 0, r32ui) uniform coherent uimage2D heads;
layout(std430, set = 2, binding = 1) coherent buffer Nodes { FragmentNode nodes[]; };
layout(std430, set = 2, binding = 2) buffer Allocator { uint nodesAskedFor; };

// Another fragment of the same pixel can get in between at most as often as there are others at work at once.
const int kTries = 256;
const int kLongestWalk = 200;  // Tries and walks together stay below what devices let loops do (65 535).

void writeColor(uint index, uvec2 color) {
  nodes[index].redGreen = color.x;
  nodes[index].blueAlpha = color.y;
}

void replaceFarthest(ivec2 pixel, uvec2 color, uint vergence, uint flags) {
  for (int attempt = 0; attempt < kTries; ++attempt) {
    uint farthest = vergence, found = 0u;
    bool sawPending = false;
    uint i = imageLoad(heads, pixel).r;
    memoryBarrier();
    for (int step = 0; step < kLongestWalk && i != 0u && i <= nodes.length(); ++step) {
      const uint other = nodes[i - 1u].vergence;
      sawPending = sawPending || other == kFragmentPending;
      if (other < farthest) {  // A pending one is never less.
        farthest = other;
        found = i;
      }
      i = nodes[i - 1u].next & kFragmentNextMask;
    }
    if (found == 0u) {
      if (!sawPending) return;
      continue;  // What is being written may turn out to be farther.
    }
    if (atomicCompSwap(nodes[found - 1u].vergence, farthest, kFragmentPending) != farthest) continue;
    memoryBarrier();
    writeColor(found - 1u, color);
    nodes[found - 1u].next = (nodes[found - 1u].next & kFragmentNextMask) | flags;
    memoryBarrier();
    atomicExchange(nodes[found - 1u].vergence, vergence);
    return;
  }
}

// color: half floats, not premultiplied, alpha above 0. vergence: gl_FragCoord.z.
void appendFragment(vec4 color, float depthValue, bool isSolid, bool facesAway) {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const uvec2 packed = uvec2(packHalf2x16(color.rg), packHalf2x16(color.ba));
  const uint vergence = floatBitsToUint(max(depthValue, 0.0));
  const uint flags = (isSolid ? kFragmentSolid : 0u) | (facesAway ? kFragmentFacesAway : 0u);
  const uvec2 size = uvec2(imageSize(heads));
  const uint reserved = uint(pixel.y) * size.x + uint(pixel.x);

  uint head = imageAtomicCompSwap(heads, pixel, 0u, reserved + 1u);
  if (head == 0u) {
    writeColor(reserved, packed);
    nodes[reserved].next = flags;
    memoryBarrier();
    atomicExchange(nodes[reserved].vergence, vergence);
    return;
  }
  const uint index = size.x * size.y + atomicAdd(nodesAskedFor, 1u);
  if (index >= nodes.length()) {
    replaceFarthest(pixel, packed, vergence, flags);
    return;
  }
  writeColor(index, packed);
  nodes[index].vergence = vergence;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    nodes[index].next = head | flags;
    memoryBarrier();
    const uint now = imageAtomicCompSwap(heads, pixel, head, index + 1u);
    if (now == head) return;
    head = now;
  }
}
