// What the multi-layer filtering's shaders and their host code agree on.
// Source: Selgrad, Reintges, Penk, Wagner, Stamminger 2015; see passes/multilayer_filtering/README.md.
#ifndef LENSGRAPH_SHARED_MULTILAYER_FILTERING_H
#define LENSGRAPH_SHARED_MULTILAYER_FILTERING_H

#include "shaders/shared/interop.h"
#include "shaders/shared/lens.h"

SHARED_NAMESPACE_BEGIN

SHARED_CONST uint kMultilayerTile = 8u;      // cells; work group side
SHARED_CONST uint kMaxFilterLevels = 14u;    // 0 … 13: filters up to 8192 px wide
// Visits of nodes and shifts that sorting one list may take: devices may end loops after 65 535 iterations, silently. Enough
// for lists of 1700 fragments in the worst order, of which 16 are kept.
SHARED_CONST uint kSortBudget = 60000u;

SHARED_CONST uint kMaxLooks = 32u;           // a bit each in the tiles' masks
SHARED_CONST float kOvershoot = 0.5f;        // of |c|: how far a surface is followed into the next levels' interval
SHARED_CONST float kOpaque = 1e-4f;          // transmittance below which nothing more is seen

// One level of the hierarchy: a window of cells, each with a list of fragments filtered by a box. Cell (0, 0)'s centre lies
// at half the box's width from the picture's upper left corner, in both axes, at every level.
struct FilterLevel {
  ivec2 first;      // index of the window's upper left cell; negative beyond the picture
  ivec2 size;       // cells
  float cellSize;   // px from cell to cell
  float centre;     // px, of cell 0; half the filter's width
  uint firstList;   // index of the first cell's list among all lists
  int tapDistance;  // cells of the level before, from tap to tap; 0: mip step, taps at twice the index
  // px: while the level is made, fragments are dropped whose |c| is below `dropWithin` or whose c is not between these.
  float dropWithin, lowest, highest;
  uint padding;
};

// A way to look a level up, which makes one blur of it. Looks are ordered by blur.
struct FilterLook {
  uint level;
  // Cells from the pixel to each of eight taps around it, which make of the level's box a blur that is nearly round;
  // 0: the four cells around the pixel, bilinearly.
  float ring;
  // Squares of |c|, px²: below `inner` and above `outer` the look does not show, at `own` it shows alone.
  float inner, own, outer;
  float halfWidth;  // px, of the blur
};

struct CompactPush {
  ivec2 size;          // px, of the lists
  uint room;           // fragments that the pool holds
  uint reservedNodes;
  LensConstants lens;
};

struct FilterPush {
  uint level;           // to be made, ≥ 1, from the one before
  uint room;            // fragments that the pool holds
  float cocScale;       // K, px·m
  float focusVergence;  // 1/m
  float epsilon;        // fragments are merged over this share of the blur that they are for
};

struct ShownPush {
  ivec2 tiles;
  uint lookCount;
  uint room;
  float cocScale;       // K, px·m
  float focusVergence;  // 1/m
  float mostSquare;     // px²: larger |c|² are limited to it
};

struct MultilayerAccumulatePush {
  ivec2 size;           // px, of the picture
  uint tileColumns;
  uint lastList;        // the end of all lists
  uint room;
  float cocScale;       // K, px·m
  float focusVergence;  // 1/m
  float linkDistance;   // fragments with no wider gap, as a share of their blur, are of one surface
  float red, green, blue;  // background
  uint nearLooks, farLooks;    // widest looks that show in front of and behind the focal plane
  float mostSquare;            // px²: larger |c|² are limited to it
};

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_MULTILAYER_FILTERING_H
