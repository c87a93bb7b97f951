// Early layer culling (Lee, Eisemann, Seidel 2009, §4.3): the slices that a ray of any pixel of a cell may hit. In a layer
// all rays of a pixel stay inside the circle of confusion of one of its borders.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/emit.h"
#include "shaders/shared/multiview_synthesis.h"

#include "slice_mask.glsl"

layout(local_size_x = kMultiviewTile, local_size_y = kMultiviewTile) in;
layout(std430, set = 0, binding = 0) readonly buffer Occupied { uvec2 occupied[]; };
layout(std430, set = 0, binding = 1) readonly buffer Tables { SceneLayerTable tables[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Visits { uvec2 visits[]; };
layout(push_constant) uniform Push { VisitPush push; };

uvec2 maskAt(uint level, ivec2 cell) {
  return occupied[(int(level) * push.cells.y + cell.y) * push.cells.x + cell.x];
}

// What a square of cells holds: four squares of a power of two, anchored at its corners, cover it.
uvec2 maskOf(ivec2 low, ivec2 high) {
  low = max(low, ivec2(0));
  high = min(high, push.cells - 1);
  const ivec2 side = high - low + 1;
  const uint level = min(uint(findMSB(max(min(side.x, side.y), 1))), push.highestLevel);
  const int step = 1 << level;
  uvec2 mask = uvec2(0u);
  // Clamped at the picture's edges the square may be longer one way than two of its squares.
  for (int y = low.y; y <= high.y; y += step) {
    for (int x = low.x; x <= high.x; x += step) {
      mask |= maskAt(level, ivec2(max(min(x, high.x + 1 - step), low.x), max(min(y, high.y + 1 - step), low.y)));
    }
  }
  return mask;
}

void main() {
  const ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(cell, push.cells))) return;
  uvec2 mask = uvec2(0u);
  for (uint l = 0u; l < push.layerCount; ++l) {
    const float widest = max(abs(push.focusVergence - tables[push.table].layers[l].borders.x),
                             abs(push.focusVergence - tables[push.table].layers[l].borders.y));
    // A pixel more: rays start at pixel centres and look up the texel they are in.
    const float radius = min(push.cocScale * widest * push.rayReach + 1.0, 1e6);
    const int reach = int(ceil(radius / float(kMultiviewCell)));
    uvec2 own = bitOf(l);
    if (push.hasTransparency != 0u) own |= bitOf(push.layerCount + l);
    mask |= maskOf(cell - reach, cell + reach) & own;
  }
  visits[cell.y * push.cells.x + cell.x] = mask;
}
