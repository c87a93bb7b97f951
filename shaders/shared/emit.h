// What each fragment of a scene draw writes, and where: the contract between a host's materials and the techniques.
// A host engine with shaders of its own implements these emits; ours are in shaders/scene.
#ifndef LENSGRAPH_SHARED_EMIT_H
#define LENSGRAPH_SHARED_EMIT_H

#include "shaders/shared/interop.h"

SHARED_NAMESPACE_BEGIN

#ifdef __cplusplus
/// Which surfaces a draw covers and what their fragments do. Whether a surface has a back face is the host's business, as its
/// material is.
enum class SceneEmit : uint32_t {
  /// Opaque and alpha-masked surfaces. Colour attachment 0: linear radiance, alpha 1. Depth attachment: tested
  /// (greater) and written.
  opaqueRadiance = 0,
  /// Alpha-blended surfaces only. No colour attachment; depth attachment tested, not written. Each fragment with
  /// alpha above 0 appends a TransparentNode to the list of its pixel. Bindings of descriptor set 2:
  ///   0  r32ui storage image, full resolution: index of the list's first node + 1; 0 is an empty list
  ///   1  storage buffer of TransparentNode
  ///   2  storage buffer of one uint, the allocator: nodes asked for so far. Nodes beyond the pool are dropped
  transparentList = 1,
  /// Opaque and alpha-masked surfaces into layers of view depth (Lee, Eisemann, Seidel 2009, §4.2). The rendering is
  /// layered; a geometry stage routes triangles (shaders/scene/layers.geom). Colour attachment 0: linear radiance within
  /// half floats' range, alpha 1. Depth attachment: tested (greater) and written, layer by layer. Bindings of set 2:
  ///   0  storage buffer, an array of SceneLayerTable
  opaqueLayers = 2,
  /// The same for alpha-blended surfaces, of which each layer keeps the nearest: premultiplied radiance, alpha; fragments
  /// with alpha 0 are discarded.
  transparentLayers = 3,
  /// opaqueLayers for shading anew where a lens ray hits. Colour attachment 0: radiance without gloss, alpha 1;
  /// 1: specular colour at normal incidence, perceptual roughness; 2: normal in view space (0: no gloss), occlusion.
  opaqueSurfaceLayers = 4,
  /// All surfaces, opaque, alpha-masked and alpha-blended, into per-pixel lists, hidden ones too (Yang et al. 2010). No
  /// attachments, no depth test. Each fragment with alpha above 0 appends a FragmentNode to the list of its pixel, by
  /// appendFragment() of shaders/scene/fragment_list.glsl. Bindings of set 2:
  ///   0  r32ui storage image, coherent: index of the list's first node + 1; 0 is an empty list
  ///   1  coherent storage buffer of FragmentNode; the first of them, one a pixel, are reserved for each pixel's first
  ///   2  storage buffer of one uint, the allocator: nodes asked for beyond the reserved ones
  fragmentList = 5,
  /// The same without the surfaces that face away from the camera.
  frontFragmentList = 6,
};
#endif

SHARED_CONST uint kMaxSceneLayers = 64u;

// One layer of view depth, in vergences (1/m), near side first. Its images hold what lies between `nearest` and
// `farthest`, which overlap the neighbours a little; rays cross it from `near` to `far`.
struct SceneLayer {
  vec2 borders;  // near, far
  float nearest, farthest;
};

// The layers that one draw uses. Its table is number ViewConstants::lensPoint.w of an array.
struct SceneLayerTable {
  uint layerCount;
  // 1: a triangle goes into every layer that it crosses, clipped to it. 0: whole, into the layer of its farthest vertex.
  uint splitTriangles;
  uint padding0, padding1;
  SceneLayer layers[kMaxSceneLayers];
};

// A fragment of an alpha-blended surface. 24 bytes, scalars only, so that GLSL and C++ agree on the layout.
struct TransparentNode {
  float red, green, blue;  // linear radiance, not premultiplied
  float alpha;             // (0, 1]
  float vergence;          // 1/viewDepth times the near plane: the depth buffer's value
  uint next;               // index + 1 of the next node of this pixel; 0 ends the list
};

// A fragment of any surface. 16 bytes, scalars only. Radiance is limited to half floats' range and not premultiplied.
struct FragmentNode {
  uint redGreen, blueAlpha;  // half floats, packHalf2x16
  uint vergence;             // bits of the depth buffer's value (1/viewDepth times the near plane); its order is theirs
  uint next;                 // index + 1 of the next node of this pixel, 0 ends the list; and the flags below
};
SHARED_CONST uint kFragmentNextMask = 0x3fffffffu;
SHARED_CONST uint kFragmentSolid = 0x40000000u;     // opaque, neither alpha-masked nor alpha-blended, and drawn with both faces
SHARED_CONST uint kFragmentFacesAway = 0x80000000u;
SHARED_CONST uint kFragmentPending = 0xffffffffu;   // vergence of a node that is being written: no depth has these bits

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_EMIT_H
