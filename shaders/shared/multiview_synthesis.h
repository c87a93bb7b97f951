// What the multiview synthesis's shaders and their host code agree on.
// Source: Lee, Eisemann, Seidel 2009; see passes/multiview_synthesis/README.md.
#ifndef LENSGRAPH_SHARED_MULTIVIEW_SYNTHESIS_H
#define LENSGRAPH_SHARED_MULTIVIEW_SYNTHESIS_H

#include "shaders/shared/aperture.h"
#include "shaders/shared/interop.h"

SHARED_NAMESPACE_BEGIN

SHARED_CONST uint kMultiviewTile = 8u;  // px; work group side
// px; side of the cells for which it is known which layers hold anything. Smaller ones cull better and cost more.
SHARED_CONST uint kMultiviewCell = 4u;

// A ray's lens point and what it counts for.
struct LensRay {
  vec2 lens;     // v, units of the lens radius; x right, y down
  float weight;  // ring weight; the cat's eye comes on top, by pixel
  float padding;
};

// `table` is everywhere the number of the view's SceneLayerTable.

struct RedistributePush {
  ivec2 size;  // px, of the layers
  uint table;
  uint sliceCount;
  uint layerCount;
  float vergenceScale;   // V = scale · z + offset
  float vergenceOffset;  // 1/m
};

struct MipPush {
  ivec2 size;       // px, of the level to write
  uint level;       // ≥ 1
  uint table;
  uint layerCount;
  float cocScale;       // K, px·m
  float focusVergence;  // 1/m
  float coneDiameter;   // λ, per px of |c|
};

struct DilatePush {
  ivec2 cells;   // of the grid
  uint level;    // to write, ≥ 1
};

struct VisitPush {
  ivec2 cells;
  uint table;
  uint layerCount;
  uint highestLevel;
  float cocScale;
  float focusVergence;
  float rayReach;  // largest |v| of the rays, cone included
  uint hasTransparency;
};

// What the rays of one dispatch do with the picture so far.
SHARED_CONST uint kTraceFirst = 1u;  // starts it
SHARED_CONST uint kTraceLast = 2u;   // divides by the weights

SHARED_CONST uint kJitterNone = 0u;
SHARED_CONST uint kJitterNoise = 1u;
SHARED_CONST uint kJitterHalton = 2u;

SHARED_CONST uint kSearchFalsePosition = 0u;
SHARED_CONST uint kSearchFalsePositionInDepth = 1u;
SHARED_CONST uint kSearchScan = 2u;

struct TracePush {
  ApertureShape aperture;
  ivec2 size;    // px, of the layers
  ivec2 border;  // px, of the layers around the picture
  uvec2 extent;  // px, of the picture
  vec2 viewPoint;  // lens point that the layers are seen from
  vec3 background;
  uint table, layerCount;
  uint rayBase;   // where the view's rays begin
  uint rayTotal;  // how many it has
  uint firstRay, rayCount;  // that a pixel traces now
  uint flags;
  float cocScale, focusVergence;
  float vergenceScale;  // V = scale · z
  float coneDiameter;   // λ, per px of |c|
  float noiseReach;     // lens radii that kJitterNoise moves lens points by, at most
  float pixelsPerTangent;  // S, px
};

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_MULTIVIEW_SYNTHESIS_H
