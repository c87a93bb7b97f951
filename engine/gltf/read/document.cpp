// From a file's bytes to a checked document: container, JSON, version, extensions.
//
// tinygltf gets only JSON that has been checked, without buffers, views, accessors, images and animations. Its own
// handling of those reads past the end of truncated .glb files, forms pointers outside buffers for image views, refuses
// external buffers longer than byteLength and indices without a buffer view (both legal), and turns '+' in file names
// into blanks; so they are read here.
#include "engine/gltf/read/document.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/error.h"
#include "engine/gltf/read/check.h"
#include "engine/gltf/read/container.h"
#include "engine/gltf/read/json_text.h"
#include "engine/gltf/read/uri.h"

namespace lensgraph::engine::gltf {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// A .glb cannot be longer.
constexpr uint64_t kMaxFileBytes = uint64_t{1} << 32;

// Bytes of the names of nodes, meshes and others.
constexpr size_t kMaxName = 200;

constexpr std::string_view kReadExtensions[] = {
    "EXT_mesh_gpu_instancing", "EXT_meshopt_compression",         "KHR_draco_mesh_compression",
    "KHR_lights_punctual",     "KHR_materials_emissive_strength", "KHR_materials_transmission",
    "KHR_materials_unlit",     "KHR_mesh_quantization",           "KHR_meshopt_compression",
    "KHR_node_visibility",     "KHR_texture_transform",
};
// Part of what KHR_materials_transmission says; without it glass is drawn thin.
constexpr std::string_view kVolume = "KHR_materials_volume";
// Not read, but named when a texture has nothing else.
constexpr std::string_view kTextureExtensions[] = {
    "EXT_texture_avif",
    "EXT_texture_webp",
    "KHR_texture_basisu",
    "MSFT_texture_dds",
};

template <typename Names>
bool contains(const Names& names, std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

// ---- Version

void failIfVersion1(const Source& source, const Json& root) {
  const Json asset = root.is_object() ? root.value("asset", Json()) : Json();
  const Json version = asset.is_object() ? asset.value("version", Json()) : Json();
  const std::string text = version.is_string() ? version.get<std::string>() : version.dump();
  if (text.starts_with("2.")) return;
  // glTF 1.0 keeps by name what glTF 2.0 numbers; its asset and version may be left out.
  const auto isByName = [&](const char* member) { return root.is_object() && root.value(member, Json()).is_object(); };
  if (text == "1" || text.starts_with("1.") || isByName("meshes") || isByName("accessors") || isByName("buffers"))
    failVersion1(source);
}

// "2.1" as 2, 1. None for what is no version.
std::optional<std::pair<int, int>> versionOf(const std::string& text) {
  int major = 0, minor = 0, length = 0;
  if (text.size() > 20 || std::sscanf(text.c_str(), "%9d.%9d%n", &major, &minor, &length) != 2) return std::nullopt;
  if (static_cast<size_t>(length) != text.size() || major < 0 || minor < 0) return std::nullopt;
  return std::pair(major, minor);
}

void checkVersion(const Source& source, const Json& asset) {
  const std::string version = asset["version"].get<std::string>();
  if (version != "2" && !version.starts_with("2."))
    source.fail("asset.version", "glTF " + version + " is not read", "convert it to glTF 2.0");
  if (!asset.contains("minVersion")) return;
  const std::string least = asset["minVersion"].get<std::string>();
  const auto number = versionOf(least);
  if (!number) source.fail("asset.minVersion", "'" + least + "' is no version such as 2.0");
  if (*number > std::pair(2, 0))
    source.fail("asset.minVersion", "needs glTF " + least + ", only 2.0 is read", "export as glTF 2.0");
}

// ---- Extensions

void checkExtensions(const Source& source, const Json& root, Warnings& warnings) {
  std::string unread;
  for (const Json& name : root.value("extensionsRequired", Json::array())) {
    const std::string& text = name.get_ref<const std::string&>();
    if (!contains(kReadExtensions, text) && text != kVolume) unread += (unread.empty() ? "" : ", ") + text;
  }
  if (!unread.empty())
    source.fail("extensionsRequired", "needs " + unread + ", which is not supported", "export without it");
  for (const Json& name : root.value("extensionsUsed", Json::array())) {
    const std::string& text = name.get_ref<const std::string&>();
    if (!contains(kReadExtensions, text)) warnings.add("extension " + text + " is ignored");
  }
}

// Takes out what nothing reads, so that tinygltf does not parse it either, and shortens names: each instance has a copy.
void dropUnread(Json& value) {
  if (value.is_object()) {
    value.erase("extras");
    if (const auto name = value.find("name"); name != value.end() && name->is_string()) {
      std::string& text = name->get_ref<std::string&>();
      if (text.size() > kMaxName) text = asLine(text, kMaxName);
    }
    if (const auto extensions = value.find("extensions"); extensions != value.end() && extensions->is_object()) {
      for (auto member = extensions->begin(); member != extensions->end();) {
        const bool isKnown = contains(kReadExtensions, member.key()) || contains(kTextureExtensions, member.key());
        member = isKnown ? std::next(member) : extensions->erase(member);
      }
    }
  }
  if (value.is_structured()) {
    for (Json& member : value) dropUnread(member);
  }
}

// ---- Parts that tinygltf does not get

int accessorTypeOf(const std::string& name) {
  constexpr std::pair<std::string_view, int> kTypes[] = {{"SCALAR", TINYGLTF_TYPE_SCALAR}, {"VEC2", TINYGLTF_TYPE_VEC2},
                                                         {"VEC3", TINYGLTF_TYPE_VEC3},     {"VEC4", TINYGLTF_TYPE_VEC4},
                                                         {"MAT2", TINYGLTF_TYPE_MAT2},     {"MAT3", TINYGLTF_TYPE_MAT3},
                                                         {"MAT4", TINYGLTF_TYPE_MAT4}};
  const auto found = std::find_if(std::begin(kTypes), std::end(kTypes), [&](const auto& t) { return t.first == name; });
  return found == std::end(kTypes) ? -1 : found->second;
}

tinygltf::Accessor accessorFrom(const Json& from) {
  tinygltf::Accessor accessor;
  accessor.bufferView = from.value("bufferView", -1);
  accessor.byteOffset = from.value("byteOffset", size_t{0});
  accessor.normalized = from.value("normalized", false);
  accessor.componentType = from["componentType"].get<int>();
  accessor.count = from["count"].get<size_t>();
  accessor.type = accessorTypeOf(from["type"].get<std::string>());
  const auto sparse = from.find("sparse");
  accessor.sparse.isSparse = sparse != from.end();
  if (accessor.sparse.isSparse) {
    const Json &indices = (*sparse)["indices"], &values = (*sparse)["values"];
    accessor.sparse.count = (*sparse)["count"].get<int>();
    accessor.sparse.indices.bufferView = indices["bufferView"].get<int>();
    accessor.sparse.indices.byteOffset = indices.value("byteOffset", 0);
    accessor.sparse.indices.componentType = indices["componentType"].get<int>();
    accessor.sparse.values.bufferView = values["bufferView"].get<int>();
    accessor.sparse.values.byteOffset = values.value("byteOffset", 0);
  }
  return accessor;
}

tinygltf::Image imageFrom(Json& from) {
  tinygltf::Image image;
  image.name = from.value("name", std::string());
  if (from.contains("uri")) image.uri = std::move(from["uri"].get_ref<std::string&>());
  image.bufferView = from.value("bufferView", -1);
  return image;
}

// Accessors, images and the indices of primitives, taken out of the JSON.
struct Taken {
  std::vector<tinygltf::Accessor> accessors;
  std::vector<tinygltf::Image> images;
  std::vector<std::vector<int>> indices;  ///< By mesh and primitive.
};

Taken takeOut(Json& root) {
  Taken taken;
  // Absent arrays become null, which has no elements.
  for (const Json& from : root["accessors"]) taken.accessors.push_back(accessorFrom(from));
  for (Json& from : root["images"]) taken.images.push_back(imageFrom(from));
  if (!root.contains("meshes")) root["meshes"] = Json::array();
  for (Json& mesh : root["meshes"]) {
    std::vector<int>& indices = taken.indices.emplace_back();
    for (Json& primitive : mesh["primitives"]) {
      indices.push_back(primitive.value("indices", -1));
      primitive.erase("indices");
    }
  }
  for (const char* member : {"accessors", "images", "animations"}) root.erase(member);
  return taken;
}

tinygltf::Model modelFrom(const Source& source, Json root) {
  Taken taken = takeOut(root);
  const std::string text = root.dump();
  root = nullptr;  // of use no more, and larger than the text
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string errors, warnings;
  const bool isRead = loader.LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                                 static_cast<unsigned>(text.size()), "", tinygltf::NO_REQUIRE);
  if (!isRead || model.meshes.size() != taken.indices.size()) source.fail("", "is not valid glTF: " + errors);
  for (size_t m = 0; m < model.meshes.size(); ++m) {
    std::vector<tinygltf::Primitive>& primitives = model.meshes[m].primitives;
    if (primitives.size() != taken.indices[m].size()) source.fail(at("meshes", m), "is not valid glTF: " + errors);
    for (size_t p = 0; p < primitives.size(); ++p) primitives[p].indices = taken.indices[m][p];
  }
  model.accessors = std::move(taken.accessors);
  model.images = std::move(taken.images);
  return model;
}

}  // namespace

