// The picture: each pixel's fragments from near to far, from the levels whose filter is as wide as their circle of confusion
// (Selgrad 2015 §6.1), composited.
//
// The walk goes through the looks' intervals of vergence: in front of the focal plane from the widest to the narrowest,
// behind it back. In each interval two looks show, weighted by the blur (interpolation between levels), each of four cells,
// bilinearly, or of eight around the pixel. Fragments that follow one another without a gap are of one surface: side by
// side, or the same surface from another look or cell. They are added up; surfaces are composited one over the other.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/statistics.h"
#include "coverage.glsl"
#include "look.glsl"

layout(constant_id = 1) const bool kInterpolateLevels = true;
layout(constant_id = 3) const bool kAdditive = false;
layout(constant_id = 4) const float kStepAt = 0.5;  // without interpolation: share from which the coarser level shows

layout(local_size_x = kMultilayerTile, local_size_y = kMultilayerTile) in;
layout(std430, set = 0, binding = 4) readonly buffer Colors { uvec2 colors[]; };
layout(std430, set = 0, binding = 5) readonly buffer Coverages { float coverages[]; };
layout(std430, set = 0, binding = 6) readonly buffer Shown { uint shown[]; };
layout(set = 0, binding = 7, rgba32f) writeonly uniform image2D picture;
layout(std430, set = 0, binding = 8) buffer Statistics { FrameStatistics statistics; };

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

void add(inout Part part, float seen, Layer fragment, float radius) {
  part.sum.color += seen * fragment.color;
  part.sum.alpha += seen * fragment.alpha;
  part.sum.coverage += seen * fragment.coverage;
  part.radius += seen * fragment.coverage * radius;
}

// Adds the fragment at the head of one cell to its look's part of the surface, and moves the cell on. The cell is chosen
// first and then used, once: a loop for each cell would cost devices that run loops in lockstep as much for every cell that
// has nothing to add.
void addFragment(inout Lookup kept, inout Lookup fresh, uint cell, float nearest, inout Part ofKept, inout Part ofFresh) {
  const bool isKept = (cell & kFreshA) == 0u;
  Cells group = kept.a;
  if (!isKept) group = fresh.a;
  if (kRound && cell >= kKeptB) {
    group = kept.b;
    if (!isKept) group = fresh.b;
  }
  const uint k = cell & 3u;
  const uint cursor = among(group.cursor, k);
  const vec2 redGreen = unpackHalf2x16(colors[cursor].x), blueAlpha = unpackHalf2x16(colors[cursor].y);
  const Layer fragment =
      Layer(vec3(redGreen, blueAlpha.x), blueAlpha.y, kHasCoverage ? coverages[cursor] : blueAlpha.y);
  const float coverage = among(group.coverage, k);
  Layer own = Layer(vec3(0.0), kHasCoverage ? among(group.alpha, k) : coverage, coverage);
  const float seen = among(group.weight, k) * addBehind(own, fragment);
  const float radius = signedRadius(nearest);
  const float toKept = isKept ? seen : 0.0, toFresh = seen - toKept;
  add(ofKept, toKept, fragment, radius);
  add(ofFresh, toFresh, fragment, radius);

  const float head = cursor + 1u < among(group.end, k) ? vergences[cursor + 1u] : -1.0;
  moveOn(kept.a, kKeptA, cell, head, own.coverage, own.alpha);
  moveOn(fresh.a, kFreshA, cell, head, own.coverage, own.alpha);
  if (kRound) {
    moveOn(kept.b, kKeptB, cell, head, own.coverage, own.alpha);
    moveOn(fresh.b, kFreshB, cell, head, own.coverage, own.alpha);
  }
}

// Adds to the surface what two looks show of a part of it. One share for all of it, by its mean blur: fragments of a
// slanted surface are not equally far in both looks, and shares by each one's own blur would not sum to 1.
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

// Composites what two looks show in an interval, fragment by fragment. What of a surface reaches a little beyond is shown
// too: the next interval begins where this one ends.
void walk(inout Lookup kept, inout Lookup fresh, Interval interval) {
  Part ofKept = kNoPart, ofFresh = kNoPart;
  for (;;) {
    float nearest = -1.0;
    uint cell = 0u;
    findNearest(kept.a.head, kKeptA, nearest, cell);
    findNearest(fresh.a.head, kFreshA, nearest, cell);
    if (kRound) {
      findNearest(kept.b.head, kKeptB, nearest, cell);
      findNearest(fresh.b.head, kFreshB, nearest, cell);
    }
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
    farthest = nearest;
    addFragment(kept, fresh, cell, nearest, ofKept, ofFresh);
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
  Lookup kept = kClosed;
  const uint nearCount = push.nearLooks + 1u, count = nearCount + push.farLooks;
  for (uint i = 0u; i < count && transmittance >= kOpaque; ++i) {
    const bool isFar = i >= nearCount;
    const uint number = isFar ? 1u + i - nearCount : push.nearLooks - i;
    const uint fine = isFar ? number - 1u : number;
    const float border = sqrt(looks[number].own);
    Interval interval;
    interval.until = i + 1u == count ? 0.0 : vergenceOf(isFar ? border : -border);
    const FilterLook wider = looks[min(fine + 1u, max(push.nearLooks, push.farLooks))];
    interval.leastBlur = max(wider.halfWidth, max(1.5 * levels[wider.level].cellSize, 2.0));
    interval.fineSquare = looks[fine].own;
    // The first look is alone, also for what it is followed with beyond its interval.
    interval.perSquare = i > 0u ? 1.0 / (looks[fine].outer - interval.fineSquare) : 0.0;
    interval.keptIsCoarse = !isFar;
    // A look is opened where it begins to show, or a little before, as far as nothing has been shown there yet.
    const float begin =
        isFar ? (1.0 - kOvershoot) * sqrt(interval.fineSquare) : -(1.0 + kOvershoot) * sqrt(looks[number].outer);
    Lookup fresh = kClosed;
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
