// The surfaces of a scene in view space as rays meet them: placed triangles, their attributes, and their radiance.
//
// What a material looks like is what the project's shaders say (shaders/scene/surface.glsl, lighting.glsl): radiance and
// alpha of unlit pictures, lit ones with normal maps, occlusion and emission, alpha modes, faces. No code is shared.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "engine/raytracer/camera_rays.h"
#include "engine/raytracer/lighting.h"
#include "engine/raytracer/texture_lookup.h"

namespace lensgraph::engine {

/// Where a ray meets a triangle.
struct SurfaceHit {
  float depth = 0.0f;            ///< View depth, m; the ray's parameter.
  uint32_t instance = kNoIndex;  ///< Scene::instances; kNoIndex: nothing is hit.
  uint32_t triangle = 0;         ///< Of the instance's primitive.
  float u = 0.0f, v = 0.0f;      ///< Barycentric weights of the triangle's second and third vertex.
  bool facesAway = false;        ///< The ray comes from behind.

  bool isSomething() const { return instance != kNoIndex; }
};

class Surfaces {
 public:
  /// The scene outlives it; `environment`, which may be null, is not kept. Precondition: findProblems(scene) is empty.
  Surfaces(const Scene& scene, const SceneViewpoint& viewpoint, const Environment* environment);

  std::size_t instanceCount() const { return placed_.size(); }
  const Primitive& primitive(uint32_t instance) const { return *placed_[instance].primitive; }
  /// Positions of the instance's vertices in view space, m; transformed in double and rounded once.
  std::vector<glm::vec3> viewPositions(uint32_t instance) const;
  AlphaMode alphaMode(uint32_t instance) const { return look(instance).material.alphaMode; }
  bool drawsBothFaces(uint32_t instance) const { return placed_[instance].bothFaces; }
  /// Whether the instance's matrix turns the winding of its triangles round.
  bool isMirrored(uint32_t instance) const { return placed_[instance].isMirrored; }

  /// Of a masked surface: whether it is there at all.
  bool passesMask(const SurfaceHit& hit) const;
  /// Alpha of a blended surface, at most 1; nothing is seen of it unless it is above 0.
  float blendAlpha(const SurfaceHit& hit) const;
  /// Linear radiance towards the ray's origin, not premultiplied.
  glm::vec3 radiance(const SurfaceHit& hit, const ViewRay& ray) const;

 private:
  struct Placed {
    const Primitive* primitive;
    glm::dmat4 viewFromObject;
    glm::mat3 normalFromObject;
    uint32_t look;
    bool bothFaces, isMirrored;
  };
  /// A material with its textures.
  struct Look {
    Material material;
    TextureLookup baseColor, emissive, metallicRoughness, normal, occlusion;
  };
  struct Attributes {
    std::array<glm::vec2, 2> uvs;
    glm::vec4 color;
  };

  const Look& look(uint32_t instance) const { return looks_[placed_[instance].look]; }
  std::array<uint32_t, 3> corners(const SurfaceHit& hit) const;
  Attributes attributes(const SurfaceHit& hit) const;
  glm::vec4 baseColor(const SurfaceHit& hit, const Attributes& at) const;
  LitPoint litPoint(const SurfaceHit& hit, const ViewRay& ray, const Attributes& at, const glm::vec3& baseColor) const;
  glm::vec3 mappedNormal(const SurfaceHit& hit, const Attributes& at, const glm::vec3& normal) const;

  std::vector<Placed> placed_;
  std::vector<Look> looks_;  ///< As Scene::materials, and the default material at the end.
  Lighting lighting_;
  bool isLit_;
};

}  // namespace lensgraph::engine
