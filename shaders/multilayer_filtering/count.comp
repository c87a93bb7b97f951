// How many fragments each cell's list will hold: the merge without its colours.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "filter.glsl"

void main() {
  const int list = openLists();
  if (list < 0) return;
  uint count = 0u;
  for (float nearest = nearestHead(); nearest >= 0.0; nearest = nearestHead()) {
    ++count;
    const float limit = mergeLimit(nearest);
    for (int k = 0; k < 4; ++k) {
      while (heads[k] >= limit && heads[k] >= 0.0) {
        ++cursors[k];
        settle(k);
      }
    }
  }
  lists[list] = count;
}
