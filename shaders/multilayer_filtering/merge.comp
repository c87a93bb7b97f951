// Writes each cell's list: fragments of the four lists that are nearly equally far become one, a quarter of each list's
// share (Selgrad 2015 §5.1).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "filter.glsl"

layout(constant_id = 0) const bool kHasCoverage = false;

layout(std430, set = 0, binding = 3) buffer Colors { uvec2 colors[]; };
layout(std430, set = 0, binding = 4) buffer Coverages { float coverages[]; };

Layer fragmentAt(uint i) {
  const vec2 redGreen = unpackHalf2x16(colors[i].x), blueAlpha = unpackHalf2x16(colors[i].y);
  return Layer(vec3(redGreen, blueAlpha.x), blueAlpha.y, kHasCoverage ? coverages[i] : blueAlpha.y);
}

void main() {
  const int list = openLists();
  if (list < 0) return;
  uint target = lists[list];
  for (float nearest = nearestHead(); nearest >= 0.0 && target < push.room; nearest = nearestHead()) {
    const float limit = mergeLimit(nearest);
    Layer sum = kNoLayer;
    float covered = 0.0, depth = 0.0;  // Σ coverage, Σ coverage · (how much farther than the nearest)
    for (int k = 0; k < 4; ++k) {
      Layer own = kNoLayer;
      while (heads[k] >= limit && heads[k] >= 0.0) {
        const Layer fragment = fragmentAt(cursors[k]);
        const float seen = addBehind(own, fragment) * fragment.coverage;
        covered += seen;
        depth += seen * (nearest - heads[k]);
        ++cursors[k];
        settle(k);
      }
      sum.color += 0.25 * own.color;
      sum.alpha += 0.25 * own.alpha;
      sum.coverage += 0.25 * own.coverage;
    }
    vergences[target] = covered > 0.0 ? max(nearest - depth / covered, limit) : nearest;
    colors[target] = uvec2(packHalf2x16(sum.color.rg), packHalf2x16(vec2(sum.color.b, sum.alpha)));
    if (kHasCoverage) coverages[target] = sum.coverage;
    ++target;
  }
}
