// The picture: each pixel's fragments from near to far, from the levels whose filter is as wide as their circle of confusion
// (Selgrad 2015 §6.1), composited.
//
// The walk goes through the levels' intervals of vergence: in front of the focal plane from the coarsest to the finest,
// behind it back. In each interval two levels show, weighted by the blur (interpolation between levels), and each is
// looked up bilinearly (four cells). Fragments that follow one another without a gap are of one surface: side by side,
// or the same surface from another level or cell. They are added up; surfaces are composited one over the other.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/multilayer_filtering.h"
#include "shaders/shared/statistics.h"
#include "coverage.glsl"

layout(constant_id = 0) const bool kHasCoverage = false;
layout(constant_id = 1) const bool kInterpolateLevels = true;
layout(constant_id = 2) const bool kBilinear = true;
layout(constant_id = 3) const bool kAdditive = false;
layout(constant_id = 4) const float kStepAt = 0.5;  // without interpolation: weight from which a level shows alone

layout(local_size_x = kMultilayerTile, local_size_y = kMultilayerTile) in;
layout(std430, set = 0, binding = 0) readonly buffer Levels { FilterLevel levels[]; };
layout(std430, set = 0, binding = 1) readonly buffer Lists { uint lists[]; };
layout(std430, set = 0, binding = 2) readonly buffer Vergences { float vergences[]; };
layout(std430, set = 0, binding = 3) readonly buffer Colors { uvec2 colors[]; };
layout(std430, set = 0, binding = 4) readonly buffer Coverages { float coverages[]; };
layout(set = 0, binding = 5, rgba32f) writeonly uniform image2D picture;
layout(std430, set = 0, binding = 6) buffer Statistics { FrameStatistics statistics; };
layout(push_constant) uniform Push { MultilayerAccumulatePush push; };

// The cells of one level that a pixel looks up.
struct Lookup {
  uint level;
  uint cursor[4], end[4];
  float head[4];     // vergence at the cursor; -1 at the end
  float weight[4];   // bilinear
  Layer own[4];      // what this list has added to the surface
};

float signedRadius(float vergence) { return push.cocScale * (push.focusVergence - vergence); }
float vergenceOf(float c) { return push.focusVergence - c / push.cocScale; }

// How much a level shows of a blur radius.
float levelWeight(uint level, float c) {
  const float square = c * c;
  float weight = 1.0;
  if (square < levels[level].own) {
    const float inner = levels[level].inner;
    weight = clamp((square - inner) / (levels[level].own - inner), 0.0, 1.0);
    return kInterpolateLevels ? weight : (weight > kStepAt ? 1.0 : 0.0);
  }
  weight = clamp((square - levels[level].own) / (levels[level].outer - levels[level].own), 0.0, 1.0);
  return kInterpolateLevels ? 1.0 - weight : (weight > kStepAt ? 0.0 : 1.0);
}

void moveTo(inout Lookup at, int k, uint cursor) {
  at.cursor[k] = cursor;
  at.head[k] = cursor < at.end[k] ? vergences[cursor] : -1.0;
}

void closeLookup(inout Lookup at) {
  for (int k = 0; k < 4; ++k) {
    at.end[k] = 0u;
    at.head[k] = -1.0;
    at.weight[k] = 0.0;
    at.own[k] = kNoLayer;
  }
}

// Opens a level's lists at fragments no nearer than a vergence.
void openLookup(out Lookup at, uint level, vec2 position, float nearest) {
  closeLookup(at);
  at.level = level;
  const vec2 cell = (position - levels[level].centre) / levels[level].cellSize;
  const ivec2 base = ivec2(kBilinear ? floor(cell) : floor(cell + 0.5));
  const vec2 fraction = kBilinear && level > 0u ? cell - vec2(base) : vec2(0.0);
  const ivec2 last = levels[level].size - 1;
  for (int k = 0; k < 4; ++k) {
    const ivec2 corner = ivec2(k & 1, k >> 1);
    const vec2 weights = mix(1.0 - fraction, fraction, vec2(corner));
    at.weight[k] = weights.x * weights.y;
    if (at.weight[k] == 0.0) continue;
    const ivec2 inside = clamp(base + corner - levels[level].first, ivec2(0), last);
    const uint list = levels[level].firstList + uint(inside.y * levels[level].size.x + inside.x);
    at.end[k] = min(lists[list + 1u], push.room);
    moveTo(at, k, min(lists[list], push.room));
    while (at.head[k] > nearest) moveTo(at, k, at.cursor[k] + 1u);
  }
}

float nearestOf(Lookup at) { return max(max(at.head[0], at.head[1]), max(at.head[2], at.head[3])); }

// What has been gathered of the surface at hand.
Layer surface;
vec2 used;      // of two levels, even and odd: Σ weight · coverage …
vec2 whole;     // … and Σ coverage: used / whole is how much of the level was shown
float farthest; // vergence of its last fragment

// The picture so far.
vec3 color;
Layer before;  // of all surfaces, for additive blending
float transmittance;

