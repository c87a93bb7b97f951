// Metallic-roughness shading (glTF 2.0 appendix B): GGX specular, Lambert diffuse, punctual lights, environment map.
// The environment's diffuse part is nine spherical harmonics (Ramamoorthi & Hanrahan 2001), its specular part the map's
// mip level by roughness times a fit of the lobe's directional albedo (the split sum of Karis 2013). Single scattering:
// rough metals lose what would bounce between their facets. No shadows, no transmission.

const float kPi = 3.14159265358979;

struct Shaded {
  vec3 position;  // view space, m
  vec3 normal, toEye, diffuseColor, specularColor;
  float roughness;  // perceptual; alpha = roughness²
  float occlusion;  // of the environment; 1: none
};

// Light that leaves a surface towards the eye: what it would send (nearly) alike into other directions, and its gloss.
struct Reflected {
  vec3 steady, glossy;
};

float distributionGgx(float nDotH, float alpha) {
  const float a2 = alpha * alpha;
  const float f = (nDotH * a2 - nDotH) * nDotH + 1.0;
  return a2 / (kPi * f * f);
}

// Smith visibility with height correlation: G / (4 nDotL nDotV).
float visibilitySmith(float nDotL, float nDotV, float alpha) {
  const float a2 = alpha * alpha;
  const float gv = nDotL * sqrt(nDotV * nDotV * (1.0 - a2) + a2);
  const float gl = nDotV * sqrt(nDotL * nDotL * (1.0 - a2) + a2);
  return 0.5 / max(gv + gl, 1e-7);
}

Reflected reflectedLight(Shaded s, vec3 toLight) {
  const float nDotL = clamp(dot(s.normal, toLight), 0.0, 1.0);
  const float nDotV = max(dot(s.normal, s.toEye), 1e-4);
  const vec3 halfway = normalize(toLight + s.toEye);
  const float alpha = max(s.roughness * s.roughness, 1e-3);
  const float fresnelWeight = pow(max(1.0 - clamp(dot(s.toEye, halfway), 0.0, 1.0), 1e-6), 5.0);
  const vec3 fresnel = s.specularColor + (1.0 - s.specularColor) * fresnelWeight;
  const vec3 specular =
      fresnel * distributionGgx(clamp(dot(s.normal, halfway), 0.0, 1.0), alpha) * visibilitySmith(nDotL, nDotV, alpha);
  return Reflected(nDotL * (1.0 - fresnel) * s.diffuseColor / kPi, nDotL * specular);
}

Reflected scaled(vec3 light, Reflected part) { return Reflected(light * part.steady, light * part.glossy); }

Reflected punctualLight(Shaded s, LightConstants light) {
  if (uint(light.color.w) == kLightDirectional) return scaled(light.color.rgb, reflectedLight(s, -light.direction.xyz));
  const vec3 offset = light.position.xyz - s.position;
  const float squared = max(dot(offset, offset), 1e-8);
  const vec3 toLight = offset * inversesqrt(squared);
  float attenuation = 1.0 / squared;
  if (light.position.w > 0.0) {
    const float ratio = squared / (light.position.w * light.position.w);
    attenuation *= clamp(1.0 - ratio * ratio, 0.0, 1.0);
  }
  if (uint(light.color.w) == kLightSpot) {
    const float falloff = clamp(dot(light.direction.xyz, -toLight) * light.cone.x + light.cone.y, 0.0, 1.0);
    attenuation *= falloff * falloff;
  }
  return scaled(light.color.rgb * attenuation, reflectedLight(s, toLight));
}

vec3 worldDirection(vec3 v) {
  return vec3(dot(scene.worldFromViewRows[0].xyz, v), dot(scene.worldFromViewRows[1].xyz, v),
              dot(scene.worldFromViewRows[2].xyz, v));
}

// Latitude-longitude: -Z in the middle, +Y up.
vec3 environmentRadiance(vec3 direction, float level) {
  const float azimuth = abs(direction.x) + abs(direction.z) > 0.0 ? atan(direction.x, -direction.z) : 0.0;
  const vec2 uv = vec2(0.5 + azimuth / (2.0 * kPi), acos(clamp(direction.y, -1.0, 1.0)) / kPi);
  return textureLod(environmentMap, uv, level).rgb;
}

vec3 environmentIrradiance(vec3 n) {
  const vec3 sum = scene.irradiance[0].rgb + scene.irradiance[1].rgb * n.y + scene.irradiance[2].rgb * n.z +
                   scene.irradiance[3].rgb * n.x + scene.irradiance[4].rgb * n.x * n.y +
                   scene.irradiance[5].rgb * n.y * n.z + scene.irradiance[6].rgb * (3.0 * n.z * n.z - 1.0) +
                   scene.irradiance[7].rgb * n.x * n.z + scene.irradiance[8].rgb * (n.x * n.x - n.y * n.y);
  return max(sum, vec3(0.0));
}

// Share of a constant environment that the specular lobe sends to the eye: specularColor times x, plus y.
// Polynomials fitted to the integral of this file's D, V and F over roughness 0.045…1 and nDotV 0.02…1, largest error
// minimised: x + y (a perfect mirror's colour) within 0.045, y within 0.06, both largest near grazing.
vec2 directionalAlbedo(float roughness, float nDotV) {
  const float r = roughness, m = nDotV;
  const float whole = 0.9605 + m * (0.3319 + m * (-0.2374 - 0.0500 * m)) +
                      r * (-0.4617 + m * (-0.5007 + 0.8909 * m) + r * (0.9666 - 1.0562 * m - 0.5711 * r));
  const float grazing = 1.0 - m, squared = grazing * grazing;
  const float bias = squared * squared * (1.0298 + r * (-2.1175 + 0.9179 * r)) + 0.1430 * grazing * r * r;
  const float kept = clamp(bias, 0.0, 1.0);
  return vec2(max(clamp(whole, 0.0, 1.0) - kept, 0.0), kept);
}

Reflected environmentLight(Shaded s) {
  const float nDotV = clamp(dot(s.normal, s.toEye), 1e-4, 1.0);
  const vec2 albedo = directionalAlbedo(s.roughness, nDotV);
  const vec3 reflected = s.specularColor * albedo.x + albedo.y;
  const vec3 mirrored = worldDirection(reflect(-s.toEye, s.normal));
  const vec3 specular = environmentRadiance(mirrored, s.roughness * max(scene.environmentMips - 3.0, 0.0));
  // What the surface reflects does not reach the ground below it.
  return Reflected((1.0 - reflected) * s.diffuseColor * environmentIrradiance(worldDirection(s.normal)),
                   reflected * specular);
}

// All lights and the environment. Whoever includes this declares lights[], scene and environmentMap.
Reflected reflectedBy(Shaded s) {
  Reflected sum = Reflected(vec3(0.0), vec3(0.0));
  for (uint i = 0u; i < scene.lightCount; ++i) {
    const Reflected part = punctualLight(s, lights[i]);
    sum.steady += part.steady;
    sum.glossy += part.glossy;
  }
  if (scene.hasEnvironment != 0u) {
    const Reflected part = scaled(vec3(s.occlusion), environmentLight(s));
    sum.steady += part.steady;
    sum.glossy += part.glossy;
  }
  return sum;
}
