// A scene as plain data: what a file described, ready to be uploaded or ray-traced. Knows no file format, no
// device.
//
// Lengths in metres, angles in radians, right-handed, +Y up, colours linear Rec.709. Indices into the vectors
// of Scene are valid or kNoIndex; findProblems() says where they are not, for scenes made by hand.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace lensgraph::engine {

inline constexpr uint32_t kNoIndex = std::numeric_limits<uint32_t>::max();

/// Axis-aligned box; empty until something is added.
struct Bounds {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};

  bool isEmpty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  void add(const glm::dvec3& point);
  void add(const Bounds& other);
  bool operator==(const Bounds&) const = default;
};

// ---- Textures

/// How the eight bits of a colour channel are to be read. Alpha is always linear.
enum class ColorEncoding { linear, srgb };

/// Pixels of one image for one use. An image that is used both as colour and as data stands here twice.
struct SceneImage {
  std::string name;           ///< For messages: file or name in the file.
  uint32_t width = 0;         ///< px, at least 1
  uint32_t height = 0;        ///< px, at least 1
  std::vector<uint8_t> rgba;  ///< width · height · 4, top row first, alpha not premultiplied.
  ColorEncoding encoding = ColorEncoding::linear;
};

enum class Wrap { repeat, mirroredRepeat, clampToEdge };
enum class Filter { nearest, linear };

/// An image and how to sample it.
struct Texture {
  uint32_t image = kNoIndex;  ///< Scene::images
  Wrap wrapS = Wrap::repeat;
  Wrap wrapT = Wrap::repeat;
  Filter magFilter = Filter::linear;
  Filter minFilter = Filter::linear;
  std::optional<Filter> mipFilter = Filter::linear;  ///< None: the largest level only.
};

/// A material's use of a texture.
/// uv' = offset + R(rotation) (scale · uv), with R = [cos sin; −sin cos] as KHR_texture_transform defines it.
struct TextureUse {
  uint32_t texture = kNoIndex;  ///< Scene::textures; kNoIndex: no texture, its factor alone counts.
  uint32_t uvSet = 0;           ///< 0 or 1
  glm::vec2 offset{0.0f};
  float rotation = 0.0f;  ///< rad, counter-clockwise in a UV space with v down
  glm::vec2 scale{1.0f};

  bool isUsed() const { return texture != kNoIndex; }
};

/// The transformed UV of a texture use; the one place of the formula in C++.
glm::vec2 transformUv(const TextureUse& use, glm::vec2 uv);

// ---- Materials

enum class AlphaMode {
  opaque,  ///< Alpha is 1 whatever the texture says.
  mask,    ///< Drawn where alpha >= alphaCutoff, and opaque there.
  blend,   ///< Ordered over.
};

struct Material {
  std::string name;
  glm::vec4 baseColorFactor{1.0f};
  TextureUse baseColorTexture;  ///< sRGB
  glm::vec3 emissiveFactor{0.0f};
  float emissiveStrength = 1.0f;
  TextureUse emissiveTexture;  ///< sRGB
  float metallicFactor = 1.0f;
  float roughnessFactor = 1.0f;
  TextureUse metallicRoughnessTexture;  ///< Linear: G roughness, B metallic.
  TextureUse normalTexture;             ///< Linear, tangent space.
  float normalScale = 1.0f;
  TextureUse occlusionTexture;  ///< Linear: R.
  float occlusionStrength = 1.0f;
  AlphaMode alphaMode = AlphaMode::opaque;
  float alphaCutoff = 0.5f;  ///< For AlphaMode::mask.
  bool doubleSided = false;  ///< Back faces are drawn too; without it only where DrawnFaces::both asks for them.
  bool unlit = false;        ///< KHR_materials_unlit: base colour is the radiance; the emissive part is dropped.
};

// ---- Geometry