Layer fragmentAt(uint i) {
  const vec2 redGreen = unpackHalf2x16(colors[i].x), blueAlpha = unpackHalf2x16(colors[i].y);
  return Layer(vec3(redGreen, blueAlpha.x), blueAlpha.y, kHasCoverage ? coverages[i] : blueAlpha.y);
}

void startSurface() {
  surface = kNoLayer;
  used = vec2(0.0);
  whole = vec2(0.0);
}

// Levels' weights sum to 1 for one depth, but the levels' means of a slanted surface are not equally far: what was shown of
// both is brought to 1, so that what is opaque stays so. Only by a little: a surface that is faint for being on the way out
// must not come back.
void finishSurface() {
  const vec2 shares = mix(used / max(whole, vec2(1e-9)), vec2(0.0), lessThanEqual(whole, vec2(0.0)));
  const float scale = 1.0 / clamp(shares.x + shares.y, 0.6, 1.6);
  surface.color *= scale;
  surface.alpha = surface.alpha * scale;
  surface.coverage = surface.coverage * scale;
  const float excess = surface.alpha > 1.0 ? 1.0 / surface.alpha : 1.0;
  surface.color *= excess;
  surface.alpha *= excess;
  surface.coverage = min(surface.coverage, 1.0);
  if (kAdditive) {
    addBehind(before, surface);
    color = before.color;
    transmittance = 1.0 - before.alpha;
  } else {
    color += transmittance * surface.color;
    transmittance *= 1.0 - surface.alpha;
  }
  startSurface();
}

// Adds a level's fragments down to a vergence.
void addDownTo(inout Lookup at, float limit) {
  const vec2 parity = (at.level & 1u) == 0u ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
  for (int k = 0; k < 4; ++k) {
    while (at.head[k] >= limit && at.head[k] >= 0.0) {
      const Layer fragment = fragmentAt(at.cursor[k]);
      const float weight = levelWeight(at.level, signedRadius(at.head[k]));
      const float seen = addBehind(at.own[k], fragment) * at.weight[k];
      surface.color += weight * seen * fragment.color;
      surface.alpha += weight * seen * fragment.alpha;
      surface.coverage += weight * seen * fragment.coverage;
      used += parity * (weight * at.weight[k] * fragment.coverage);
      whole += parity * (at.weight[k] * fragment.coverage);
      farthest = min(farthest, at.head[k]);
      moveTo(at, k, at.cursor[k] + 1u);
    }
  }
}

void forgetOwn(inout Lookup at) {
  for (int k = 0; k < 4; ++k) at.own[k] = kNoLayer;
}

float blurOf(float vergence) { return max(abs(signedRadius(vergence)), 0.5); }

// Composites the fragments of two levels down to a vergence.
void walk(inout Lookup a, inout Lookup b, float until) {
  for (;;) {
    const float nearest = max(nearestOf(a), nearestOf(b));
    if (nearest < 0.0 || nearest < until) return;
    const bool isOpen = whole.x + whole.y > 0.0;
    if (isOpen && farthest - nearest > push.linkDistance * blurOf(nearest) / push.cocScale) {
      finishSurface();
      forgetOwn(a);
      forgetOwn(b);
      if (transmittance < 1e-4) return;
    }
    if (!(whole.x + whole.y > 0.0)) farthest = nearest;
    const float limit = max(nearest - push.epsilon * blurOf(nearest) / push.cocScale, until);
    addDownTo(a, limit);
    addDownTo(b, limit);
  }
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, push.size))) return;
  const vec2 position = vec2(pixel) + 0.5;
  color = vec3(0.0);
  before = kNoLayer;
  transmittance = 1.0;
  startSurface();

  Lookup fine, coarse;
  closeLookup(fine);
  fine.level = 0u;
  const int top = int(push.levelCount) - 1;
  for (int i = int(push.nearLevels); i >= 0 && transmittance >= 1e-4; --i) {
    coarse = fine;
    const bool isTop = i == top;
    openLookup(fine, uint(i), position, isTop ? 3.4e38 : vergenceOf(-sqrt(levels[i].outer)));
    walk(coarse, fine, vergenceOf(-sqrt(levels[i].own)));
  }
  for (int i = 0; i <= int(push.farLevels) && transmittance >= 1e-4; ++i) {
    if (i < top) {
      openLookup(coarse, uint(i + 1), position, vergenceOf(sqrt(levels[i].own)));
    } else {
      closeLookup(coarse);
    }
    walk(fine, coarse, i < top ? vergenceOf(sqrt(levels[i].outer)) : 0.0);
    fine = coarse;
  }
  finishSurface();
  if (pixel == ivec2(0)) {
    const FilterLevel level = levels[top];
    const uint asked = lists[level.firstList + uint(level.size.x * level.size.y)];
    statistics.listFragments = asked;
    statistics.listFragmentsDropped = asked > push.room ? asked - push.room : 0u;
  }
  imageStore(picture, pixel, vec4(color + transmittance * vec3(push.red, push.green, push.blue), 1.0));
}
