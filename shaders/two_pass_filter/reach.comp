// For each tile, how many taps to either side the two filters need there: (horizontal, vertical).
//
// Exact, not an estimate: a pixel P weighs something at distance d only if r_p > d (Zhou 2007 §4.2, O), so a tile whose
// largest radius does not exceed its distance to this tile can be left out without changing a bit of the picture. It
// takes the place of the paper's filter width, which follows the scene's largest CoC everywhere.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/two_pass_filter.h"

layout(local_size_x = kTwoPassFilterTile, local_size_y = kTwoPassFilterTile) in;

layout(binding = 0) readonly buffer TileRadii { float tileRadii[]; };  // px
layout(binding = 1) writeonly buffer TileTaps { uvec2 tileTaps[]; };
layout(push_constant) uniform Constants { TwoPassFilterConstants constants; };

// Largest radius along `axis` that comes across to this tile; then the largest whole d with r > d.
uint tapsAlong(ivec2 tile, ivec2 axis) {
  int last = axis.x > 0 ? constants.tiles.x - 1 : constants.tiles.y - 1;
  int here = axis.x > 0 ? tile.x : tile.y;
  int reach = int(ceil(radiusLimit(constants))) / int(kTwoPassFilterTile) + 1;
  float largest = 0.0;
  for (int i = max(here - reach, 0); i <= min(here + reach, last); ++i) {
    ivec2 other = tile + (i - here) * axis;
    float radius = tileRadii[other.y * constants.tiles.x + other.x];
    // px between the nearest pixels of the two tiles; 0 within one.
    int nearest = max(abs(i - here) - 1, 0) * int(kTwoPassFilterTile) + (i == here ? 0 : 1);
    if (radius > float(nearest)) largest = max(largest, radius);
  }
  return uint(max(ceil(largest) - 1.0, 0.0));
}

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(tile, constants.tiles))) return;
  tileTaps[tile.y * constants.tiles.x + tile.x] = uvec2(tapsAlong(tile, ivec2(1, 0)), tapsAlong(tile, ivec2(0, 1)));
}
