// Each tile's largest blur radius, and how many pixels' blur was limited.
//
// One invocation a tile: on devices where barriers within a work group are dear (software ones), a reduction in shared
// memory costs more than all 256 loads, and on others the pass is too short to matter.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/statistics.h"
#include "shaders/shared/two_pass_filter.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0, rgba32f) readonly uniform image2D prepared;
layout(binding = 1) writeonly buffer TileRadii { float tileRadii[]; };  // px
layout(binding = 2) buffer Statistics { FrameStatistics statistics; };
layout(push_constant) uniform Constants { TwoPassFilterConstants constants; };

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(tile, constants.tiles))) return;

  ivec2 first = tile * int(kTwoPassFilterTile);
  ivec2 end = min(first + int(kTwoPassFilterTile), constants.size);
  float largest = 0.0;
  uint limited = 0u;
  for (int y = first.y; y < end.y; ++y) {
    for (int x = first.x; x < end.x; ++x) {
      float radius = abs(imageLoad(prepared, ivec2(x, y)).a);
      largest = max(largest, radius);
      if (radius >= radiusLimit(constants)) ++limited;
    }
  }
  tileRadii[tile.y * constants.tiles.x + tile.x] = largest;
  if (limited > 0u) atomicAdd(statistics.clampedCoc, limited);
}
