// Which looks show anything in each tile of the picture: a bit for each. Accumulation opens no others.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/multilayer_filtering.h"

layout(local_size_x = kMultilayerTile, local_size_y = kMultilayerTile) in;
layout(std430, set = 0, binding = 0) readonly buffer Levels { FilterLevel levels[]; };
layout(std430, set = 0, binding = 1) readonly buffer Looks { FilterLook looks[]; };
layout(std430, set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(std430, set = 0, binding = 3) readonly buffer Vergences { float vergences[]; };
layout(std430, set = 0, binding = 4) writeonly buffer Shown { uint shown[]; };
layout(push_constant) uniform Push { ShownPush push; };

// Steps of loops so far. Devices may end loops after 65 535, silently: looks that remain count as shown, which only costs
// time.
uint steps = 0u;
const uint kMostSteps = 30000u;

bool shows(uint number, ivec2 tile) {
  const FilterLook look = looks[number];
  const FilterLevel level = levels[look.level];
  const vec2 first = vec2(tile * int(kMultilayerTile)) + 0.5;
  const ivec2 reach = ivec2(ceil(look.ring));
  const ivec2 low = ivec2(floor((first - level.centre) / level.cellSize)) - reach - level.first;
  const ivec2 high = ivec2(floor((first + float(kMultilayerTile) - level.centre) / level.cellSize)) + 1 + reach - level.first;
  const ivec2 begin = clamp(low, ivec2(0), level.size - 1), end = clamp(high, ivec2(0), level.size - 1);
  for (int y = begin.y; y <= end.y; ++y, ++steps) {
    if (steps > kMostSteps) return true;
    const uint row = level.firstList + uint(y * level.size.x);
    const uint rowEnd = min(lists[row + uint(end.x) + 1u], push.room);
    for (uint i = min(lists[row + uint(begin.x)], push.room); i < rowEnd; ++i, ++steps) {  // The row's lists are one range.
      if (steps > kMostSteps) return true;
      if (vergences[i] < 0.0) continue;
      const float c = push.cocScale * (push.focusVergence - vergences[i]);
      const float square = min(c * c, push.mostSquare);
      if (square >= look.inner && square <= look.outer) return true;
    }
  }
  return false;
}

void main() {
  const ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(tile, push.tiles))) return;
  uint bits = 0u;
  for (uint look = 0u; look < push.lookCount; ++look) bits |= shows(look, tile) ? 1u << look : 0u;
  shown[tile.y * push.tiles.x + tile.x] = bits;
}
