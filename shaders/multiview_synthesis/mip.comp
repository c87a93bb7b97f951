// One mip level of the layers' premultiplied colour and coverage, for the cones (Lee, Eisemann, Seidel 2009, §4.4).
// Layers so near to focus that no cone there is as wide are left out.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/emit.h"
#include "shaders/shared/multiview_synthesis.h"

#include "../scene/half_float.glsl"

layout(local_size_x = kMultiviewTile, local_size_y = kMultiviewTile) in;
layout(set = 0, binding = 0, rgba16f) uniform readonly image2DArray finer;
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2DArray coarser;
layout(std430, set = 0, binding = 2) readonly buffer Tables { SceneLayerTable tables[]; };
layout(push_constant) uniform Push { MipPush push; };

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const int slice = int(gl_GlobalInvocationID.z);
  if (any(greaterThanEqual(pixel, push.size))) return;
  const SceneLayer layer = tables[push.table].layers[slice % int(push.layerCount)];
  const float widest = push.cocScale * max(abs(push.focusVergence - layer.nearest), abs(push.focusVergence - layer.farthest));
  // Level L is read where the cone is wider than 2^(L-1) px.
  if (push.coneDiameter * widest < exp2(float(push.level) - 1.0) * 0.999) return;
  const ivec2 at = pixel * 2;
  const vec4 sum = imageLoad(finer, ivec3(at, slice)) + imageLoad(finer, ivec3(at + ivec2(1, 0), slice)) +
                   imageLoad(finer, ivec3(at + ivec2(0, 1), slice)) + imageLoad(finer, ivec3(at + ivec2(1, 1), slice));
  imageStore(coarser, ivec3(pixel, slice), roundedToHalf(0.25 * sum));
}
