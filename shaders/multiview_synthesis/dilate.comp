// One level of the N-buffer (Décoret 2005; Lee, Eisemann, Seidel 2009, §4.3): which slices hold anything in the square
// of 2^level cells that begins at a cell. A bit per slice takes the place of the paper's least depth, since a layer holds
// nothing but what lies between its borders.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/multiview_synthesis.h"

layout(local_size_x = kMultiviewTile, local_size_y = kMultiviewTile) in;
layout(std430, set = 0, binding = 0) buffer Occupied { uvec2 occupied[]; };
layout(push_constant) uniform Push { DilatePush push; };

void main() {
  const ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(cell, push.cells))) return;
  const int levelSize = push.cells.x * push.cells.y;
  const int below = (int(push.level) - 1) * levelSize;
  const ivec2 other = min(cell + (1 << (push.level - 1u)), push.cells - 1);
  occupied[below + levelSize + cell.y * push.cells.x + cell.x] =
      occupied[below + cell.y * push.cells.x + cell.x] | occupied[below + cell.y * push.cells.x + other.x] |
      occupied[below + other.y * push.cells.x + cell.x] | occupied[below + other.y * push.cells.x + other.x];
}
