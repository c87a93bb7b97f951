// The members of a glTF file as a table, and the walk that checks a file against it.
//
// tinygltf silently skips optional members of a wrong type and truncates integers; this makes both an error
// with the field's name, and lets everything after it trust types and indices.
#include "engine/gltf/read/check.h"

#include <climits>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string_view>

#include "engine/error.h"

namespace lensgraph::engine::gltf {
namespace {

using Json = nlohmann::json;

enum class Kind {
  object,
  array,
  string,
  strings,
  boolean,
  number,
  numbers,
  size,
  smallInteger,
  index,
  indices,
  indexMap,
  sizeMap
};
enum class Need { optional, required };

// Path: members separated by dots; "[]" stands for every element of an array.
struct Rule {
  std::string_view path;
  Kind kind;
  std::string_view target = {};  // index, indices, indexMap: path of the array pointed into
  size_t length = 0;             // numbers: how many; 0 is any
  Need need = Need::optional;
};

constexpr Need kRequired = Need::required;

// Containers stand before their members, so that a walk may rely on them.
constexpr Rule kRules[] = {
    {"asset", Kind::object, {}, 0, kRequired},
    {"asset.version", Kind::string, {}, 0, kRequired},
    {"asset.minVersion", Kind::string},
    {"extensionsUsed", Kind::strings},
    {"extensionsRequired", Kind::strings},
    {"extensions", Kind::object},
    {"extensions.KHR_lights_punctual", Kind::object},
    {"extensions.KHR_lights_punctual.lights", Kind::array},
    {"extensions.KHR_lights_punctual.lights[]", Kind::object},
    {"extensions.KHR_lights_punctual.lights[].type", Kind::string, {}, 0, kRequired},
    {"extensions.KHR_lights_punctual.lights[].name", Kind::string},
    {"extensions.KHR_lights_punctual.lights[].color", Kind::numbers, {}, 3},
    {"extensions.KHR_lights_punctual.lights[].intensity", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].range", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].spot", Kind::object},
    {"extensions.KHR_lights_punctual.lights[].spot.innerConeAngle", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].spot.outerConeAngle", Kind::number},

    {"buffers", Kind::array},
    {"buffers[]", Kind::object},
    {"buffers[].byteLength", Kind::size, {}, 0, kRequired},
    {"buffers[].uri", Kind::string},
    {"bufferViews", Kind::array},
    {"bufferViews[]", Kind::object},
    {"bufferViews[].buffer", Kind::index, "buffers", 0, kRequired},
    {"bufferViews[].byteOffset", Kind::size},
    {"bufferViews[].byteLength", Kind::size, {}, 0, kRequired},
    {"bufferViews[].byteStride", Kind::size},
    {"bufferViews[].extensions", Kind::object},
    {"accessors", Kind::array},
    {"accessors[]", Kind::object},
    {"accessors[].bufferView", Kind::index, "bufferViews"},
    {"accessors[].byteOffset", Kind::size},
    {"accessors[].componentType", Kind::smallInteger, {}, 0, kRequired},
    {"accessors[].count", Kind::size, {}, 0, kRequired},
    {"accessors[].type", Kind::string, {}, 0, kRequired},
    {"accessors[].normalized", Kind::boolean},
    {"accessors[].sparse", Kind::object},
    {"accessors[].sparse.count", Kind::smallInteger, {}, 0, kRequired},
    {"accessors[].sparse.indices", Kind::object, {}, 0, kRequired},
    {"accessors[].sparse.indices.bufferView", Kind::index, "bufferViews", 0, kRequired},
    {"accessors[].sparse.indices.byteOffset", Kind::smallInteger},
    {"accessors[].sparse.indices.componentType", Kind::smallInteger, {}, 0, kRequired},
    {"accessors[].sparse.values", Kind::object, {}, 0, kRequired},
    {"accessors[].sparse.values.bufferView", Kind::index, "bufferViews", 0, kRequired},
    {"accessors[].sparse.values.byteOffset", Kind::smallInteger},

    {"images", Kind::array},
    {"images[]", Kind::object},
    {"images[].uri", Kind::string},
    {"images[].bufferView", Kind::index, "bufferViews"},
    {"images[].name", Kind::string},
    {"samplers", Kind::array},
    {"samplers[]", Kind::object},
    {"samplers[].magFilter", Kind::smallInteger},
    {"samplers[].minFilter", Kind::smallInteger},
    {"samplers[].wrapS", Kind::smallInteger},
    {"samplers[].wrapT", Kind::smallInteger},
    {"textures", Kind::array},
    {"textures[]", Kind::object},
    {"textures[].sampler", Kind::index, "samplers"},
    {"textures[].source", Kind::index, "images"},
    {"textures[].extensions", Kind::object},

