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

// The fragment that is being made: the sum of four lists, what each has added, and how far it is.
Layer sum = kNoLayer;
vec4 coverage, alpha;  // of each list
uint end;  // of the list
float nearest, farthest;
float covered, behind;  // Σ coverage, Σ coverage · (how much farther than the nearest)

void write(uint target) {
  if (target >= end) return;  // No further than was counted.
  vergences[target] = covered > 0.0 ? max(nearest - behind / covered, farthest) : nearest;
  colors[target] = uvec2(packHalf2x16(0.25 * sum.color.rg), packHalf2x16(0.25 * vec2(sum.color.b, sum.alpha)));
  if (kHasCoverage) coverages[target] = 0.25 * sum.coverage;
}

void start() {
  sum = kNoLayer;
  coverage = alpha = vec4(0.0);
  nearest = vergence;
  covered = behind = 0.0;
}

void main() {
  const int list = openLists();
  if (list < 0) return;
  uint target = lists[list];
  end = min(lists[list + 1], push.room);
  bool isFirst = true;
  while (advance()) {
    if (!isKept(vergence)) continue;
    if (startsAnother()) {
      if (!isFirst) write(target++);
      start();
      isFirst = false;
    }
    farthest = vergence;
    const Layer fragment = fragmentAt(taken);
    Layer own = Layer(vec3(0.0), alpha[tap], coverage[tap]);
    const float seen = addBehind(own, fragment);
    const bvec4 isIt = equal(uvec4(0u, 1u, 2u, 3u), uvec4(tap));
    coverage = mix(coverage, vec4(own.coverage), isIt);
    alpha = mix(alpha, vec4(own.alpha), isIt);
    sum.color += seen * fragment.color;
    sum.alpha += seen * fragment.alpha;
    sum.coverage += seen * fragment.coverage;
    covered += seen * fragment.coverage;
    behind += seen * fragment.coverage * (nearest - vergence);
  }
  if (!isFirst) write(target++);
  for (; target < end; ++target) vergences[target] = -1.0;  // Should fewer come than were counted: ends the list.
}
