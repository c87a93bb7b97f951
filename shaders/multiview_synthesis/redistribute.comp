// Turns the layers' depth buffers into height fields, all layers of a pixel in one invocation (Lee, Eisemann, Seidel
// 2009, §4.2, second pass): each fragment to the layers whose depths contain it, nearest kept, and out of the others.
// Where triangles were split at the layers' borders nothing needs to move. On the way: fragments that are not finite
// become black and are counted, and each cell learns which slices hold anything.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/emit.h"
#include "shaders/shared/multiview_synthesis.h"
#include "shaders/shared/statistics.h"

#include "slice_mask.glsl"

layout(constant_id = 0) const bool moves = false;

layout(local_size_x = kMultiviewTile, local_size_y = kMultiviewTile) in;
layout(set = 0, binding = 0) uniform sampler2DArray depth;
layout(std430, set = 0, binding = 1) readonly buffer Tables { SceneLayerTable tables[]; };
layout(set = 0, binding = 2, rgba16f) uniform image2DArray color;
layout(set = 0, binding = 3, r32f) uniform writeonly image2DArray height;
layout(std430, set = 0, binding = 4) writeonly buffer Occupied { uvec2 occupied[]; };
layout(std430, set = 0, binding = 5) buffer Statistics { FrameStatistics statistics; };
layout(push_constant) uniform Push { RedistributePush push; };

const uint kCellsPerSide = kMultiviewTile / kMultiviewCell;
shared uvec2 cellMasks[kCellsPerSide * kCellsPerSide];

float depthAt(ivec2 pixel, uint slice) { return texelFetch(depth, ivec3(pixel, slice), 0).r; }

bool contains(SceneLayer layer, float z) {
  const float vergence = push.vergenceScale * z + push.vergenceOffset;
  return vergence <= layer.nearest && vergence >= layer.farthest;
}

vec4 finiteColor(ivec2 pixel, uint slice) {
  const vec4 value = imageLoad(color, ivec3(pixel, slice));
  if (!any(isnan(value)) && !any(isinf(value))) return value;
  atomicAdd(statistics.replacedTexels, 1u);
  const vec4 black = vec4(0.0, 0.0, 0.0, 1.0);
  imageStore(color, ivec3(pixel, slice), black);
  return black;
}

uvec2 keepInPlace(ivec2 pixel) {
  uvec2 mask = uvec2(0u);
  for (uint slice = 0u; slice < push.sliceCount; ++slice) {
    const float z = depthAt(pixel, slice);
    imageStore(height, ivec3(pixel, slice), vec4(z));
    if (z > 0.0) {
      finiteColor(pixel, slice);
      mask |= bitOf(slice);
    }
  }
  return mask;
}

// Fragments come from farther layers, or, by the overlap, from the one before: reading in order and remembering the one
// before lets colours move in place.
uvec2 moveBetween(ivec2 pixel, uint firstSlice) {
  float found[kMaxSceneLayers];
  for (uint l = 0u; l < push.layerCount; ++l) found[l] = depthAt(pixel, firstSlice + l);
  uvec2 mask = uvec2(0u);
  vec4 before = vec4(0.0);
  for (uint l = 0u; l < push.layerCount; ++l) {
    float nearest = 0.0;
    uint source = l;
    for (uint i = l > 0u ? l - 1u : 0u; i < push.layerCount; ++i) {
      if (found[i] > nearest && contains(tables[push.table].layers[l], found[i])) {
        nearest = found[i];
        source = i;
      }
    }
    const uint slice = firstSlice + l;
    const vec4 own = found[l] > 0.0 ? finiteColor(pixel, slice) : vec4(0.0);
    imageStore(height, ivec3(pixel, slice), vec4(nearest));
    if (nearest > 0.0) mask |= bitOf(slice);
    if (nearest == 0.0 && found[l] > 0.0) {
      imageStore(color, ivec3(pixel, slice), vec4(0.0));
    } else if (source != l) {
      imageStore(color, ivec3(pixel, slice), source < l ? before : finiteColor(pixel, firstSlice + source));
    }
    before = own;
  }
  return mask;
}

void main() {
  const uvec2 local = gl_LocalInvocationID.xy;
  const uint cell = local.y / kMultiviewCell * kCellsPerSide + local.x / kMultiviewCell;
  if (gl_LocalInvocationIndex < kCellsPerSide * kCellsPerSide) cellMasks[gl_LocalInvocationIndex] = uvec2(0u);
  barrier();
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const bool isInside = all(lessThan(pixel, push.size));
  if (isInside) {
    uvec2 mask;
    if (moves) {
      mask = moveBetween(pixel, 0u);
      if (push.sliceCount > push.layerCount) mask |= moveBetween(pixel, push.layerCount);
    } else {
      mask = keepInPlace(pixel);
    }
    if (mask.x != 0u) atomicOr(cellMasks[cell].x, mask.x);
    if (mask.y != 0u) atomicOr(cellMasks[cell].y, mask.y);
  }
  barrier();
  // Sizes are multiples of the cell, so a cell is wholly inside or outside.
  if (isInside && all(equal(local % kMultiviewCell, uvec2(0u)))) {
    const ivec2 at = pixel / int(kMultiviewCell);
    occupied[at.y * (push.size.x / int(kMultiviewCell)) + at.x] = cellMasks[cell];
  }
}
