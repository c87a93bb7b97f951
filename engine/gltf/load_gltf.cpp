// Walks the node tree of a glTF file and assembles the scene: instances, cameras, lights.
#include "engine/gltf/load_gltf.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <new>

#include "engine/error.h"
#include "engine/gltf/internal.h"

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

// T · R · S; none when the quaternion has no direction.
std::optional<glm::dmat4> fromTrs(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale) {
  const double length = glm::length(rotation);
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  const glm::dvec4 q = rotation / length;
  glm::dmat4 matrix = glm::mat4_cast(glm::dquat(q.w, q.x, q.y, q.z));
  for (int axis = 0; axis < 3; ++axis) matrix[axis] *= scale[axis];
  matrix[3] = glm::dvec4(translation, 1.0);
  return matrix;
}

glm::dmat4 parentFromNode(const Document& document, size_t index) {
  const tinygltf::Node& node = document.model.nodes[index];
  if (!node.matrix.empty()) {
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
    return matrix;
  }
  const auto vec3Of = [](const std::vector<double>& v, double otherwise) {
    return v.empty() ? glm::dvec3(otherwise) : glm::dvec3(v[0], v[1], v[2]);
  };
  const std::vector<double>& r = node.rotation;
  const glm::dvec4 rotation = r.empty() ? glm::dvec4(0.0, 0.0, 0.0, 1.0) : glm::dvec4(r[0], r[1], r[2], r[3]);
  const auto matrix = fromTrs(vec3Of(node.translation, 0.0), rotation, vec3Of(node.scale, 1.0));
  if (!matrix) document.fail(at("nodes", index, ".rotation"), "is no rotation: the quaternion has length 0");
  return *matrix;
}

// Scale 0 on all axes is the usual way to hide a node (glTF 2.0 §3.5.2).
bool isHidden(const glm::dmat4& m) {
  return glm::dvec3(m[0]) == glm::dvec3(0.0) && glm::dvec3(m[1]) == glm::dvec3(0.0) &&
         glm::dvec3(m[2]) == glm::dvec3(0.0);
}

class Assembler {
 public:
  Assembler(Document& document, const glm::dmat4& worldFromFile, const GltfOptions& options)
      : document_(document), worldFromFile_(worldFromFile), materials_(document, scene_, options.loadShadingTextures) {}

  Scene assemble() {
    placeNodes();
    for (size_t index : drawn_) {
      const tinygltf::Node& node = document_.model.nodes[index];
      const glm::dmat4 world = worldFromFile_ * fileFromNode_[index];
      if (node.camera >= 0) addCamera(node, world);
      const bool isDrawn = node.mesh >= 0 || node.extensions.contains("KHR_lights_punctual");
      if (isDrawn && !isFinite(world)) document_.fail(at("nodes", index), "its transform is too large");
      if (node.mesh >= 0 && !isHidden(world)) addMesh(index, node, world);
      if (node.extensions.contains("KHR_lights_punctual")) addLight(node, world);
    }
    std::ranges::stable_sort(scene_.cameras, {}, &SceneCamera::fileIndex);
    return std::move(scene_);
  }

 private:
  // The roots of the scene to draw, checked to be nodes of a tree by the walk.
  std::vector<int> rootNodes() const {
    const tinygltf::Model& model = document_.model;
    if (!model.scenes.empty()) {
      return model.scenes[static_cast<size_t>(std::max(model.defaultScene, 0))].nodes;
    }
    std::vector<bool> isChild(model.nodes.size());
    for (const tinygltf::Node& node : model.nodes) {
      for (int child : node.children) isChild[static_cast<size_t>(child)] = true;
    }
    std::vector<int> roots;
    for (size_t i = 0; i < model.nodes.size(); ++i) {
      if (!isChild[i]) roots.push_back(static_cast<int>(i));
    }
    return roots;
  }

