// Placement, interpolation of attributes, and the materials' formulas.
#include "engine/raytracer/surfaces.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lensgraph::engine {
namespace {

/// Interpolated alpha that equals the cutoff everywhere is some roundings below it; steps of 8-bit alpha are larger.
constexpr float kCutoffRounding = 1.0f - 1e-5f;

/// A determinant of axes of unit length below this is a rounding of 0.
constexpr double kFlat = 1e-14;

/// Determinant of the matrix with its axes scaled to unit length; 0 when an axis has no length.
double unitDeterminant(const glm::dmat4& worldFromObject) {
  glm::dmat3 m(worldFromObject);
  for (int axis = 0; axis < 3; ++axis) {
    const double largest = std::max({std::abs(m[axis].x), std::abs(m[axis].y), std::abs(m[axis].z)});
    if (largest == 0.0) return 0.0;
    m[axis] = glm::normalize(m[axis] / largest);
  }
  return glm::determinant(m);
}

template <class T>
T interpolated(const std::vector<T>& values, const std::array<uint32_t, 3>& corners, const SurfaceHit& hit) {
  return values[corners[0]] * (1.0f - hit.u - hit.v) + values[corners[1]] * hit.u + values[corners[2]] * hit.v;
}

}  // namespace

Surfaces::Surfaces(const Scene& scene, const SceneViewpoint& viewpoint, const Environment* environment)
    : lighting_(scene, viewpoint, environment), isLit_(viewpoint.lit) {
  const auto addLook = [&](const Material& material) {
    const auto lookup = [&](const TextureUse& use) { return TextureLookup(scene, use); };
    looks_.push_back({material, lookup(material.baseColorTexture), lookup(material.emissiveTexture),
                      lookup(material.metallicRoughnessTexture), lookup(material.normalTexture),
                      lookup(material.occlusionTexture)});
  };
  for (const Material& material : scene.materials) addLook(material);
  addLook(Material{});
  for (const Instance& instance : scene.instances) {
    Placed placed{.primitive = &scene.primitives[instance.primitive]};
    placed.look = std::min<uint32_t>(placed.primitive->material, static_cast<uint32_t>(scene.materials.size()));
    placed.viewFromObject = viewpoint.viewFromWorld * instance.worldFromObject;
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) placed.viewFromObject[column][row] *= viewpoint.metersPerUnit;
    }
    const double determinant = unitDeterminant(instance.worldFromObject);
    placed.isMirrored = determinant < -kFlat;
    placed.bothFaces = viewpoint.faces == DrawnFaces::both || looks_[placed.look].material.doubleSided ||
                       !(std::abs(determinant) > kFlat);
    // Cofactors transform normals, and exist where a matrix flattens a dimension; a mirror turns them round.
    const glm::dmat3 m(placed.viewFromObject);
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    placed.normalFromObject = glm::mat3(placed.isMirrored ? -cofactors : cofactors);
    placed_.push_back(placed);
  }
}

std::vector<glm::vec3> Surfaces::viewPositions(uint32_t instance) const {
  const Placed& placed = placed_[instance];
  std::vector<glm::vec3> positions;
  positions.reserve(placed.primitive->positions.size());
  for (const glm::vec3& p : placed.primitive->positions) {
    positions.emplace_back(glm::dvec3(placed.viewFromObject * glm::dvec4(p, 1.0)));
  }
  return positions;
}

std::array<uint32_t, 3> Surfaces::corners(const SurfaceHit& hit) const {
  const uint32_t* indices = placed_[hit.instance].primitive->indices.data() + std::size_t{hit.triangle} * 3;
  return {indices[0], indices[1], indices[2]};
}

Surfaces::Attributes Surfaces::attributes(const SurfaceHit& hit) const {
  const Primitive& primitive = *placed_[hit.instance].primitive;
  const auto at = corners(hit);
  Attributes result{.uvs = {glm::vec2(0.0f), glm::vec2(0.0f)}, .color = glm::vec4(1.0f)};
  for (std::size_t set = 0; set < 2; ++set) {
    if (!primitive.uvs[set].empty()) result.uvs[set] = interpolated(primitive.uvs[set], at, hit);
  }
  if (!primitive.colors.empty()) result.color = interpolated(primitive.colors, at, hit);
  return result;
}

glm::vec4 Surfaces::baseColor(const SurfaceHit& hit, const Attributes& at) const {
  const Look& of = look(hit.instance);
  return at.color * of.material.baseColorFactor * of.baseColor.at(at.uvs);
}

bool Surfaces::passesMask(const SurfaceHit& hit) const {
  return baseColor(hit, attributes(hit)).a >= kCutoffRounding * look(hit.instance).material.alphaCutoff;
}