    {"materials", Kind::array},
    {"materials[]", Kind::object},
    {"materials[].name", Kind::string},
    {"materials[].alphaMode", Kind::string},
    {"materials[].alphaCutoff", Kind::number},
    {"materials[].doubleSided", Kind::boolean},
    {"materials[].emissiveFactor", Kind::numbers, {}, 3},
    {"materials[].pbrMetallicRoughness", Kind::object},
    {"materials[].pbrMetallicRoughness.baseColorFactor", Kind::numbers, {}, 4},
    {"materials[].pbrMetallicRoughness.metallicFactor", Kind::number},
    {"materials[].pbrMetallicRoughness.roughnessFactor", Kind::number},
    {"materials[].normalTexture.scale", Kind::number},
    {"materials[].occlusionTexture.strength", Kind::number},
    {"materials[].extensions", Kind::object},
    {"materials[].extensions.KHR_materials_unlit", Kind::object},
    {"materials[].extensions.KHR_materials_emissive_strength", Kind::object},
    {"materials[].extensions.KHR_materials_emissive_strength.emissiveStrength", Kind::number},
    {"materials[].extensions.KHR_materials_transmission", Kind::object},
    {"materials[].extensions.KHR_materials_transmission.transmissionFactor", Kind::number},

    {"meshes", Kind::array},
    {"meshes[]", Kind::object},
    {"meshes[].name", Kind::string},
    {"meshes[].weights", Kind::numbers},
    {"meshes[].primitives", Kind::array, {}, 0, kRequired},
    {"meshes[].primitives[]", Kind::object},
    {"meshes[].primitives[].attributes", Kind::indexMap, "accessors", 0, kRequired},
    {"meshes[].primitives[].indices", Kind::index, "accessors"},
    {"meshes[].primitives[].material", Kind::index, "materials"},
    {"meshes[].primitives[].mode", Kind::smallInteger},
    {"meshes[].primitives[].targets", Kind::array},
    {"meshes[].primitives[].targets[]", Kind::indexMap, "accessors"},
    {"meshes[].primitives[].extensions", Kind::object},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression", Kind::object},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.bufferView", Kind::index, "bufferViews", 0,
     kRequired},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes", Kind::sizeMap, {}, 0, kRequired},

    {"cameras", Kind::array},
    {"cameras[]", Kind::object},
    {"cameras[].name", Kind::string},
    {"cameras[].type", Kind::string, {}, 0, kRequired},
    {"cameras[].perspective", Kind::object},
    {"cameras[].perspective.yfov", Kind::number, {}, 0, kRequired},
    {"cameras[].perspective.znear", Kind::number, {}, 0, kRequired},
    {"cameras[].perspective.aspectRatio", Kind::number},
    {"cameras[].perspective.zfar", Kind::number},
    {"cameras[].orthographic", Kind::object},

    {"nodes", Kind::array},
    {"nodes[]", Kind::object},
    {"nodes[].name", Kind::string},
    {"nodes[].children", Kind::indices, "nodes"},
    {"nodes[].mesh", Kind::index, "meshes"},
    {"nodes[].camera", Kind::index, "cameras"},
    {"nodes[].skin", Kind::index, "skins"},
    {"nodes[].matrix", Kind::numbers, {}, 16},
    {"nodes[].translation", Kind::numbers, {}, 3},
    {"nodes[].rotation", Kind::numbers, {}, 4},
    {"nodes[].scale", Kind::numbers, {}, 3},
    {"nodes[].weights", Kind::numbers},
    {"nodes[].extensions", Kind::object},
    {"nodes[].extensions.KHR_lights_punctual", Kind::object},
    {"nodes[].extensions.KHR_lights_punctual.light", Kind::index, "extensions.KHR_lights_punctual.lights", 0,
     kRequired},
    {"nodes[].extensions.KHR_node_visibility", Kind::object},
    {"nodes[].extensions.KHR_node_visibility.visible", Kind::boolean},
    {"nodes[].extensions.EXT_mesh_gpu_instancing", Kind::object},
    {"nodes[].extensions.EXT_mesh_gpu_instancing.attributes", Kind::indexMap, "accessors", 0, kRequired},
    {"skins", Kind::array},
    {"skins[]", Kind::object},
    {"skins[].joints", Kind::indices, "nodes", 0, kRequired},
    {"skins[].inverseBindMatrices", Kind::index, "accessors"},
    {"skins[].skeleton", Kind::index, "nodes"},
    {"scenes", Kind::array},
    {"scenes[]", Kind::object},
    {"scenes[].nodes", Kind::indices, "nodes"},
    {"scene", Kind::index, "scenes"},
};

