// Sorts each pixel's list, nearest first, keeps the first kListLength of its fragments, and counts them. In place: the
// nodes stay where they are and are linked anew.
//
// Insertion sort into a small array. The order is total (depth, then the colour's bits), so the result does not depend on
// the order in which fragments arrived.
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

// The nearest fragments found so far, nearest first: vergences, and indices + 1 as in links.
uint vergences[kCandidates];
uint indices[kCandidates];

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

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = imageSize(heads);
  if (any(greaterThanEqual(pixel, size))) return;

  uint kept = 0u;
  uint budget = kSortBudget;
  uint node = imageLoad(heads, pixel).r;
  // A turn counts for itself and for the inner loop's end, which devices may count for invocations that skip it, too.
  for (; node != 0u && budget > 2u + kCandidates; budget -= 2u) {
    const uint index = node, vergence = nodes[node - 1u].vergence;
    node = nodes[node - 1u].next & kFragmentNextMask;
    uint place = kept;
    if (kept == kCandidates) {
      if (!precedes(vergence, index, kept - 1u)) continue;
      --place;
    } else {
      ++kept;
    }
    for (; place > 0u && precedes(vergence, index, place - 1u); --place, --budget) {
      vergences[place] = vergences[place - 1u];
      indices[place] = indices[place - 1u];
    }
    vergences[place] = vergence;
    indices[place] = index;
  }
  if (node != 0u) atomicAdd(statistics.unsortedLists, 1u);

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
