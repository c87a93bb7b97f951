// How many fragments each cell's list will hold: the merge without its colours.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "filter.glsl"

void main() {
  const int list = openLists();
  if (list < 0) return;
  uint count = 0u;
  while (advance()) {
    if (isKept(vergence) && startsAnother()) ++count;
  }
  lists[list] = count;
}