  // Fills fileFromNode_ and drawn_, parents before children. A stack of its own: files may nest nodes deeper
  // than ours.
  void placeNodes() {
    const tinygltf::Model& model = document_.model;
    fileFromNode_.assign(model.nodes.size(), glm::dmat4(1.0));
    std::vector<bool> isVisited(model.nodes.size());
    struct Entry {
      int node;
      glm::dmat4 fileFromParent;
    };
    std::vector<Entry> stack;
    const auto push = [&](const std::vector<int>& nodes, const glm::dmat4& fileFromParent) {
      for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) stack.push_back({*node, fileFromParent});
    };
    push(rootNodes(), glm::dmat4(1.0));
    while (!stack.empty()) {
      const Entry entry = stack.back();
      stack.pop_back();
      const size_t index = static_cast<size_t>(entry.node);
      if (isVisited[index]) document_.fail(at("nodes", index), "is reached twice: nodes must form a tree, not a cycle");
      isVisited[index] = true;
      fileFromNode_[index] = entry.fileFromParent * parentFromNode(document_, index);
      drawn_.push_back(index);
      push(model.nodes[index].children, fileFromNode_[index]);
    }
  }

  void addMesh(size_t nodeIndex, const tinygltf::Node& node, const glm::dmat4& world) {
    const size_t mesh = static_cast<size_t>(node.mesh);
    const std::vector<tinygltf::Primitive>& primitives = document_.model.meshes[mesh].primitives;
    if (node.skin >= 0) document_.warn("skins are drawn in their rest pose");
    for (size_t i = 0; i < primitives.size(); ++i) {
      uint32_t index = kNoIndex;
      const auto key = std::pair(mesh, i);
      if (const auto found = built_.find(key); found != built_.end() && node.skin < 0) {
        index = found->second;
      } else {
        index = addPrimitive(mesh, i, node.skin);
        if (node.skin < 0) built_.emplace(key, index);
      }
      if (index == kNoIndex) continue;
      // A skinned mesh stands where its joints are; its node's transform does not count (glTF 2.0 §3.7.3.3).
      const glm::dmat4& worldFromObject = node.skin >= 0 ? worldFromFile_ : world;
      const std::string name = node.name.empty() ? at("nodes", nodeIndex) : node.name;
      scene_.instances.push_back({.primitive = index, .worldFromObject = worldFromObject, .name = name});
    }
  }

  uint32_t addPrimitive(size_t mesh, size_t primitive, int skin) {
    std::optional<Primitive> built = gltf::buildPrimitive(document_, mesh, primitive);
    if (!built) return kNoIndex;
    if (skin >= 0) gltf::applyRestPose(document_, mesh, primitive, skin, fileFromNode_, *built);
    if (built->normals.empty()) computeFlatNormals(*built);
    const tinygltf::Primitive& source = document_.model.meshes[mesh].primitives[primitive];
    built->material = materials_.materialIndex(source.material);
    warnOfMissingUvs(*built);
    scene_.primitives.push_back(std::move(*built));
    return static_cast<uint32_t>(scene_.primitives.size() - 1);
  }

  void warnOfMissingUvs(const Primitive& primitive) {
    const Material& material = scene_.materials[primitive.material];
    for (const TextureUse* use : {&material.baseColorTexture, &material.emissiveTexture}) {
      if (use->isUsed() && primitive.uvs[use->uvSet].empty()) {
        document_.warn("'" + primitive.name + "' has no TEXCOORD_" + std::to_string(use->uvSet) +
                       " for its material's texture");
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
                               source.spot.innerConeAngle < source.spot.outerConeAngle &&
                               source.spot.outerConeAngle <= kPi / 2.0 + 1e-6;
    if (light.type == LightType::spot && !isConeOrdered) {
      document_.fail(field + ".spot", "cone angles must satisfy 0 <= inner < outer <= pi/2");
    }
    light.worldFromLight = world;
    scene_.lights.push_back(std::move(light));
  }

  Document& document_;
  glm::dmat4 worldFromFile_;
  Scene scene_;
  gltf::MaterialBuilder materials_;
  std::vector<glm::dmat4> fileFromNode_;  ///< By node; only those in drawn_ count.
  std::vector<size_t> drawn_;             ///< Nodes of the scene, parents first.
  std::map<std::pair<size_t, size_t>, uint32_t>
      built_;  ///< Primitive by mesh and primitive; kNoIndex: nothing to draw.
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
  const auto matrix = fromTrs(placement.translation, placement.rotation, placement.scale);
  if (!matrix) failPlacement("rotation", "is no rotation: give a quaternion x, y, z, w other than zero");
  return *matrix;
}

std::vector<std::string> appendGltf(Scene& scene, const std::filesystem::path& path, const glm::dmat4& worldFromFile,
                                    const GltfOptions& options) {
  try {
    Document document = gltf::readDocument(path);
    merge(scene, Assembler(document, worldFromFile, options).assemble());
    return std::move(document.warnings);
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
