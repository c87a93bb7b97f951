// Walks the node tree of a glTF file and assembles the scene: instances, cameras, lights.
#include "engine/gltf/load_gltf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <tuple>

#include "engine/error.h"
#include "engine/gltf/geometry/primitive.h"
#include "engine/gltf/geometry/skin.h"
#include "engine/gltf/instancing.h"
#include "engine/gltf/material.h"
#include "engine/gltf/node_tree.h"
#include "engine/gltf/read/document.h"

namespace lensgraph::engine {
namespace {

using gltf::at;
using gltf::Document;

constexpr double kPi = 3.14159265358979323846;

bool isFinite(const glm::dmat4& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(m[column][row])) return false;
    }
  }
  return true;
}

// Scale 0 on all axes is the usual way to hide a node (glTF 2.0 §3.5.2).
bool isHidden(const glm::dmat4& m) {
  return glm::dvec3(m[0]) == glm::dvec3(0.0) && glm::dvec3(m[1]) == glm::dvec3(0.0) &&
         glm::dvec3(m[2]) == glm::dvec3(0.0);
}

class Assembler {
 public:
  Assembler(Document& document, const glm::dmat4& worldFromFile, const GltfOptions& options)
      : document_(document), worldFromFile_(worldFromFile), materials_(document, scene_, options.isLit) {}

  Scene assemble() {
    tree_ = gltf::placeNodes(document_);
    for (const auto& [index, isVisible] : tree_.placed) {
      const tinygltf::Node& node = document_.model.nodes[index];
      const glm::dmat4 world = worldFromFile_ * tree_.fileFromNode[index];
      if (node.camera >= 0) addCamera(node, world);
      const bool shines = node.extensions.contains("KHR_lights_punctual");
      if (!isVisible || (node.mesh < 0 && !shines)) continue;
      if (!isFinite(world)) document_.fail(at("nodes", index), "its transform is too large");
      if (node.mesh >= 0 && !isHidden(world)) addMesh(index, node, world);
      if (shines) addLight(node, world);
    }
    std::ranges::stable_sort(scene_.cameras, {}, &SceneCamera::fileIndex);
    return std::move(scene_);
  }

 private:
  void addMesh(size_t nodeIndex, const tinygltf::Node& node, const glm::dmat4& world) {
    if (node.skin >= 0) document_.warn("skins are drawn in their rest pose");
    const tinygltf::Mesh& mesh = document_.model.meshes[static_cast<size_t>(node.mesh)];
    // A skinned mesh stands where its joints are; its node's transform does not count (glTF 2.0 §3.7.3.3).
    const glm::dmat4& worldFromNode = node.skin >= 0 ? worldFromFile_ : world;
    const std::string name = node.name.empty() ? at("nodes", nodeIndex) : node.name;
    const uint64_t instanceSize = sizeof(Instance) + name.size();
    const std::vector<glm::dmat4> placements =
        gltf::meshPlacements(document_, nodeIndex, mesh.primitives.size() * instanceSize);
    gltf::PrimitiveUse use{.mesh = static_cast<size_t>(node.mesh),
                           .weights = node.weights.empty() ? mesh.weights : node.weights,
                           .skin = node.skin};
    for (use.primitive = 0; use.primitive < mesh.primitives.size(); ++use.primitive) {
      const uint32_t index = primitiveIndex(use);
      if (index == kNoIndex) continue;
      // The first primitive of a node is paid for by the node's own text.
      if (use.primitive > 0) document_.takeInstances(instanceSize, at("nodes", nodeIndex, ".mesh"));
      for (const glm::dmat4& nodeFromObject : placements) {
        const glm::dmat4 worldFromObject = worldFromNode * nodeFromObject;
        if (!isFinite(worldFromObject)) document_.fail(at("nodes", nodeIndex), "its transform is too large");
        if (isHidden(worldFromObject)) continue;
        scene_.instances.push_back({.primitive = index, .worldFromObject = worldFromObject, .name = name});
      }
    }
  }

