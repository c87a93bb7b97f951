// Metallic-roughness shading on the CPU.
#include "engine/raytracer/lighting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <numbers>

namespace lensgraph::engine {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// What leaves towards the eye of light from the direction `toLight` with unit irradiance: Lambert and GGX with Smith's
/// height-correlated visibility, joined by Schlick's Fresnel term.
glm::vec3 brdfTimesCosine(const LitPoint& p, const glm::vec3& toLight) {
  const float nl = std::clamp(glm::dot(p.normal, toLight), 0.0f, 1.0f);
  const float nv = std::max(glm::dot(p.normal, p.toEye), 1e-4f);
  const glm::vec3 halfway = glm::normalize(toLight + p.toEye);
  const float nh = std::clamp(glm::dot(p.normal, halfway), 0.0f, 1.0f);
  const float vh = std::clamp(glm::dot(p.toEye, halfway), 0.0f, 1.0f);
  const float alpha = std::max(p.roughness * p.roughness, 1e-3f), squared = alpha * alpha;
  const glm::vec3 fresnel = p.specularColor + (1.0f - p.specularColor) * std::pow(std::max(1.0f - vh, 1e-6f), 5.0f);
  const float slope = nh * nh * (squared - 1.0f) + 1.0f;
  const float distribution = squared / (kPi * slope * slope);
  const float masking =
      nl * std::sqrt(nv * nv * (1.0f - squared) + squared) + nv * std::sqrt(nl * nl * (1.0f - squared) + squared);
  const float visibility = 0.5f / std::max(masking, 1e-7f);
  return nl * ((1.0f - fresnel) * p.diffuseColor / kPi + fresnel * distribution * visibility);
}

/// Share of a constant environment in the specular lobe: specularColor times x, plus y. The polynomial that the shader
/// states; another fit would be another material.
glm::vec2 directionalAlbedo(float r, float m) {
  const float whole = 0.9605f + m * (0.3319f + m * (-0.2374f - 0.0500f * m)) +
                      r * (-0.4617f + m * (-0.5007f + 0.8909f * m) + r * (0.9666f - 1.0562f * m - 0.5711f * r));
  const float grazing = 1.0f - m;
  const float bias = std::pow(grazing, 4.0f) * (1.0298f + r * (-2.1175f + 0.9179f * r)) + 0.1430f * grazing * r * r;
  const float kept = std::clamp(bias, 0.0f, 1.0f);
  return {std::max(std::clamp(whole, 0.0f, 1.0f) - kept, 0.0f), kept};
}

}  // namespace

Lighting::Lighting(const Scene& scene, const SceneViewpoint& viewpoint, const Environment* environment)
    : worldFromView_(glm::transpose(glm::dmat3(viewpoint.viewFromWorld))) {
  for (const Light& light : scene.lights) {
    const glm::dmat4 viewFromLight = viewpoint.viewFromWorld * light.worldFromLight;
    lights_.push_back({.type = light.type,
                       .color = light.color * light.intensity,
                       .position = glm::vec3(glm::dvec3(viewFromLight[3]) * viewpoint.metersPerUnit),
                       .direction = glm::vec3(glm::normalize(-glm::dvec3(viewFromLight[2]))),
                       .range = light.range ? static_cast<float>(*light.range * viewpoint.metersPerUnit) : 0.0f,
                       .cosInner = std::cos(light.innerConeAngle),
                       .cosOuter = std::cos(light.outerConeAngle)});
  }
  if (environment == nullptr) return;
  irradiance_ = environment->irradiance;
  const std::byte* bytes = environment->texels.data();
  for (uint32_t i = 0; i < environment->desc.mips; ++i) {
    Level level{std::max(environment->desc.width >> i, 1u), std::max(environment->desc.height >> i, 1u), {}};
    level.texels.resize(std::size_t{level.width} * level.height);
    for (glm::vec3& texel : level.texels) {
      uint64_t packed = 0;
      std::memcpy(&packed, bytes, sizeof packed);
      bytes += sizeof packed;
      texel = glm::vec3(glm::unpackHalf4x16(packed));
    }
    levels_.push_back(std::move(level));
  }
}

