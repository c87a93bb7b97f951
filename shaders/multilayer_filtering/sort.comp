// Sorts each pixel's list, nearest first, keeps the first kListLength of its fragments, and counts them. In place: the
// nodes stay where they are and are linked anew.
//
// A heap of the nearest fragments found so far, the farthest of them on top (heapsort, Williams 1964): a list of any length
// and order takes log2(kCandidates) steps a fragment. The order is total (depth, then the colour's bits), so the result does
// not depend on the order in which fragments arrived.
//
// Fragments of opaque surfaces that face away while an opaque surface that faces the camera is still open in front of them
// are the insides of solids: no lens ray sees them, but they would double the solid's opacity where it is blurred. With
// kOuter they are left out, as if counting with a stencil buffer.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/emit.h"
#include "shaders/shared/multilayer_filtering.h"
#include "shaders/shared/statistics.h"

layout(constant_id = 0) const uint kListLength = 4u;
layout(constant_id = 1) const uint kCandidates = 8u;  // sorted; more than are kept, for some will be left out
layout(constant_id = 2) const bool kOuter = true;

layout(local_size_x = kMultilayerTile, local_size_y = kMultilayerTile) in;
layout(set = 0, binding = 0, r32ui) uniform uimage2D heads;
layout(std430, set = 0, binding = 1) buffer Nodes { FragmentNode nodes[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Lists { uint counts[]; };
layout(std430, set = 0, binding = 3) buffer Statistics { FrameStatistics statistics; };

// The heap: vergences of fragments and their indices + 1, as in links.
uint vergences[kCandidates];
uint indices[kCandidates];
// Steps that loops may still take. Each turn of a loop counts for one more: that is what its end costs, which devices may
// count for invocations that do not enter it, too.
uint budget = kSortBudget;

// True when node a comes before node b, which is equally far.
bool precedesEqual(uint a, uint b) {
  const FragmentNode x = nodes[a - 1u], y = nodes[b - 1u];
  if (x.redGreen != y.redGreen) return x.redGreen < y.redGreen;
  if (x.blueAlpha != y.blueAlpha) return x.blueAlpha < y.blueAlpha;
  return (x.next & ~kFragmentNextMask) < (y.next & ~kFragmentNextMask);
}

// True when the fragment comes before entry i, nearer ones first.
bool precedes(uint vergence, uint index, uint i) {
  return vergence > vergences[i] || (vergence == vergences[i] && precedesEqual(index, indices[i]));
}

void set(uint i, uint vergence, uint index) {
  vergences[i] = vergence;
  indices[i] = index;
}

// Puts a fragment into the heap's last place and lets it rise.
void rise(uint i, uint vergence, uint index) {
  for (; i > 0u && budget > 0u; --budget) {
    const uint above = (i - 1u) / 2u;
    if (precedes(vergence, index, above)) break;
    set(i, vergences[above], indices[above]);
    i = above;
  }
  set(i, vergence, index);
}

// Puts a fragment on top of a heap of `count` and lets it sink.
void sink(uint count, uint vergence, uint index) {
  uint i = 0u;
  for (; 2u * i + 1u < count && budget > 0u; --budget) {
    uint below = 2u * i + 1u;
    if (below + 1u < count && precedes(vergences[below], indices[below], below + 1u)) ++below;
    if (!precedes(vergence, index, below)) break;
    set(i, vergences[below], indices[below]);
    i = below;
  }
  set(i, vergence, index);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = imageSize(heads);
  if (any(greaterThanEqual(pixel, size))) return;

  uint kept = 0u;
  uint node = imageLoad(heads, pixel).r;
  for (; node != 0u && budget > kSortReserve; budget -= 3u) {
    const uint vergence = nodes[node - 1u].vergence;
    if (kept < kCandidates) {
      rise(kept, vergence, node);
      ++kept;
    } else if (precedes(vergence, node, 0u)) {
      sink(kept, vergence, node);
    }
    node = nodes[node - 1u].next & kFragmentNextMask;
  }
  if (node != 0u) atomicAdd(statistics.unsortedLists, 1u);
  for (uint heap = kept; heap > 1u; --heap) {  // The farthest goes behind those that are left.
    const uint vergence = vergences[heap - 1u], index = indices[heap - 1u];
    set(heap - 1u, vergences[0], indices[0]);
    sink(heap - 1u, vergence, index);
  }

  uint count = 0u, last = 0u;
  int open = 0;  // solids that the viewing ray is in
  for (uint i = 0u; i < kept && count < kListLength; ++i) {
    const uint flags = nodes[indices[i] - 1u].next;
    if (kOuter && (flags & kFragmentSolid) != 0u) {
      const bool leaves = (flags & kFragmentFacesAway) != 0u;
      if (leaves && open > 0) {
        --open;
        continue;
      }
      if (!leaves) ++open;
    }
    if (count == 0u) {
      imageStore(heads, pixel, uvec4(indices[i]));
    } else {
      nodes[last - 1u].next = indices[i];
    }
    last = indices[i];
    ++count;
  }
  counts[pixel.y * size.x + pixel.x] = count;
}