  uint32_t primitiveIndex(const gltf::PrimitiveUse& use) {
    const auto key = std::tuple(use.mesh, use.primitive, use.weights, use.skin);
    const auto found = built_.find(key);
    return found != built_.end() ? found->second : built_[key] = addPrimitive(use);
  }

  const std::vector<glm::dmat4>& jointsOf(int skin) {
    std::vector<glm::dmat4>& joints = joints_[skin];
    if (skin >= 0 && joints.empty())
      joints = gltf::jointMatrices(document_, static_cast<size_t>(skin), tree_.fileFromNode);
    return joints;
  }

  uint32_t addPrimitive(gltf::PrimitiveUse use) {
    if (!gltf::isOfTriangles(document_, use)) return kNoIndex;
    const int material = document_.model.meshes[use.mesh].primitives[use.primitive].material;
    const uint32_t materialIndex = materials_.materialIndex(material);
    use.uvSets = materials_.uvSetsOf(material);
    std::optional<Primitive> built = gltf::buildPrimitive(document_, use, jointsOf(use.skin));
    if (!built) return kNoIndex;
    built->material = materialIndex;
    warnOfMissingUvs(*built, use);
    scene_.primitives.push_back(std::move(*built));
    return static_cast<uint32_t>(scene_.primitives.size() - 1);
  }

  void warnOfMissingUvs(const Primitive& primitive, const gltf::PrimitiveUse& use) {
    const Material& material = scene_.materials[primitive.material];
    for (const TextureUse* texture : {&material.baseColorTexture, &material.emissiveTexture}) {
      if (texture->isUsed() && primitive.uvs[texture->uvSet].empty()) {
        document_.warn("has no TEXCOORD_" + std::to_string(use.uvSets[texture->uvSet]) + " for its material's texture",
                       gltf::fieldOf(use));
      }
    }
  }

  void addCamera(const tinygltf::Node& node, const glm::dmat4& world) {
    const size_t index = static_cast<size_t>(node.camera);
    const tinygltf::Camera& source = document_.model.cameras[index];
    const tinygltf::PerspectiveCamera& lens = source.perspective;
    SceneCamera camera;
    camera.type = source.type == "perspective" ? CameraType::perspective : CameraType::orthographic;
    camera.fileIndex = static_cast<uint32_t>(index);
    camera.name = source.name.empty() ? node.name : source.name;
    camera.nodeName = node.name;
    camera.yfov = lens.yfov;
    camera.znear = lens.znear;
    if (lens.aspectRatio > 0.0) camera.aspectRatio = lens.aspectRatio;
    if (lens.zfar > 0.0) camera.zfar = lens.zfar;
    camera.worldFromCamera = world;
    scene_.cameras.push_back(std::move(camera));
  }

  void addLight(const tinygltf::Node& node, const glm::dmat4& world) {
    const tinygltf::Value& extension = node.extensions.at("KHR_lights_punctual");
    const size_t index = static_cast<size_t>(extension.Get("light").GetNumberAsInt());
    if (index >= document_.model.lights.size())
      document_.fail(at("extensions.KHR_lights_punctual.lights", index), "is missing");
    const tinygltf::Light& source = document_.model.lights[index];
    const std::string field = at("extensions.KHR_lights_punctual.lights", index);
    Light light;
    light.name = source.name.empty() ? node.name : source.name;
    if (source.type == "directional") {
      light.type = LightType::directional;
    } else if (source.type == "point") {
      light.type = LightType::point;
    } else if (source.type == "spot") {
      light.type = LightType::spot;
    } else {
      document_.fail(field + ".type", "'" + source.type + "' is none of directional, point, spot");
    }
    for (size_t c = 0; c < source.color.size() && c < 3; ++c)
      light.color[static_cast<int>(c)] = gltf::toFloat(document_, source.color[c], field + ".color");
    light.intensity = gltf::toFloat(document_, source.intensity, field + ".intensity");
    if (source.range > 0.0) light.range = gltf::toFloat(document_, source.range, field + ".range");
    light.innerConeAngle = gltf::toFloat(document_, source.spot.innerConeAngle, field + ".spot.innerConeAngle");
    light.outerConeAngle = gltf::toFloat(document_, source.spot.outerConeAngle, field + ".spot.outerConeAngle");
    const bool isConeOrdered = 0.0 <= source.spot.innerConeAngle &&
                               source.spot.innerConeAngle <= source.spot.outerConeAngle &&
                               source.spot.outerConeAngle <= kPi / 2.0 + 1e-6;
    if (light.type == LightType::spot && !isConeOrdered) {
      document_.fail(field + ".spot", "cone angles must satisfy 0 <= inner <= outer <= pi/2");
    }
    light.worldFromLight = world;
    scene_.lights.push_back(std::move(light));
  }