void Document::takeMemory(uint64_t loaded, uint64_t stored, const std::string& field) {
  if (memory_.take(loaded, stored, bytesHeld())) return;
  fail(field,
       "asks for more geometry than the file holds: what is repeated or all zeros may take " +
           std::to_string(MemoryLimit::repeatedLimit(bytesHeld()) / 1'000'000) + " MB",
       "place a mesh by several nodes instead of repeating its geometry");
}

void Document::takeInstances(uint64_t bytes, const std::string& field) {
  instanceBytes_ += bytes;
  const uint64_t limit = kInstanceBase + kInstanceBytes * bytesHeld();
  if (instanceBytes_ > limit) {
    fail(field,
         "brings the file's instances to more than the " + std::to_string(limit / 1'000'000) +
             " MB that a file of this size may take",
         "join the primitives of meshes that many nodes place");
  }
}

void Document::addDecoded(int bufferView, uint64_t bytes, const std::string& field) {
  if (!decodedViews_.insert(bufferView).second) return;
  bytesDecoded_ += bytes;
  const uint64_t limit = kDecodedBase + kDecodedBytes * buffers.bytesRead();
  if (bytesDecoded_ > limit) {
    fail(field, "brings the geometry of compressed streams to " + std::to_string(bytesDecoded_) +
                    " bytes, more than the " + std::to_string(limit) + " that a file of this size may hold");
  }
}

Document readDocument(const fs::path& path) {
  Source source{.file = path.string(), .folder = path.parent_path()};
  std::string reason;
  const auto bytes = fileBytes(path, kMaxFileBytes, reason);
  if (!bytes) source.fail("", reason);

  const Container container = splitContainer(source, *bytes);
  Json root = parseJson(source, container.json);
  failIfVersion1(source, root);
  dropUnusedCameras(root);
  checkStructure(root, source.file);
  checkVersion(source, root["asset"]);
  Warnings warnings;
  checkExtensions(source, root, warnings);
  if (!root.value("animations", Json::array()).empty()) warnings.add("animations are ignored, the rest pose is drawn");
  dropUnread(root);

  std::optional<std::vector<uint8_t>> binary;
  if (container.binary) binary.emplace(container.binary->begin(), container.binary->end());
  Buffers buffers(source, root, std::move(binary));
  Document document(source, modelFrom(source, std::move(root)), std::move(buffers));
  document.warnings = std::move(warnings);
  return document;
}

float toFloat(const Source& source, double value, const std::string& field) {
  if (!(std::fabs(value) <= double{std::numeric_limits<float>::max()})) source.fail(field, "is too large");
  return static_cast<float>(value);
}

}  // namespace lensgraph::engine::gltf
