// The 2×2 merge of lists (Selgrad 2015 §5.1, fig. 2), as a mip step or a stack step (§5.2). Include after the bindings:
// the walk that counting and merging share.
#include "shaders/shared/multilayer_filtering.h"
#include "coverage.glsl"

layout(local_size_x = kMultilayerTile, local_size_y = kMultilayerTile) in;
layout(std430, set = 0, binding = 0) readonly buffer Levels { FilterLevel levels[]; };
layout(std430, set = 0, binding = 1) buffer Lists { uint lists[]; };
layout(std430, set = 0, binding = 2) buffer Vergences { float vergences[]; };
layout(push_constant) uniform Push { FilterPush push; };

// Where the four lists are being read.
uint cursors[4];
uint ends[4];
float heads[4];  // vergence at the cursor; -1 at the end

float signedRadius(float vergence) { return push.cocScale * (push.focusVergence - vergence); }

bool isKept(float vergence) {
  const float c = signedRadius(vergence);
  return abs(c) >= levels[push.level].dropWithin && c >= levels[push.level].lowest && c <= levels[push.level].highest;
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

// The cell's index within the level's window, or -1 outside.
int cellOf(ivec2 cell) {
  const ivec2 size = levels[push.level].size;
  return any(greaterThanEqual(cell, size)) ? -1 : cell.y * size.x + cell.x;
}

void openLists(ivec2 cell) {
  const uint source = push.level - 1u;
  const ivec2 index = cell + levels[push.level].first;
  const int distance = levels[push.level].tapDistance;
  const ivec2 last = levels[source].size - 1;
  for (int k = 0; k < 4; ++k) {
    const ivec2 corner = ivec2(k & 1, k >> 1);
    const ivec2 tap = distance == 0 ? 2 * index + corner : index + distance * corner;
    const ivec2 inside = clamp(tap - levels[source].first, ivec2(0), last);  // beyond the border, its cells
    const uint list = levels[source].firstList + uint(inside.y * levels[source].size.x + inside.x);
    cursors[k] = min(lists[list], push.room);
    ends[k] = min(lists[list + 1u], push.room);
    settle(k);
  }
}

float nearestHead() { return max(max(heads[0], heads[1]), max(heads[2], heads[3])); }

// The farthest vergence that is merged with a fragment at this one: within a share of the size of the blur that it is for,
// or, nearer to focus, of this level's. So lists hold as many fragments as blur tells apart.
float mergeLimit(float vergence) {
  const float size = max(levels[push.level].centre, abs(signedRadius(vergence)));
  return vergence - push.epsilon * size / push.cocScale;
}
