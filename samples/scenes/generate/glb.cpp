// The glTF writer; see glb.h. Numbers in quotes below are glTF 2.0's own constants, named where they stand.
#include "generate/glb.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <stdexcept>

namespace scenes {
namespace {

constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr size_t kLargest16BitIndex = 65534;  // 65535 is primitive restart.

static_assert(std::endian::native == std::endian::little, "glTF is little-endian; bytes are written as they lie");

size_t push(Json& root, const char* array, Json value) {
  root[array].push_back(std::move(value));
  return root[array].size() - 1;
}

Json toJson(glm::vec3 value) {
  return {value.x, value.y, value.z};
}
Json toJson(const glm::quat& value) {
  return {value.x, value.y, value.z, value.w};
}

/// Rotation of something that looks down its −Z with +Y as far up as it can be.
glm::quat lookingAlong(glm::vec3 direction) {
  direction = glm::normalize(direction);
  const glm::vec3 up = std::abs(direction.y) < 0.999f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -1);
  return glm::normalize(glm::quatLookAt(direction, up));
}

void append32(std::vector<uint8_t>& bytes, uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<uint8_t>(value >> shift));
}

}  // namespace

size_t Glb::addView(const void* data, size_t size, int target) {
  while (binary_.size() % 4 != 0) binary_.push_back(0);
  const size_t offset = binary_.size();
  binary_.resize(offset + size);
  std::memcpy(binary_.data() + offset, data, size);
  Json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}};
  if (target != 0) view["target"] = target;
  return push(root_, "bufferViews", std::move(view));
}

size_t Glb::addFloats(const std::vector<float>& values, int components, bool bounds) {
  const auto width = static_cast<size_t>(components);
  Json accessor = {{"bufferView", addView(values.data(), values.size() * sizeof(float), kArrayBuffer)},
                   {"componentType", kFloat},
                   {"count", values.size() / width},
                   {"type", components == 2 ? "VEC2" : "VEC3"}};
  if (bounds) {
    std::vector<float> low(width, std::numeric_limits<float>::max());
    std::vector<float> high(width, std::numeric_limits<float>::lowest());
    for (size_t i = 0; i < values.size(); ++i) {
      low[i % width] = std::min(low[i % width], values[i]);
      high[i % width] = std::max(high[i % width], values[i]);
    }
    accessor["min"] = low;
    accessor["max"] = high;
  }
  return push(root_, "accessors", std::move(accessor));
}

size_t Glb::addColors(const Mesh& mesh) {
  std::vector<uint16_t> values;
  for (const Vertex& vertex : mesh.vertices) {
    for (int c = 0; c < 4; ++c) {
      values.push_back(static_cast<uint16_t>(std::lround(std::clamp(vertex.color[c], 0.0f, 1.0f) * 65535.0f)));
    }
  }
  return push(root_, "accessors",
              {{"bufferView", addView(values.data(), values.size() * sizeof(uint16_t), kArrayBuffer)},
               {"componentType", kUnsignedShort},
               {"normalized", true},
               {"count", mesh.vertices.size()},
               {"type", "VEC4"}});
}

size_t Glb::addIndices(const Mesh& mesh) {
  const bool small = mesh.vertices.size() <= kLargest16BitIndex + 1;
  const std::vector<uint16_t> narrow(mesh.indices.begin(), mesh.indices.end());
  const size_t view = small ? addView(narrow.data(), narrow.size() * sizeof(uint16_t), kElementArrayBuffer)
                            : addView(mesh.indices.data(), mesh.indices.size() * sizeof(uint32_t), kElementArrayBuffer);
  return push(root_, "accessors",
              {{"bufferView", view},
               {"componentType", small ? kUnsignedShort : kUnsignedInt},
               {"count", mesh.indices.size()},
               {"type", "SCALAR"}});
}