float Surfaces::blendAlpha(const SurfaceHit& hit) const {
  return std::min(baseColor(hit, attributes(hit)).a, 1.0f);
}

glm::vec3 Surfaces::radiance(const SurfaceHit& hit, const ViewRay& ray) const {
  const Attributes at = attributes(hit);
  const Look& of = look(hit.instance);
  const glm::vec3 base(baseColor(hit, at));
  if (of.material.unlit) return base;
  const glm::vec3 own = isLit_ ? lighting_.reflected(litPoint(hit, ray, at, base)) : base;
  return own + of.material.emissiveFactor * of.material.emissiveStrength * glm::vec3(of.emissive.at(at.uvs));
}

LitPoint Surfaces::litPoint(const SurfaceHit& hit, const ViewRay& ray, const Attributes& at,
                            const glm::vec3& baseColor) const {
  const Placed& placed = placed_[hit.instance];
  const Look& of = look(hit.instance);
  const glm::vec3 object = placed.primitive->normals.empty()
                               ? glm::vec3(0.0f, 0.0f, 1.0f)
                               : interpolated(placed.primitive->normals, corners(hit), hit);
  glm::vec3 normal = glm::normalize(placed.normalFromObject * object);
  if (hit.facesAway) normal = -normal;
  const glm::vec4 sampled = of.metallicRoughness.at(at.uvs);
  const float metallic = std::clamp(of.material.metallicFactor * sampled.b, 0.0f, 1.0f);
  LitPoint point;
  point.position = ray.origin + hit.depth * ray.direction;
  point.normal = mappedNormal(hit, at, normal);
  point.toEye = -glm::normalize(ray.direction);
  point.diffuseColor = baseColor * (1.0f - metallic);
  point.specularColor = glm::mix(glm::vec3(0.04f), baseColor, metallic);
  point.roughness = std::clamp(of.material.roughnessFactor * sampled.g, 0.045f, 1.0f);
  if (of.occlusion.isUsed()) {
    point.occlusion = 1.0f + of.material.occlusionStrength * (of.occlusion.at(at.uvs).r - 1.0f);
  }
  return point;
}

/// The tangent frame follows from how positions and UV change along two sides of the triangle; the vertices' own tangents
/// are not used, as in the shaders.
glm::vec3 Surfaces::mappedNormal(const SurfaceHit& hit, const Attributes& at, const glm::vec3& normal) const {
  const Look& of = look(hit.instance);
  if (!of.normal.isUsed() || of.material.normalScale == 0.0f) return normal;
  const Placed& placed = placed_[hit.instance];
  const auto corner = corners(hit);
  std::array<glm::dvec3, 3> p;
  std::array<glm::vec2, 3> uv;
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = glm::dvec3(placed.viewFromObject * glm::dvec4(placed.primitive->positions[corner[i]], 1.0));
    std::array<glm::vec2, 2> sets = {glm::vec2(0.0f), glm::vec2(0.0f)};
    for (std::size_t set = 0; set < 2; ++set) {
      if (!placed.primitive->uvs[set].empty()) sets[set] = placed.primitive->uvs[set][corner[i]];
    }
    uv[i] = of.normal.transformed(sets);
  }
  const glm::dvec3 n(normal), side1 = p[1] - p[0], side2 = p[2] - p[0];
  const glm::dvec2 uv1(uv[1] - uv[0]), uv2(uv[2] - uv[0]);
  // Gradients of u and v on the plane across n, up to a common factor whose sign is that of (side1 × side2) · n.
  const glm::dvec3 across1 = glm::cross(side2, n), across2 = glm::cross(n, side1);
  const glm::dvec3 tangent = across1 * uv1.x + across2 * uv2.x;
  const glm::dvec3 bitangent = across1 * uv1.y + across2 * uv2.y;
  const double longest = std::max(glm::dot(tangent, tangent), glm::dot(bitangent, bitangent));
  if (!(longest > 0.0)) return normal;
  glm::dvec3 local = glm::dvec3(glm::vec3(of.normal.at(at.uvs))) * 2.0 - 1.0;
  local.x *= of.material.normalScale;
  local.y *= of.material.normalScale;
  const double scale = (glm::dot(glm::cross(side1, side2), n) < 0.0 ? -1.0 : 1.0) / std::sqrt(longest);
  // v points down the texture, and the bitangent of glTF's normal maps up.
  return glm::vec3(glm::normalize((tangent * local.x - bitangent * local.y) * scale + n * local.z));
}

}  // namespace lensgraph::engine
