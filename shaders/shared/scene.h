// What the scene's shaders read of the scene: one DrawConstants per draw, one MaterialConstants per material, lights.
// Layouts are std430 and C++ at once: members are vec4 and groups of four scalars.
#ifndef LENSGRAPH_SHARED_SCENE_H
#define LENSGRAPH_SHARED_SCENE_H

#include "shaders/shared/interop.h"

SHARED_NAMESPACE_BEGIN

struct DrawConstants {
  mat4 viewFromObject;    // m; rounded from double
  vec4 normalColumns[3];  // inverse transpose of its 3×3 part, column by column; w of the first: 1 where it mirrors
  uint material;
  uint bothFaces;  // 1: back faces are drawn too
  uint padding0, padding1;
};

// uv' = (dot(row0.xyz, (u, v, 1)), dot(row1.xyz, (u, v, 1))); row0.w: UV set
struct UvTransform {
  vec4 row0, row1;
};

SHARED_CONST uint kAlphaOpaque = 0u;
SHARED_CONST uint kAlphaMask = 1u;
SHARED_CONST uint kAlphaBlend = 2u;

struct MaterialConstants {
  vec4 baseColor;
  vec4 emissive;  // rgb: factor × strength; w: alpha cutoff
  vec4 surface;   // metallic, roughness, normal scale (0: no normal map), occlusion strength
  UvTransform baseColorUv, emissiveUv, metallicRoughnessUv, normalUv, occlusionUv;
  uint alphaMode;
  uint unlit;
  uint padding0, padding1;
};

SHARED_CONST uint kLightDirectional = 0u;
SHARED_CONST uint kLightPoint = 1u;
SHARED_CONST uint kLightSpot = 2u;

struct LightConstants {
  vec4 color;      // rgb × intensity (cd, lx); w: type
  vec4 position;   // view space, m; w: range, m (0: infinite)
  vec4 direction;  // view space, the way it shines; w unused
  vec4 cone;       // spot: x scale, y offset of the cosine (KHR_lights_punctual)
};

// One per scene and camera; std140-compatible.
struct SceneConstants {
  vec4 irradiance[9];       // spherical harmonics of the environment's irradiance / π, world space; rgb
  vec4 worldFromViewRows[3];
  uint lightCount;
  uint hasEnvironment;
  float environmentMips;    // levels of the environment map
  uint padding;
};

SHARED_NAMESPACE_END

#endif  // LENSGRAPH_SHARED_SCENE_H
