// One view of the scene from one point of the lens: the pinhole projection times the shear of a lens sample.
//
//   p'(px) = p + K (V_f - V) v + j      v: lens sample in the unit disc (x right, y down), j: sub-pixel offset, px
// In clip space with w = viewDepth = 1/V this is linear in the view-space position, so it is one matrix:
//   x_clip = (2/w_px) (S x_view + (K (V_f d - 1)) v_x + j_x d),  y likewise, y down.
#ifndef LENSGRAPH_SHARED_VIEW_H
#define LENSGRAPH_SHARED_VIEW_H

#include "shaders/shared/interop.h"

SHARED_NAMESPACE_BEGIN

// What a draw of the scene needs to know of its view. Made by viewFromLensSample() in C++, read by vertex shaders.
struct ViewConstants {
  mat4 clipFromView;   // infinite reversed depth: z_buffer = near · V; y down
  vec4 lensPoint;      // xyz: eye position on the lens in view space, m (for view-dependent shading);
                       // w: number of the SceneLayerTable (shaders/shared/emit.h) that a layered draw uses
};

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_VIEW_H