glm::vec3 Lighting::reflected(const LitPoint& point) const {
  glm::vec3 sum(0.0f);
  for (const ViewLight& light : lights_) sum += fromLight(point, light);
  if (hasEnvironment()) sum += point.occlusion * fromEnvironment(point);
  return sum;
}

glm::vec3 Lighting::fromLight(const LitPoint& point, const ViewLight& light) const {
  if (light.type == LightType::directional) return light.color * brdfTimesCosine(point, -light.direction);
  const glm::vec3 offset = light.position - point.position;
  const float squared = std::max(glm::dot(offset, offset), 1e-8f);
  const glm::vec3 toLight = offset / std::sqrt(squared);
  float attenuation = 1.0f / squared;
  if (light.range > 0.0f) {  // KHR_lights_punctual: 1 - (d / range)⁴, not below 0
    const float ratio = squared / (light.range * light.range);
    attenuation *= std::clamp(1.0f - ratio * ratio, 0.0f, 1.0f);
  }
  if (light.type == LightType::spot) {
    const float cosine = glm::dot(light.direction, -toLight);
    const float width = std::max(light.cosInner - light.cosOuter, 0.001f);
    const float falloff = std::clamp((cosine - light.cosOuter) / width, 0.0f, 1.0f);
    attenuation *= falloff * falloff;
  }
  return light.color * attenuation * brdfTimesCosine(point, toLight);
}

glm::vec3 Lighting::radiance(const glm::vec3& d, float level) const {
  const float azimuth = std::abs(d.x) + std::abs(d.z) > 0.0f ? std::atan2(d.x, -d.z) : 0.0f;
  const float u = 0.5f + azimuth / (2.0f * kPi), v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / kPi;
  const auto bilinear = [&](const Level& map) {
    const auto texel = [&](int64_t x, int64_t y) {  // Repeats in both directions, as the sampler does.
      const int64_t w = map.width, h = map.height;
      return map.texels[static_cast<std::size_t>(((y % h + h) % h) * w + (x % w + w) % w)];
    };
    const float x = u * static_cast<float>(map.width) - 0.5f, y = v * static_cast<float>(map.height) - 0.5f;
    const auto left = static_cast<int64_t>(std::floor(x)), top = static_cast<int64_t>(std::floor(y));
    const float across = x - std::floor(x), down = y - std::floor(y);
    return glm::mix(glm::mix(texel(left, top), texel(left + 1, top), across),
                    glm::mix(texel(left, top + 1), texel(left + 1, top + 1), across), down);
  };
  const float bounded = std::clamp(level, 0.0f, static_cast<float>(levels_.size() - 1));
  const auto fine = static_cast<std::size_t>(bounded);
  const std::size_t coarse = std::min(fine + 1, levels_.size() - 1);
  return glm::mix(bilinear(levels_[fine]), bilinear(levels_[coarse]), bounded - static_cast<float>(fine));
}

glm::vec3 Lighting::fromEnvironment(const LitPoint& point) const {
  const float nv = std::clamp(glm::dot(point.normal, point.toEye), 1e-4f, 1.0f);
  const glm::vec2 albedo = directionalAlbedo(point.roughness, nv);
  const glm::vec3 mirrored = point.specularColor * albedo.x + albedo.y;
  const glm::vec3 n = worldFromView_ * point.normal;
  const std::array<float, 9> basis = {
      1.0f, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0f * n.z * n.z - 1.0f, n.x * n.z, n.x * n.x - n.y * n.y};
  glm::vec3 diffuse(0.0f);
  for (std::size_t i = 0; i < basis.size(); ++i) diffuse += irradiance_[i] * basis[i];
  const glm::vec3 direction = worldFromView_ * glm::reflect(-point.toEye, point.normal);
  const float level = point.roughness * std::max(static_cast<float>(levels_.size()) - 3.0f, 0.0f);
  return (1.0f - mirrored) * point.diffuseColor * glm::max(diffuse, glm::vec3(0.0f)) +
         mirrored * radiance(direction, level);
}

}  // namespace lensgraph::engine