void Glb::useExtension(const char* name) {
  Json& used = root_["extensionsUsed"];
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

int Glb::addTexture(const std::string& name, const Canvas& canvas, Wrap wrap, bool alpha) {
  const std::vector<uint8_t> png = encodePng(canvas, alpha, pngLevel_);
  const size_t view = addView(png.data(), png.size(), 0);
  const size_t image = push(root_, "images", {{"name", name}, {"mimeType", "image/png"}, {"bufferView", view}});
  const int mode = wrap == Wrap::repeat ? 10497 : 33071;  // REPEAT, CLAMP_TO_EDGE
  const Json sampler = {{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", mode}, {"wrapT", mode}};
  Json& samplers = root_["samplers"];
  auto found = std::find(samplers.begin(), samplers.end(), sampler);
  const auto samplerIndex = static_cast<size_t>(found - samplers.begin());
  if (found == samplers.end()) samplers.push_back(sampler);
  return static_cast<int>(push(root_, "textures", {{"sampler", samplerIndex}, {"source", image}}));
}

int Glb::addMaterial(const Material& material) {
  Json surface = {
      {"baseColorFactor", {material.baseColor.r, material.baseColor.g, material.baseColor.b, material.baseColor.a}},
      {"metallicFactor", material.metallic},
      {"roughnessFactor", material.roughness}};
  if (material.texture >= 0) surface["baseColorTexture"] = {{"index", material.texture}};
  if (material.metallicRoughnessTexture >= 0) {
    surface["metallicRoughnessTexture"] = {{"index", material.metallicRoughnessTexture}};
  }
  Json json = {{"name", material.name}, {"pbrMetallicRoughness", surface}};
  if (material.normalTexture >= 0) json["normalTexture"] = {{"index", material.normalTexture}};
  if (material.alphaMode == AlphaMode::blend) json["alphaMode"] = "BLEND";
  if (material.alphaMode == AlphaMode::mask) {
    json["alphaMode"] = "MASK";
    json["alphaCutoff"] = material.alphaCutoff;
  }
  if (material.doubleSided) json["doubleSided"] = true;
  if (material.emissive != glm::vec3(0.0f)) {
    json["emissiveFactor"] = toJson(material.emissive);
    if (material.emissiveTexture >= 0) json["emissiveTexture"] = {{"index", material.emissiveTexture}};
    if (material.emissiveStrength != 1.0f) {
      useExtension("KHR_materials_emissive_strength");
      json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", material.emissiveStrength}};
    }
  }
  if (material.unlit) {
    useExtension("KHR_materials_unlit");
    json["extensions"]["KHR_materials_unlit"] = Json::object();
  }
  return static_cast<int>(push(root_, "materials", std::move(json)));
}

int Glb::addMesh(const std::string& name, const Mesh& mesh, int material, Attributes attributes, const Json& extras) {
  std::vector<float> positions;
  std::vector<float> normals;
  std::vector<float> uvs;
  for (const Vertex& vertex : mesh.vertices) {
    positions.insert(positions.end(), {vertex.position.x, vertex.position.y, vertex.position.z});
    normals.insert(normals.end(), {vertex.normal.x, vertex.normal.y, vertex.normal.z});
    uvs.insert(uvs.end(), {vertex.uv.x, vertex.uv.y});
  }
  Json written = {{"POSITION", addFloats(positions, 3, true)}};
  if (attributes.normals) written["NORMAL"] = addFloats(normals, 3, false);
  if (attributes.uvs) written["TEXCOORD_0"] = addFloats(uvs, 2, false);
  if (attributes.colors) written["COLOR_0"] = addColors(mesh);
  const Json primitive = {{"attributes", written}, {"indices", addIndices(mesh)}, {"material", material}};
  Json json = {{"name", name}, {"primitives", Json::array({primitive})}};
  if (!extras.is_null()) json["extras"] = extras;

  std::vector<Triangle> triangles;
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    triangles.push_back({mesh.vertices[mesh.indices[i]].position, mesh.vertices[mesh.indices[i + 1]].position,
                         mesh.vertices[mesh.indices[i + 2]].position});
  }
  meshTriangles_.push_back(std::move(triangles));
  return static_cast<int>(push(root_, "meshes", std::move(json)));
}

size_t Glb::addRootNode(Json node) {
  const size_t index = push(root_, "nodes", std::move(node));
  root_["scenes"][0]["nodes"].push_back(index);
  return index;
}

void Glb::addNode(const std::string& name, int mesh, const Placement& placement) {
  Json node = {{"name", name}, {"mesh", mesh}};
  if (placement.translation != glm::vec3(0.0f)) node["translation"] = toJson(placement.translation);
  if (placement.rotation != glm::quat(1.0f, 0.0f, 0.0f, 0.0f)) node["rotation"] = toJson(placement.rotation);
  if (placement.scale != 1.0f) node["scale"] = {placement.scale, placement.scale, placement.scale};
  addRootNode(std::move(node));
  for (Triangle triangle : meshTriangles_[static_cast<size_t>(mesh)]) {
    for (glm::vec3& corner : triangle) {
      corner = placement.rotation * (corner * placement.scale) + placement.translation;
    }
    worldTriangles_.push_back(triangle);
  }
}

void Glb::add(const std::string& name, const Mesh& mesh, int material, Attributes attributes) {
  addNode(name, addMesh(name, mesh, material, attributes));
}

void Glb::addCamera(const std::string& name, float yfov, glm::vec3 position, glm::vec3 target) {
  const size_t camera = push(root_, "cameras",
                             {{"name", name},
                              {"type", "perspective"},
                              {"perspective", {{"aspectRatio", 16.0 / 9.0}, {"yfov", yfov}, {"znear", 0.01}}}});
  addRootNode({{"name", name},
               {"translation", toJson(position)},
               {"rotation", toJson(lookingAlong(target - position))},
               {"camera", camera}});
}

void Glb::addLight(const LightSource& light, glm::vec3 position, glm::vec3 target) {
  useExtension("KHR_lights_punctual");
  Json json = {
      {"name", light.name}, {"type", light.type}, {"color", toJson(light.color)}, {"intensity", light.intensity}};
  if (light.type == "spot") json["spot"] = {{"outerConeAngle", light.outerConeAngle}};
  const size_t index = push(root_["extensions"]["KHR_lights_punctual"], "lights", std::move(json));
  addRootNode({{"name", light.name},
               {"translation", toJson(position)},
               {"rotation", toJson(lookingAlong(target - position))},
               {"extensions", {{"KHR_lights_punctual", {{"light", index}}}}}});
}

void Glb::write(const std::filesystem::path& file) const {
  Json root = root_;
  std::vector<uint8_t> binary = binary_;
  while (binary.size() % 4 != 0) binary.push_back(0);
  root["buffers"] = Json::array({{{"byteLength", binary.size()}}});
  std::string text = root.dump();
  while (text.size() % 4 != 0) text.push_back(' ');

  std::vector<uint8_t> header;
  append32(header, 0x46546C67u);  // "glTF"
  append32(header, 2);
  append32(header, static_cast<uint32_t>(12 + 8 + text.size() + 8 + binary.size()));
  append32(header, static_cast<uint32_t>(text.size()));
  append32(header, 0x4E4F534Au);  // "JSON"
  std::vector<uint8_t> binaryHeader;
  append32(binaryHeader, static_cast<uint32_t>(binary.size()));
  append32(binaryHeader, 0x004E4942u);  // "BIN"

  std::ofstream stream(file, std::ios::binary);
  const auto put = [&stream](const void* data, size_t size) {
    stream.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  };
  put(header.data(), header.size());
  put(text.data(), text.size());
  put(binaryHeader.data(), binaryHeader.size());
  put(binary.data(), binary.size());
  stream.close();
  if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace scenes
