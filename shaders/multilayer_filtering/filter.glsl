// The 2×2 merge of lists (Selgrad 2015 §5.1, fig. 2), as a mip step or a stack step (§5.2): the walk through four lists that
// counting and merging share. Bindings 0 to 2 are its own.
//
//   const int list = openLists();
//   if (list < 0) return;
//   while (advance()) {  // One loop: another in it, to skip fragments, counted wrongly on lavapipe (Mesa 22.3).
//     if (!isKept(vergence)) continue;
//     … the fragment `taken`, of list `tap`; startsAnother() …
//   }
#include "shaders/shared/multilayer_filtering.h"
#include "coverage.glsl"

layout(local_size_x = kMultilayerTile, local_size_y = kMultilayerTile) in;
layout(std430, set = 0, binding = 0) readonly buffer Levels { FilterLevel levels[]; };
layout(std430, set = 0, binding = 1) buffer Lists { uint lists[]; };
layout(std430, set = 0, binding = 2) buffer Vergences { float vergences[]; };
layout(push_constant) uniform Push { FilterPush push; };

FilterLevel made;  // the level

// Where the four lists are being read. Vectors, not arrays, so that they stay in registers.
uvec4 cursors, ends;
vec4 heads;  // vergence at the cursor; -1 at the end

// The fragment at hand.
uint taken, tap;
float vergence;
float limit = 3.4e38;  // the farthest vergence that joins the last fragment

// Precise, here and below: counting and merging are compiled apart and must decide alike.
float signedRadius(float vergence) {
  precise const float c = push.cocScale * (push.focusVergence - vergence);
  return c;
}

bool isKept(float vergence) {
  const float c = signedRadius(vergence);
  return abs(c) >= made.dropWithin && c >= made.lowest && c <= made.highest;
}

float headOf(uint cursor, uint end) { return cursor < end ? vergences[cursor] : -1.0; }

// Opens the lists that this invocation's cell is made of. Returns the cell's own list, or -1 outside of the level.
int openLists() {
  made = levels[push.level];
  const FilterLevel source = levels[push.level - 1u];
  const ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(cell, made.size))) return -1;
  const ivec2 index = cell + made.first;
  for (int k = 0; k < 4; ++k) {
    const ivec2 corner = ivec2(k & 1, k >> 1);
    const ivec2 at = made.tapDistance == 0 ? 2 * index + corner : index + made.tapDistance * corner;
    const ivec2 inside = clamp(at - source.first, ivec2(0), source.size - 1);  // beyond the border, its cells
    const uint list = source.firstList + uint(inside.y * source.size.x + inside.x);
    cursors[k] = min(lists[list], push.room);
    ends[k] = min(lists[list + 1u], push.room);
    heads[k] = headOf(cursors[k], ends[k]);
  }
  return int(made.firstList) + cell.y * made.size.x + cell.x;
}

// The farthest vergence that is merged with a fragment at this one: within a share of the size of the blur that it is for,
// or, nearer to focus, of this level's. So lists hold as many fragments as blur tells apart.
float mergeLimit(float vergence) {
  precise const float size = max(made.centre, abs(signedRadius(vergence)));
  precise const float farthest = vergence - push.epsilon * size / push.cocScale;
  return farthest;
}

// Takes the nearest fragment that is left. False when there is none.
bool advance() {
  vergence = -1.0;
  uint end = 0u;
  for (uint k = 0u; k < 4u; ++k) {
    if (heads[k] > vergence) {
      vergence = heads[k];
      taken = cursors[k];
      end = ends[k];
      tap = k;
    }
  }
  if (vergence < 0.0) return false;
  const bvec4 isIt = equal(uvec4(0u, 1u, 2u, 3u), uvec4(tap));
  cursors += uvec4(isIt);
  heads = mix(heads, vec4(headOf(taken + 1u, end)), isIt);
  return true;
}

// Whether the fragment at hand, which the level keeps, begins another of the level's or joins the last.
bool startsAnother() {
  if (vergence >= limit) return false;
  limit = mergeLimit(vergence);
  return true;
}
