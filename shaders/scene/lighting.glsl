// A fragment of a metallic-roughness material as the shading formulas want it.

#include "reflection.glsl"

// The linear part of the transform alone.
vec2 transformedDirection(UvTransform transform, vec4 coords) {
  const vec2 direction = transform.row0.w < 0.5 ? coords.xy : coords.zw;
  return vec2(dot(transform.row0.xy, direction), dot(transform.row1.xy, direction));
}

// A tangent frame from screen-space derivatives, so that meshes need no tangents (Mikkelsen 2010 describes the idea).
// Derivatives are taken of the vertices' outputs alone, before anything depends on a buffer: helper invocations, of which
// there are some along every edge of a triangle, load zeros on some devices (llvmpipe).
vec3 mappedNormal(vec3 normal) {
  const vec3 dpdx = dFdx(viewPosition), dpdy = dFdy(viewPosition);
  const vec4 coordsX = dFdx(texCoords), coordsY = dFdy(texCoords);
  const float normalScale = materials[materialIndex].surface.z;
  if (normalScale == 0.0) return normal;
  const UvTransform transform = materials[materialIndex].normalUv;
  const vec2 uv = transformedUv(transform);
  const vec2 duvdx = transformedDirection(transform, coordsX), duvdy = transformedDirection(transform, coordsY);
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
