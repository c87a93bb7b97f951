// The picture: each pixel's fragments from near to far, from the levels whose filter is as wide as their circle of confusion
// (Selgrad 2015 §6.1), composited.
//
// The walk goes through the looks' intervals of vergence: in front of the focal plane from the widest to the narrowest,
// behind it back. In each interval two looks show, weighted by the blur (interpolation between levels), each of four cells,
// bilinearly, or of eight around the pixel. Fragments that follow one another without a gap are of one surface: side by
// side, or the same surface from another look or cell. They are added up; surfaces are composited one over the other.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/multilayer_filtering.h"
#include "shaders/shared/statistics.h"
#include "coverage.glsl"

layout(constant_id = 0) const bool kHasCoverage = false;
layout(constant_id = 1) const bool kInterpolateLevels = true;
layout(constant_id = 2) const bool kBilinear = true;
layout(constant_id = 3) const bool kAdditive = false;
layout(constant_id = 4) const float kStepAt = 0.5;  // without interpolation: share from which the coarser level shows

layout(local_size_x = kMultilayerTile, local_size_y = kMultilayerTile) in;
layout(std430, set = 0, binding = 0) readonly buffer Levels { FilterLevel levels[]; };
layout(std430, set = 0, binding = 1) readonly buffer Looks { FilterLook looks[]; };
layout(std430, set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(std430, set = 0, binding = 3) readonly buffer Vergences { float vergences[]; };
layout(std430, set = 0, binding = 4) readonly buffer Colors { uvec2 colors[]; };
layout(std430, set = 0, binding = 5) readonly buffer Coverages { float coverages[]; };
layout(std430, set = 0, binding = 6) readonly buffer Shown { uint shown[]; };
layout(set = 0, binding = 7, rgba32f) writeonly uniform image2D picture;
layout(std430, set = 0, binding = 8) buffer Statistics { FrameStatistics statistics; };
layout(push_constant) uniform Push { MultilayerAccumulatePush push; };

// Four of a look's cells. Vectors, not arrays, so that they stay in registers.
struct Cells {
  uvec4 cursor, end;
  vec4 head;             // vergence at the cursor; -1 at the end
  vec4 weight;
  vec4 coverage, alpha;  // what each list has added to the surface at hand
};

struct Lookup {
  Cells a, b;
  bool hasB;  // A bilinear one has only four.
};

const Cells kClosed = Cells(uvec4(0u), uvec4(0u), vec4(-1.0), vec4(0.0), vec4(0.0), vec4(0.0));

// An interval of vergence in which two looks show.
struct Interval {
  float until;         // vergence where it ends
  float leastBlur;     // px: fragments are told apart as if their blur were no less, for cells are as far apart
  float fineSquare;    // |c|², px²: the narrower look shows alone …
  float perSquare;     // … and the wider, 1/perSquare farther
  bool keptIsCoarse;   // of the two: the look that shows already, or the one that is opened here
};

float signedRadius(float vergence) { return push.cocScale * (push.focusVergence - vergence); }
float vergenceOf(float c) { return push.focusVergence - c / push.cocScale; }
float nearestOf(Cells at) { return max(max(at.head.x, at.head.y), max(at.head.z, at.head.w)); }
float nearestOf(Lookup at) { return at.hasB ? max(nearestOf(at.a), nearestOf(at.b)) : nearestOf(at.a); }

// Opens one list at its first fragment no nearer than a vergence.
void openList(FilterLevel level, ivec2 cell, float nearest, out uint cursor, out uint end, out float head) {
  const ivec2 inside = clamp(cell - level.first, ivec2(0), level.size - 1);
  const uint list = level.firstList + uint(inside.y * level.size.x + inside.x);
  cursor = min(lists[list], push.room);
  end = min(lists[list + 1u], push.room);
  head = -1.0;
  for (; cursor < end; ++cursor) {
    head = vergences[cursor];
    if (head < nearest) return;
    head = -1.0;
  }
}

// Eight cells around a place, an eighth each.
void openRing(FilterLevel level, vec2 place, float ring, float nearest, inout Lookup at) {
  const vec2 centre = place + 0.5;  // rounds to the nearest cell
  const float diagonal = 0.70710678 * ring;
  at.hasB = true;
  at.a.weight = at.b.weight = vec4(0.125);
  openList(level, ivec2(floor(centre + vec2(ring, 0.0))), nearest, at.a.cursor.x, at.a.end.x, at.a.head.x);
  openList(level, ivec2(floor(centre - vec2(ring, 0.0))), nearest, at.a.cursor.y, at.a.end.y, at.a.head.y);
  openList(level, ivec2(floor(centre + vec2(0.0, ring))), nearest, at.a.cursor.z, at.a.end.z, at.a.head.z);
  openList(level, ivec2(floor(centre - vec2(0.0, ring))), nearest, at.a.cursor.w, at.a.end.w, at.a.head.w);
  openList(level, ivec2(floor(centre + vec2(diagonal, diagonal))), nearest, at.b.cursor.x, at.b.end.x, at.b.head.x);
  openList(level, ivec2(floor(centre - vec2(diagonal, diagonal))), nearest, at.b.cursor.y, at.b.end.y, at.b.head.y);
  openList(level, ivec2(floor(centre + vec2(diagonal, -diagonal))), nearest, at.b.cursor.z, at.b.end.z, at.b.head.z);
  openList(level, ivec2(floor(centre - vec2(diagonal, -diagonal))), nearest, at.b.cursor.w, at.b.end.w, at.b.head.w);
}

Lookup opened(uint number, vec2 position, float nearest) {
  const FilterLook look = looks[number];
  const FilterLevel level = levels[look.level];
  const vec2 place = (position - level.centre) / level.cellSize;
  Lookup at = Lookup(kClosed, kClosed, false);
  if (look.ring > 0.0) {
    openRing(level, place, look.ring, nearest, at);
    return at;
  }
  if (!kBilinear || number == 0u) {
    openList(level, ivec2(floor(place + 0.5)), nearest, at.a.cursor.x, at.a.end.x, at.a.head.x);
    at.a.weight = vec4(1.0, 0.0, 0.0, 0.0);
    return at;
  }
  const ivec2 cell = ivec2(floor(place));
  const vec2 f = place - vec2(cell);
  at.a.weight = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
  openList(level, cell, nearest, at.a.cursor.x, at.a.end.x, at.a.head.x);
  openList(level, cell + ivec2(1, 0), nearest, at.a.cursor.y, at.a.end.y, at.a.head.y);
  openList(level, cell + ivec2(0, 1), nearest, at.a.cursor.z, at.a.end.z, at.a.head.z);
  openList(level, cell + ivec2(1, 1), nearest, at.a.cursor.w, at.a.end.w, at.a.head.w);
  return at;
}

// What has been gathered of the surface at hand, and the vergence of its last fragment.
Layer surface;
float farthest;

// The picture so far.
vec3 color;
Layer before;  // of all surfaces; additive blending only
float transmittance;

void finishSurface() {
  const float excess = 1.0 / max(surface.alpha, 1.0);
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
  surface = kNoLayer;
}

// Fragments of one level, of one surface.
struct Part {
  Layer sum;
  float radius;  // Σ coverage · c, px
};
const Part kNoPart = Part(kNoLayer, 0.0);

// Adds one list's fragments down to a vergence.
void addFrom(inout uint cursor, uint end, inout float head, float cell, inout float coverage, inout float alpha,
             float limit, inout Part part) {
  while (head >= limit && head >= 0.0) {
    const vec2 redGreen = unpackHalf2x16(colors[cursor].x), blueAlpha = unpackHalf2x16(colors[cursor].y);
    const Layer fragment =
        Layer(vec3(redGreen, blueAlpha.x), blueAlpha.y, kHasCoverage ? coverages[cursor] : blueAlpha.y);
    Layer own = Layer(vec3(0.0), kHasCoverage ? alpha : coverage, coverage);
    const float seen = cell * addBehind(own, fragment);
    coverage = own.coverage;
    alpha = own.alpha;
    part.sum.color += seen * fragment.color;
    part.sum.alpha += seen * fragment.alpha;
    part.sum.coverage += seen * fragment.coverage;
    part.radius += seen * fragment.coverage * signedRadius(head);
    farthest = min(farthest, head);
    ++cursor;
    head = cursor < end ? vergences[cursor] : -1.0;
  }
}

void addCells(inout Cells at, float limit, inout Part part) {
  addFrom(at.cursor.x, at.end.x, at.head.x, at.weight.x, at.coverage.x, at.alpha.x, limit, part);
  addFrom(at.cursor.y, at.end.y, at.head.y, at.weight.y, at.coverage.y, at.alpha.y, limit, part);
  addFrom(at.cursor.z, at.end.z, at.head.z, at.weight.z, at.coverage.z, at.alpha.z, limit, part);
  addFrom(at.cursor.w, at.end.w, at.head.w, at.weight.w, at.coverage.w, at.alpha.w, limit, part);
}

void addLook(inout Lookup at, float limit, inout Part part) {
  addCells(at.a, limit, part);
  if (at.hasB) addCells(at.b, limit, part);
}

// Begins another surface.
void forget(inout Lookup at) {
  at.a.coverage = at.a.alpha = at.b.coverage = at.b.alpha = vec4(0.0);
}

// Adds to the surface what two looks show of a part of it. One share for all of it, by its mean blur: fragments of a
// slanted surface are not equally far in both levels, and shares by each one's own blur would not sum to 1.
void show(Part kept, Part fresh, Interval interval) {
  const float covered = kept.sum.coverage + fresh.sum.coverage;
  if (!(covered > 0.0)) return;
  const float c = (kept.radius + fresh.radius) / covered;
  float coarse = clamp((min(c * c, push.mostSquare) - interval.fineSquare) * interval.perSquare, 0.0, 1.0);
  if (!kInterpolateLevels) coarse = coarse > kStepAt ? 1.0 : 0.0;
  const float share = interval.keptIsCoarse ? coarse : 1.0 - coarse;
  addBehind(surface, Layer(mix(fresh.sum.color, kept.sum.color, share), mix(fresh.sum.alpha, kept.sum.alpha, share),
                           mix(fresh.sum.coverage, kept.sum.coverage, share)));
}

// Composites what two levels show in an interval. What of a surface reaches a little beyond is shown too: the next interval
// begins where this one ends.
void walk(inout Lookup kept, inout Lookup fresh, Interval interval) {
  Part ofKept = kNoPart, ofFresh = kNoPart;
  for (;;) {
    const float nearest = max(nearestOf(kept), nearestOf(fresh));
    if (nearest < 0.0) break;
    const float blur = max(abs(signedRadius(nearest)), interval.leastBlur) / push.cocScale;
    const bool isOpen = ofKept.sum.coverage + ofFresh.sum.coverage > 0.0;
    const bool isLinked = farthest - nearest <= push.linkDistance * blur;
    if (nearest < interval.until && !(isOpen && isLinked && nearest >= interval.until - kOvershoot * blur)) break;
    if (!isLinked && (isOpen || surface.coverage > 0.0)) {
      show(ofKept, ofFresh, interval);
      ofKept = ofFresh = kNoPart;
      finishSurface();
      forget(kept);
      forget(fresh);
      if (transmittance < kOpaque) return;
    }
    const float limit = nearest - push.epsilon * blur;
    farthest = nearest;
    addLook(kept, limit, ofKept);
    addLook(fresh, limit, ofFresh);
  }
  show(ofKept, ofFresh, interval);
  forget(kept);
  forget(fresh);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, push.size))) return;
  const uint shownLooks = shown[gl_WorkGroupID.y * push.tileColumns + gl_WorkGroupID.x];
  const vec2 position = vec2(pixel) + 0.5;
  color = vec3(0.0);
  before = kNoLayer;
  transmittance = 1.0;
  surface = kNoLayer;
  farthest = 3.4e38;

  // Looks are opened one after another: in front of the focal plane down to the narrowest, behind it up from the next.
  Lookup kept = Lookup(kClosed, kClosed, false);
  const uint nearCount = push.nearLooks + 1u, count = nearCount + push.farLooks;
  for (uint i = 0u; i < count && transmittance >= kOpaque; ++i) {
    const bool isFar = i >= nearCount;
    const uint number = isFar ? 1u + i - nearCount : push.nearLooks - i;
    const uint fine = isFar ? number - 1u : number;
    const float border = sqrt(looks[number].own);
    Interval interval;
    interval.until = i + 1u == count ? 0.0 : vergenceOf(isFar ? border : -border);
    interval.leastBlur = max(looks[min(fine + 1u, max(push.nearLooks, push.farLooks))].halfWidth, 2.0);
    interval.fineSquare = looks[fine].own;
    // The first look is alone, also for what it is followed with beyond its interval.
    interval.perSquare = i > 0u ? 1.0 / (looks[fine].outer - interval.fineSquare) : 0.0;
    interval.keptIsCoarse = !isFar;
    // A look is opened where it begins to show, or a little before, as far as nothing has been shown there yet.
    const float begin =
        isFar ? (1.0 - kOvershoot) * sqrt(interval.fineSquare) : -(1.0 + kOvershoot) * sqrt(looks[number].outer);
    Lookup fresh = Lookup(kClosed, kClosed, false);
    if ((shownLooks & (1u << number)) != 0u) fresh = opened(number, position, min(vergenceOf(begin), farthest));
    walk(kept, fresh, interval);
    kept = fresh;
  }
  finishSurface();
  if (pixel == ivec2(0)) {
    const uint asked = lists[push.lastList];
    statistics.listFragments = asked;
    statistics.listFragmentsDropped = asked > push.room ? asked - push.room : 0u;
  }
  imageStore(picture, pixel, vec4(color + transmittance * vec3(push.red, push.green, push.blue), 1.0));
}
