// The 2×2 merge of lists (Selgrad 2015 §5.1, fig. 2), as a mip step or a stack step (§5.2). Include after the bindings:
// the walk that counting and merging share.
#include "shaders/shared/multilayer_filtering.h"
#include "coverage.glsl"

layout(local_size_x = kMultilayerTile, local_size_y = kMultilayerTile) in;
layout(std430, set = 0, binding = 0) readonly buffer Levels { FilterLevel levels[]; };
layout(std430, set = 0, binding = 1) buffer Lists { uint lists[]; };
layout(std430, set = 0, binding = 2) buffer Vergences { float vergences[]; };
layout(push_constant) uniform Push { FilterPush push; };

FilterLevel made;  // the level

// Where the four lists are being read.
uint cursors[4];
uint ends[4];
float heads[4];  // vergence at the cursor; -1 at the end

float signedRadius(float vergence) { return push.cocScale * (push.focusVergence - vergence); }

bool isKept(float vergence) {
  const float c = signedRadius(vergence);
  return abs(c) >= made.dropWithin && c >= made.lowest && c <= made.highest;
}

// To the next fragment that this level keeps.
void settle(int k) {
  while (cursors[k] < ends[k]) {
    heads[k] = vergences[cursors[k]];
    if (isKept(heads[k])) return;
    ++cursors[k];
  }
  heads[k] = -1.0;
}

// Opens the lists that this invocation's cell is made of. Returns the cell's own list, or -1 outside of the level.
int openLists() {
  made = levels[push.level];
  const FilterLevel source = levels[push.level - 1u];
  const ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(cell, made.size))) return -1;
  const ivec2 index = cell + made.first;
  for (int k = 0; k < 4; ++k) {
    const ivec2 corner = ivec2(k & 1, k >> 1);
    const ivec2 tap = made.tapDistance == 0 ? 2 * index + corner : index + made.tapDistance * corner;
    const ivec2 inside = clamp(tap - source.first, ivec2(0), source.size - 1);  // beyond the border, its cells
    const uint list = source.firstList + uint(inside.y * source.size.x + inside.x);
    cursors[k] = min(lists[list], push.room);
    ends[k] = min(lists[list + 1u], push.room);
    settle(k);
  }
  return int(made.firstList) + cell.y * made.size.x + cell.x;
}

float nearestHead() { return max(max(heads[0], heads[1]), max(heads[2], heads[3])); }

// The farthest vergence that is merged with a fragment at this one: within a share of the size of the blur that it is for,
// or, nearer to focus, of this level's. So lists hold as many fragments as blur tells apart.
float mergeLimit(float vergence) {
  const float size = max(made.centre, abs(signedRadius(vergence)));
  return vergence - push.epsilon * size / push.cocScale;
}
