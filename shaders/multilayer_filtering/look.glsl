// What accumulation reads of one level at one pixel: the lists of four cells, bilinearly, or of eight around the pixel, whose
// boxes together are nearly round. Bindings 0 to 3 and the push constants are its own.
#include "shaders/shared/multilayer_filtering.h"

layout(constant_id = 0) const bool kHasCoverage = false;
layout(constant_id = 2) const bool kBilinear = true;
layout(constant_id = 5) const bool kRound = true;      // some looks are rings

layout(std430, set = 0, binding = 0) readonly buffer Levels { FilterLevel levels[]; };
layout(std430, set = 0, binding = 1) readonly buffer Looks { FilterLook looks[]; };
layout(std430, set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(std430, set = 0, binding = 3) readonly buffer Vergences { float vergences[]; };
layout(push_constant) uniform Push { MultilayerAccumulatePush push; };

// Four of a look's cells. Vectors, not arrays, so that they stay in registers.
struct Cells {
  uvec4 cursor, end;
  vec4 head;             // vergence at the cursor; -1 at the end
  vec4 weight;
  vec4 coverage, alpha;  // what each list has added to the surface at hand
};

// A look's cells; b are those on the diagonals of a ring, and closed for a bilinear one.
struct Lookup {
  Cells a, b;
};

const Cells kClosedCells = Cells(uvec4(0u), uvec4(0u), vec4(-1.0), vec4(0.0), vec4(0.0), vec4(0.0));
const Lookup kClosed = Lookup(kClosedCells, kClosedCells);

// Opens one list at its first fragment farther than a vergence.
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

// Eight cells around a place, an eighth each. Of opposite ones one is rounded up and one down where a place lies between two
// cells, that the ring stays centred.
void openRing(FilterLevel level, vec2 place, float ring, float nearest, inout Lookup at) {
  const vec2 up = place + 0.5, down = place - 0.5;
  const float diagonal = 0.70710678 * ring;
  const vec2 x = vec2(ring, 0.0), y = vec2(0.0, ring), d = vec2(diagonal), e = vec2(diagonal, -diagonal);
  at.a.weight = at.b.weight = vec4(0.125);
  openList(level, ivec2(floor(up + x)), nearest, at.a.cursor.x, at.a.end.x, at.a.head.x);
  openList(level, ivec2(ceil(down - x)), nearest, at.a.cursor.y, at.a.end.y, at.a.head.y);
  openList(level, ivec2(floor(up + y)), nearest, at.a.cursor.z, at.a.end.z, at.a.head.z);
  openList(level, ivec2(ceil(down - y)), nearest, at.a.cursor.w, at.a.end.w, at.a.head.w);
  openList(level, ivec2(floor(up + d)), nearest, at.b.cursor.x, at.b.end.x, at.b.head.x);
  openList(level, ivec2(ceil(down - d)), nearest, at.b.cursor.y, at.b.end.y, at.b.head.y);
  openList(level, ivec2(floor(up + e)), nearest, at.b.cursor.z, at.b.end.z, at.b.head.z);
  openList(level, ivec2(ceil(down - e)), nearest, at.b.cursor.w, at.b.end.w, at.b.head.w);
}

Lookup opened(uint number, vec2 position, float nearest) {
  const FilterLook look = looks[number];
  const FilterLevel level = levels[look.level];
  const vec2 place = (position - level.centre) / level.cellSize;
  Lookup at = kClosed;
  if (kRound && look.ring > 0.0) {
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

// The nearest head of four cells, if it is nearer than the nearest so far, and the number of its cell.
void findNearest(vec4 head, uint first, inout float nearest, inout uint cell) {
  for (uint k = 0u; k < 4u; ++k) {
    cell = head[k] > nearest ? first + k : cell;
    nearest = max(nearest, head[k]);
  }
}

// Numbers of cells: those of the look that shows already, of the one that was opened last, of a ring's diagonals.
const uint kKeptA = 0u, kFreshA = 4u, kKeptB = 8u, kFreshB = 12u;

uint among(uvec4 values, uint k) { return k < 2u ? (k == 0u ? values.x : values.y) : (k == 2u ? values.z : values.w); }
float among(vec4 values, uint k) { return k < 2u ? (k == 0u ? values.x : values.y) : (k == 2u ? values.z : values.w); }

// Moves a cell of a group on, if it is one of this group.
void moveOn(inout Cells at, uint first, uint cell, float head, float coverage, float alpha) {
  const bvec4 isIt = equal(uvec4(first) + uvec4(0u, 1u, 2u, 3u), uvec4(cell));
  at.cursor += uvec4(isIt);
  at.head = mix(at.head, vec4(head), isIt);
  at.coverage = mix(at.coverage, vec4(coverage), isIt);
  if (kHasCoverage) at.alpha = mix(at.alpha, vec4(alpha), isIt);
}

// Begins another surface.
void forget(inout Lookup at) {
  at.a.coverage = at.a.alpha = at.b.coverage = at.b.alpha = vec4(0.0);
}
