// The radiance and alpha of a fragment: inputs of every emit's fragment shader, textures, and surface().
// Unlit mode is exactly: radiance = COLOR_0 × base colour × texture + emissive (dropped for unlit materials),
// alpha = COLOR_0.a × factor × texture; bilinear at level 0, because the area is integrated by pixel samples.
#include "shaders/shared/scene.h"
#include "shaders/shared/view.h"

// Shaded, or the materials' own radiance: known when the pipeline is made, so that unlit pictures carry no lighting code.
layout(constant_id = 1) const bool lit = false;

layout(push_constant) uniform Push { ViewConstants view; };
layout(std430, set = 0, binding = 1) readonly buffer Materials { MaterialConstants materials[]; };
layout(std430, set = 0, binding = 2) readonly buffer Lights { LightConstants lights[]; };
layout(std140, set = 0, binding = 3) uniform SceneBlock { SceneConstants scene; };
layout(set = 0, binding = 4) uniform sampler2D environmentMap;

layout(set = 1, binding = 0) uniform sampler2D baseColorMap;
layout(set = 1, binding = 1) uniform sampler2D emissiveMap;
layout(set = 1, binding = 2) uniform sampler2D metallicRoughnessMap;
layout(set = 1, binding = 3) uniform sampler2D normalMap;
layout(set = 1, binding = 4) uniform sampler2D occlusionMap;

layout(location = 0) in vec3 viewPosition;
layout(location = 1) in vec3 viewNormal;
layout(location = 2) in vec4 texCoords;
layout(location = 3) in vec4 vertexColor;
layout(location = 4) flat in uint materialIndex;

vec2 transformedUv(UvTransform transform) {
  const vec3 uv = vec3(transform.row0.w < 0.5 ? texCoords.xy : texCoords.zw, 1.0);
  return vec2(dot(transform.row0.xyz, uv), dot(transform.row1.xyz, uv));
}

#include "lighting.glsl"

// A mask is drawn where alpha is at least the cutoff. Interpolation and filtering leave an alpha that is equal to it everywhere
// some roundings below it, far less than the steps of an 8-bit alpha.
const float kCutoffRounding = 1.0 - 1e-5;

// Alpha after the material's mode: 1, 0 or 1, or the blend factor.
float surfaceAlpha(float alpha) {
  const uint mode = materials[materialIndex].alphaMode;
  if (mode == kAlphaOpaque) return 1.0;
  if (mode == kAlphaMask) return alpha >= kCutoffRounding * materials[materialIndex].emissive.w ? 1.0 : 0.0;
  return alpha;
}

// A fragment with its light in two parts, and what its gloss depends on. Without gloss the normal is 0.
struct Surface {
  vec3 steady, glossy;  // linear radiance, not premultiplied
  float alpha;
  Shaded shaded;
};

// Members are read where they are used: a copy of the whole material would load all of it for every fragment.
Surface surfaceParts() {
  const vec4 base = vertexColor * materials[materialIndex].baseColor *
                    textureLod(baseColorMap, transformedUv(materials[materialIndex].baseColorUv), 0.0);
  Surface parts;
  parts.steady = base.rgb;
  parts.glossy = vec3(0.0);
  parts.alpha = surfaceAlpha(base.a);
  parts.shaded = Shaded(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0);
  if (materials[materialIndex].unlit != 0u) return parts;
  if (lit) {
    parts.shaded = shadedFragment(base.rgb);
    const Reflected light = reflectedBy(parts.shaded);
    parts.steady = light.steady;
    parts.glossy = light.glossy;
  }
  parts.steady += materials[materialIndex].emissive.rgb *
                  textureLod(emissiveMap, transformedUv(materials[materialIndex].emissiveUv), 0.0).rgb;
  return parts;
}

// Linear radiance (not premultiplied) and alpha towards the view's lens point.
vec4 surface() {
  const Surface parts = surfaceParts();
  return vec4(parts.steady + parts.glossy, parts.alpha);
}
