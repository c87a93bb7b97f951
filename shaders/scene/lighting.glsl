// A fragment of a metallic-roughness material as the shading formulas want it.

#include "reflection.glsl"

// A tangent frame from screen-space derivatives, so that meshes need no tangents (Mikkelsen 2010 describes the idea).
vec3 mappedNormal(vec3 normal) {
  const float normalScale = materials[materialIndex].surface.z;
  if (normalScale == 0.0) return normal;
  const vec2 uv = transformedUv(materials[materialIndex].normalUv);
  const vec3 dpdx = dFdx(viewPosition), dpdy = dFdy(viewPosition);
  const vec2 duvdx = dFdx(uv), duvdy = dFdy(uv);
  const vec3 perpX = cross(normal, dpdx), perpY = cross(dpdy, normal);
  const vec3 tangent = perpY * duvdx.x + perpX * duvdy.x;
  const vec3 bitangent = perpY * duvdx.y + perpX * duvdy.y;
  const float longest = max(dot(tangent, tangent), dot(bitangent, bitangent));
  if (!(longest > 0.0)) return normal;
  vec3 local = textureLod(normalMap, uv, 0.0).xyz * 2.0 - 1.0;
  local.xy *= normalScale;
  // The frame comes out turned by 180° where the derivatives' own normal looks away, as it does with y down.
  const float scale = inversesqrt(longest) * (dot(cross(dpdx, dpdy), normal) < 0.0 ? -1.0 : 1.0);
  // glTF's v points down the texture; its bitangent points up.
  return normalize(tangent * scale * local.x - bitangent * scale * local.y + normal * local.z);
}

Shaded shadedFragment(vec3 baseColor) {
  const vec4 factors = materials[materialIndex].surface;
  vec3 normal = normalize(viewNormal);
  if (!gl_FrontFacing) normal = -normal;
  const vec4 sampled = textureLod(metallicRoughnessMap, transformedUv(materials[materialIndex].metallicRoughnessUv), 0.0);
  const float metallic = clamp(factors.x * sampled.b, 0.0, 1.0);
  Shaded s;
  s.position = viewPosition;
  s.normal = mappedNormal(normal);
  s.toEye = normalize(view.lensPoint.xyz - viewPosition);
  s.diffuseColor = baseColor * (1.0 - metallic);
  s.specularColor = mix(vec3(0.04), baseColor, metallic);
  s.roughness = clamp(factors.y * sampled.g, 0.045, 1.0);
  s.occlusion = 1.0;
  if (scene.hasEnvironment != 0u) {
    const float occlusion = textureLod(occlusionMap, transformedUv(materials[materialIndex].occlusionUv), 0.0).r;
    s.occlusion = mix(1.0, occlusion, factors.w);
  }
  return s;
}