/// Triangles of one material. Every attribute vector but positions is either empty or as long as positions.
struct Primitive {
  std::string name;                  ///< For messages: mesh name or "meshes[2].primitives[0]".
  std::vector<glm::vec3> positions;  ///< Object space, finite.
  std::vector<glm::vec3> normals;    ///< Unit length; always filled by a loader (flat where the file has none).
  std::vector<glm::vec4> tangents;   ///< Optional. w = ±1 is the bitangent's sign.
  std::vector<glm::vec2> uvs[2];     ///< Optional. Sets 0 and 1.
  std::vector<glm::vec4> colors;     ///< Optional; linear RGBA, alpha 1 where the file has none.
  std::vector<uint32_t> indices;     ///< Three per triangle, each below positions.size(); counter-clockwise is front.
  uint32_t material = kNoIndex;      ///< Scene::materials
  Bounds bounds;                     ///< Of positions, object space.

  size_t triangleCount() const { return indices.size() / 3; }
};

/// One placement of a primitive. A matrix of negative determinant turns the winding round, as in glTF.
struct Instance {
  uint32_t primitive = kNoIndex;  ///< Scene::primitives
  glm::dmat4 worldFromObject{1.0};
  std::string name;  ///< Node's name, may be empty.
};

// ---- Cameras and lights

enum class CameraType { perspective, orthographic };

/// Camera of a file, with the file's numbers, which may be nonsense: cameraFromScene() checks the one that is used. Looks
/// down its −Z.
struct SceneCamera {
  std::string name;      ///< glTF camera's name; its node's name when it has none; may be empty.
  std::string nodeName;  ///< Also accepted by findCamera().
  CameraType type = CameraType::perspective;
  uint32_t fileIndex = 0;             ///< Its place in the file's `cameras`, for messages.
  double yfov = 0.8;                  ///< rad; perspective only
  std::optional<double> aspectRatio;  ///< Width / height.
  double znear = 0.01;                ///< m
  std::optional<double> zfar;         ///< m; none: infinite
  glm::dmat4 worldFromCamera{1.0};
};

enum class LightType { directional, point, spot };

/// Punctual light (KHR_lights_punctual). Directional and spot lights shine down their −Z.
struct Light {
  std::string name;
  LightType type = LightType::point;
  glm::vec3 color{1.0f};
  float intensity = 1.0f;               ///< cd for point and spot, lx for directional.
  std::optional<float> range;           ///< m; none: infinite.
  float innerConeAngle = 0.0f;          ///< rad from the axis, spot only
  float outerConeAngle = 0.785398163f;  ///< rad from the axis, spot only
  glm::dmat4 worldFromLight{1.0};
};

// ---- The scene

struct Scene {
  std::vector<Primitive> primitives;
  std::vector<Instance> instances;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<SceneImage> images;
  /// File after file; of each those that nodes place, in the order of the file's `cameras`. One that several nodes place
  /// is there once for each, in the order in which the tree of nodes is walked, parents first.
  std::vector<SceneCamera> cameras;
  std::vector<Light> lights;
};

/// Box of everything drawn, in the world. Exact: every vertex is transformed.
Bounds worldBounds(const Scene& scene);

/// Triangles drawn, a primitive that is placed twice counted twice.
uint64_t triangleCount(const Scene& scene);

/// The camera of that name (camera's name first, then node's name); null when there is none.
const SceneCamera* findCamera(const Scene& scene, const std::string& name);

/// Everything that would make a renderer read out of bounds or draw nonsense: indices out of range, attribute
/// lengths that differ, non-finite positions and matrices, images whose pixels do not match their size.
/// Empty: the scene is valid.
std::vector<std::string> findProblems(const Scene& scene);

/// Flat normals, one per triangle, for a primitive without: vertices are split so that triangles share none,
/// and tangents, which belong to the lost normals, are dropped. Degenerate triangles get +Z.
void computeFlatNormals(Primitive& primitive);

}  // namespace lensgraph::engine
