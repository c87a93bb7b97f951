// Gloss where a lens ray hits, seen from the ray's lens point (Lee, Eisemann, Seidel 2009, §5, figure 9). Bindings 6 to 10.
#include "shaders/shared/scene.h"

layout(set = 0, binding = 6) uniform sampler2DArray glossImage;
layout(set = 0, binding = 7) uniform sampler2DArray facingImage;
layout(set = 0, binding = 8) uniform sampler2D environmentMap;
layout(std430, set = 0, binding = 9) readonly buffer Lights { LightConstants lights[]; };
layout(std140, set = 0, binding = 10) uniform SceneBlock { SceneConstants scene; };

#include "../scene/reflection.glsl"

// Premultiplied by the coverage of the hit.
vec3 glossAt(Ray ray, uint slice, vec2 place, float vergence, float diameter, float coverage) {
  const vec4 facing = lookUp(facingImage, slice, place, diameter);
  if (!(coverage > 0.0) || dot(facing.xyz, facing.xyz) < 1e-4 * coverage * coverage) return vec3(0.0);
  const vec4 gloss = lookUp(glossImage, slice, place, diameter) / coverage;
  const vec2 view = push.viewPoint, lens = view + ray.slope / push.cocScale;
  const float lensRadius = push.cocScale / push.pixelsPerTangent;
  // The place in the pinhole's picture, from its middle: the layers are sheared by their own lens point.
  const vec2 centre = vec2(push.border) + 0.5 * vec2(push.extent);
  const vec2 shear = push.cocScale * (push.focusVergence - vergence) * view;
  const vec2 tangent = (place - centre - shear) / push.pixelsPerTangent;
  Shaded s;
  s.position = vec3(tangent.x, -tangent.y, -1.0) / vergence;
  s.normal = normalize(facing.xyz);
  s.toEye = normalize(vec3(lensRadius * lens.x, -lensRadius * lens.y, 0.0) - s.position);
  s.diffuseColor = vec3(0.0);
  s.specularColor = gloss.rgb;
  s.roughness = max(gloss.a, 0.045);
  s.occlusion = facing.w / coverage;
  const vec3 light = coverage * reflectedBy(s).glossy;
  return any(isnan(light)) || any(isinf(light)) ? vec3(0.0) : light;
}