  Document& document_;
  glm::dmat4 worldFromFile_;
  Scene scene_;
  gltf::MaterialBuilder materials_;
  gltf::NodeTree tree_;
  std::map<int, std::vector<glm::dmat4>> joints_;  ///< By skin; none for −1.
  /// Primitive of the scene by mesh, primitive, weights and skin; kNoIndex: nothing to draw.
  std::map<std::tuple<size_t, size_t, std::vector<double>, int>, uint32_t> built_;
};

template <typename T>
void moveBehind(std::vector<T>& target, std::vector<T>& source) {
  target.insert(target.end(), std::make_move_iterator(source.begin()), std::make_move_iterator(source.end()));
}

// Appends a self-contained scene to another, with its indices shifted.
void merge(Scene& scene, Scene added) {
  const auto shift = [](uint32_t& index, size_t by) {
    if (index != kNoIndex) index += static_cast<uint32_t>(by);
  };
  for (Instance& instance : added.instances) shift(instance.primitive, scene.primitives.size());
  for (Primitive& primitive : added.primitives) shift(primitive.material, scene.materials.size());
  for (Texture& texture : added.textures) shift(texture.image, scene.images.size());
  for (Material& material : added.materials) {
    for (TextureUse* use : {&material.baseColorTexture, &material.emissiveTexture, &material.metallicRoughnessTexture,
                            &material.normalTexture, &material.occlusionTexture}) {
      shift(use->texture, scene.textures.size());
    }
  }
  moveBehind(scene.primitives, added.primitives);
  moveBehind(scene.instances, added.instances);
  moveBehind(scene.materials, added.materials);
  moveBehind(scene.textures, added.textures);
  moveBehind(scene.images, added.images);
  moveBehind(scene.cameras, added.cameras);
  moveBehind(scene.lights, added.lights);
}

[[noreturn]] void failPlacement(const char* field, const char* reason) {
  throw Error(ErrorParts{.file = {}, .field = field, .reason = reason, .remedy = {}});
}

}  // namespace

glm::dmat4 worldFromFileTransform(const FileTransform& placement) {
  const auto isFinite3 = [](const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  if (!isFinite3(placement.translation)) failPlacement("translation", "is not finite");
  if (!isFinite3(placement.scale)) failPlacement("scale", "is not finite");
  const auto matrix = gltf::fromTrs(placement.translation, placement.rotation, placement.scale);
  if (!matrix) failPlacement("rotation", "is no rotation: give a quaternion x, y, z, w other than zero");
  return *matrix;
}

std::vector<std::string> appendGltf(Scene& scene, const std::filesystem::path& path, const glm::dmat4& worldFromFile,
                                    const GltfOptions& options) {
  try {
    Document document = gltf::readDocument(path);
    merge(scene, Assembler(document, worldFromFile, options).assemble());
    return document.warnings.lines(document.file);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorParts{.file = path.string(), .field = {}, .reason = "does not fit into memory", .remedy = {}},
                ErrorKind::failed);
  } catch (const std::exception& error) {
    throw Error(ErrorParts{
        .file = path.string(), .field = {}, .reason = std::string("cannot be read: ") + error.what(), .remedy = {}});
  }
}

}  // namespace lensgraph::engine
