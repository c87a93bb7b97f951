// Which levels show anything in each tile of the picture: a bit for each level in front of the focal plane, and, from
// kShownFarShift on, one for each behind it. Accumulation opens no others.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/multilayer_filtering.h"

layout(local_size_x = kMultilayerTile, local_size_y = kMultilayerTile) in;
layout(std430, set = 0, binding = 0) readonly buffer Levels { FilterLevel levels[]; };
layout(std430, set = 0, binding = 1) readonly buffer Lists { uint lists[]; };
layout(std430, set = 0, binding = 2) readonly buffer Vergences { float vergences[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Shown { uint shown[]; };
layout(push_constant) uniform Push { ShownPush push; };

uint shownBy(uint level, ivec2 tile) {
  const FilterLevel at = levels[level];
  const vec2 first = vec2(tile * int(kMultilayerTile)) + 0.5;
  const vec2 end = first + float(kMultilayerTile);
  const ivec2 low = clamp(ivec2(floor((first - at.centre) / at.cellSize)) - at.first, ivec2(0), at.size - 1);
  const ivec2 high = clamp(ivec2(floor((end - at.centre) / at.cellSize)) + 1 - at.first, ivec2(0), at.size - 1);
  const bool isLast = level + 1u == push.levelCount;
  uint bits = 0u;
  for (int y = low.y; y <= high.y; ++y) {
    const uint row = at.firstList + uint(y * at.size.x);
    const uint rowEnd = min(lists[row + uint(high.x) + 1u], push.room);
    for (uint i = min(lists[row + uint(low.x)], push.room); i < rowEnd; ++i) {  // The row's lists are one range.
      const float c = push.cocScale * (push.focusVergence - vergences[i]);
      const float square = min(c * c, push.mostSquare);
      if (square >= at.inner && (isLast || square <= at.outer)) bits |= c < 0.0 ? 1u : 1u << kShownFarShift;
    }
  }
  return bits << level;
}

void main() {
  const ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(tile, push.tiles))) return;
  uint bits = 0u;
  for (uint level = push.finestShown; level < push.levelCount; ++level) bits |= shownBy(level, tile);
  shown[tile.y * push.tiles.x + tile.x] = bits;
}