// A texture reference stands at five places of a material with the same members.
constexpr std::string_view kTextureInfos[] = {
    "materials[].pbrMetallicRoughness.baseColorTexture",
    "materials[].pbrMetallicRoughness.metallicRoughnessTexture",
    "materials[].normalTexture",
    "materials[].occlusionTexture",
    "materials[].emissiveTexture",
};
constexpr Rule kTextureInfoRules[] = {
    {"", Kind::object},
    {".index", Kind::index, "textures", 0, kRequired},
    {".texCoord", Kind::smallInteger},
    {".extensions", Kind::object},
    {".extensions.KHR_texture_transform", Kind::object},
    {".extensions.KHR_texture_transform.offset", Kind::numbers, {}, 2},
    {".extensions.KHR_texture_transform.scale", Kind::numbers, {}, 2},
    {".extensions.KHR_texture_transform.rotation", Kind::number},
    {".extensions.KHR_texture_transform.texCoord", Kind::smallInteger},
};

// Two extensions that hold the same at the same place.
constexpr std::string_view kMeshoptExtensions[] = {
    "bufferViews[].extensions.EXT_meshopt_compression",
    "bufferViews[].extensions.KHR_meshopt_compression",
};
constexpr Rule kMeshoptRules[] = {
    {"", Kind::object},
    {".buffer", Kind::index, "buffers", 0, kRequired},
    {".byteOffset", Kind::size},
    {".byteLength", Kind::size, {}, 0, kRequired},
    {".byteStride", Kind::size, {}, 0, kRequired},
    {".count", Kind::size, {}, 0, kRequired},
    {".mode", Kind::string, {}, 0, kRequired},
    {".filter", Kind::string},
};

class Checker {
 public:
  Checker(Json& root, const std::string& file) : root_(root), file_(file) {}

  void check(const Rule& rule) { walk(root_, rule.path, "", rule); }

  /// Each rule at each place; the rules' paths begin there.
  void check(std::span<const Rule> rules, std::span<const std::string_view> places) {
    for (std::string_view place : places) {
      for (Rule rule : rules) {
        const std::string path = std::string(place) + std::string(rule.path);
        rule.path = path;
        check(rule);
      }
    }
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& reason) const {
    throw Error(ErrorParts{.file = file_, .field = field, .reason = reason, .remedy = {}});
  }

  // `path` is what is left of the rule's path below `value`.
  void walk(Json& value, std::string_view path, const std::string& field, const Rule& rule) {
    if (path.empty()) return checkValue(value, field, rule);
    if (path.starts_with("[]")) {
      if (!value.is_array()) return;  // reported by the array's own rule
      for (size_t i = 0; i < value.size(); ++i)
        walk(value[i], path.substr(2), field + "[" + std::to_string(i) + "]", rule);
      return;
    }
    if (path.starts_with('.')) path.remove_prefix(1);
    const std::string name(path.substr(0, path.find_first_of(".[")));
    const std::string_view rest = path.substr(name.size());
    const std::string memberField = field.empty() ? name : field + "." + name;
    if (!value.is_object()) return;  // reported by the object's own rule
    const auto member = value.find(name);
    if (member != value.end()) return walk(*member, rest, memberField, rule);
    if (rest.empty() && rule.need == Need::required) fail(memberField, "is missing");
  }

