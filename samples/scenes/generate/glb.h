// Writes binary glTF 2.0: meshes, materials, embedded PNG textures, nodes, cameras, punctual lights.
//
// Same calls, same bytes. Attributes lie in one buffer view each, aligned to 4 bytes; indices take 16 bits
// where they fit. Keeps the triangles in world space, so that a scene can be measured.
#pragma once

#include <array>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "generate/canvas.h"
#include "generate/mesh.h"

namespace scenes {

using Json = nlohmann::ordered_json;

enum class Wrap { repeat, clamp };
enum class AlphaMode { opaque, mask, blend };

/// unlit: the base colour is the radiance and nothing is emitted (KHR_materials_unlit).
struct Material {
  std::string name;
  glm::vec4 baseColor{1.0f};
  int texture = -1;  ///< Of addTexture, or none.
  AlphaMode alphaMode = AlphaMode::opaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false;
  bool unlit = true;
  float metallic = 0.0f;
  float roughness = 1.0f;
  glm::vec3 emissive{0.0f};
  float emissiveStrength = 1.0f;
  int emissiveTexture = -1;
  int normalTexture = -1;             ///< Tangent space, as glTF wants it.
  int metallicRoughnessTexture = -1;  ///< G: roughness, B: metallic; the factors above are multiplied in.
};

/// Which attributes a mesh is written with, beside positions.
struct Attributes {
  bool normals = false;
  bool uvs = false;
  bool colors = false;
};

struct Placement {
  glm::vec3 translation{0.0f};
  glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
  float scale = 1.0f;
};

struct LightSource {
  std::string name;
  std::string type;  ///< "directional", "point" or "spot"; shines down −Z of its node.
  glm::vec3 color{1.0f};
  float intensity = 1.0f;       ///< lx for directional, cd otherwise.
  float outerConeAngle = 0.6f;  ///< rad, spot only.
};

class Glb {
 public:
  /// pngLevel: effort of the textures' compression, 1 (quick) to 9 (small).
  explicit Glb(int pngLevel = 9) : pngLevel_(pngLevel) {}

  int addTexture(const std::string& name, const Canvas& canvas, Wrap wrap, bool alpha = false);
  int addMaterial(const Material& material);
  /// extras: written to the mesh when not null.
  int addMesh(const std::string& name, const Mesh& mesh, int material, Attributes attributes,
              const Json& extras = nullptr);
  void addNode(const std::string& name, int mesh, const Placement& placement = {});
  /// A mesh with a node at the origin.
  void add(const std::string& name, const Mesh& mesh, int material, Attributes attributes);
  void addCamera(const std::string& name, float yfov, glm::vec3 position, glm::vec3 target);
  void addLight(const LightSource& light, glm::vec3 position, glm::vec3 target);

  void write(const std::filesystem::path& file) const;

  using Triangle = std::array<glm::vec3, 3>;
  const std::vector<Triangle>& worldTriangles() const { return worldTriangles_; }

 private:
  size_t addView(const void* data, size_t size, int target);
  size_t addFloats(const std::vector<float>& values, int components, bool bounds);
  size_t addColors(const Mesh& mesh);
  size_t addIndices(const Mesh& mesh);
  void useExtension(const char* name);
  size_t addRootNode(Json node);

  Json root_ = {{"asset", {{"version", "2.0"}, {"generator", "lensgraph generate_scenes"}, {"copyright", "MIT"}}},
                {"scene", 0},
                {"scenes", Json::array({{{"nodes", Json::array()}}})}};
  int pngLevel_;
  std::vector<uint8_t> binary_;
  std::vector<std::vector<Triangle>> meshTriangles_;
  std::vector<Triangle> worldTriangles_;
};

}  // namespace scenes