  void checkValue(Json& value, const std::string& field, const Rule& rule) {
    switch (rule.kind) {
      case Kind::object:
        return require(value.is_object(), field, "is not an object");
      case Kind::array:
        return require(value.is_array(), field, "is not an array");
      case Kind::string:
        return require(value.is_string(), field, "is not a string");
      case Kind::boolean:
        return require(value.is_boolean(), field, "is not true or false");
      case Kind::number:
        return require(value.is_number(), field, "is not a number");
      case Kind::size:
        checkSize(value, field);
        return;
      case Kind::smallInteger:
        // tinygltf keeps these as int and drops what does not fit.
        if (checkSize(value, field) > INT_MAX) fail(field, "is " + value.dump() + ", too large");
        return;
      case Kind::index:
        return checkIndex(value, field, rule.target);
      case Kind::strings:
      case Kind::numbers:
      case Kind::indices:
        return checkArray(value, field, rule);
      case Kind::indexMap:
      case Kind::sizeMap:
        require(value.is_object(), field, "is not an object");
        for (auto& [name, number] : value.items()) {
          if (rule.kind == Kind::indexMap) checkIndex(number, field + "." + name, rule.target);
          if (rule.kind == Kind::sizeMap) checkSize(number, field + "." + name);
        }
        return;
    }
  }

  void checkArray(Json& value, const std::string& field, const Rule& rule) {
    require(value.is_array(), field, "is not an array");
    if (rule.length != 0 && value.size() != rule.length) {
      fail(field, "has " + std::to_string(value.size()) + " elements instead of " + std::to_string(rule.length));
    }
    for (size_t i = 0; i < value.size(); ++i) {
      const std::string element = field + "[" + std::to_string(i) + "]";
      if (rule.kind == Kind::strings) require(value[i].is_string(), element, "is not a string");
      if (rule.kind == Kind::numbers) require(value[i].is_number(), element, "is not a number");
      if (rule.kind == Kind::indices) checkIndex(value[i], element, rule.target);
    }
  }

  void require(bool isFulfilled, const std::string& field, const char* reason) const {
    if (!isFulfilled) fail(field, reason);
  }

  // Any length or count in bytes is below 2^53, the largest integer that every JSON writer keeps.
  uint64_t checkSize(Json& value, const std::string& field) const {
    constexpr double kLargest = 9007199254740992.0;
    if (value.is_number_float()) {
      const double number = value.get<double>();
      if (number >= 0.0 && number <= kLargest && number == static_cast<double>(static_cast<uint64_t>(number))) {
        value = static_cast<uint64_t>(number);
      }
    }
    if (!value.is_number_unsigned()) fail(field, "is " + value.dump().substr(0, 40) + ", not an integer from 0");
    const uint64_t number = value.get<uint64_t>();
    if (static_cast<double>(number) > kLargest) fail(field, "is " + std::to_string(number) + ", beyond every file");
    return number;
  }

  void checkIndex(Json& value, const std::string& field, std::string_view target) const {
    const uint64_t index = checkSize(value, field);
    const size_t count = arraySize(target);
    if (index < count && index <= INT_MAX) return;
    fail(field, "index " + std::to_string(index) + " is out of range: " + std::string(target) + " has " +
                    std::to_string(count) + (count == 1 ? " element" : " elements"));
  }

  size_t arraySize(std::string_view path) const {
    const Json* value = &root_;
    while (!path.empty()) {
      const std::string name(path.substr(0, path.find('.')));
      path.remove_prefix(std::min(path.size(), name.size() + 1));
      if (!value->is_object()) return 0;
      const auto member = value->find(name);
      if (member == value->end()) return 0;
      value = &*member;
    }
    return value->is_array() ? value->size() : 0;
  }

  Json& root_;
  const std::string& file_;
};

}  // namespace

void checkStructure(Json& root, const std::string& file) {
  if (!root.is_object()) {
    throw Error(
        ErrorParts{.file = file, .field = {}, .reason = "is not a glTF file: its JSON is no object", .remedy = {}});
  }
  Checker checker(root, file);
  for (const Rule& rule : kRules) checker.check(rule);
  checker.check(kTextureInfoRules, kTextureInfos);
  checker.check(kMeshoptRules, kMeshoptExtensions);
}

void dropUnusedCameras(Json& root) {
  if (!root.is_object()) return;
  const auto cameras = root.find("cameras");
  const auto nodes = root.find("nodes");
  if (cameras == root.end() || !cameras->is_array()) return;
  std::set<Json> used;
  if (nodes != root.end() && nodes->is_array()) {
    for (const Json& node : *nodes) {
      if (node.is_object() && node.contains("camera")) used.insert(node["camera"]);
    }
  }
  for (size_t i = 0; i < cameras->size(); ++i) {
    if (!used.contains(Json(i)))
      (*cameras)[i] = {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}};
  }
}

}  // namespace lensgraph::engine::gltf
