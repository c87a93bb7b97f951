// One primitive of a glTF mesh to triangles with checked attributes.
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "engine/gltf/internal.h"

namespace lensgraph::engine::gltf {
namespace {

// Types that glTF 2.0 and KHR_mesh_quantization allow. Colours are wider: plain integers are taken for
// normalised ones.
constexpr unsigned kPositionTypes = kFloat | kNormalizedUnsigned | kNormalizedSigned | kPlainInteger;
constexpr unsigned kNormalTypes = kFloat | kNormalizedSigned;
constexpr unsigned kColorTypes = kFloat | kNormalizedUnsigned;

class PrimitiveReader {
 public:
  PrimitiveReader(const Document& document, const tinygltf::Primitive& source, std::string field)
      : document_(document), source_(source), field_(std::move(field)) {}

  std::string attributeField(const char* name) const { return field_ + ".attributes." + name; }

  /// Accessor of an attribute; −1 when the primitive has none.
  int accessorOf(const char* name) const {
    const auto found = source_.attributes.find(name);
    return found == source_.attributes.end() ? -1 : found->second;
  }

  /// One attribute as vectors; empty when the primitive has none.
  template <typename Vector>
  std::vector<Vector> read(const char* name, unsigned types) const {
    const int accessor = accessorOf(name);
    if (accessor < 0) return {};
    const std::vector<float> values = readFloats(document_, accessor, Vector::length(), types, attributeField(name));
    std::vector<Vector> result(values.size() / Vector::length());
    if (!values.empty()) std::memcpy(result.data(), values.data(), values.size() * sizeof(float));
    return result;
  }

  template <typename Vector>
  std::vector<Vector> readMatching(const char* name, unsigned types, size_t count) const {
    std::vector<Vector> result = read<Vector>(name, types);
    if (accessorOf(name) >= 0 && result.size() != count) {
      document_.fail(attributeField(name),
                     "has " + std::to_string(result.size()) + " elements, POSITION has " + std::to_string(count));
    }
    return result;
  }

  std::vector<glm::vec4> readColors(size_t count) const {
    const int accessor = accessorOf("COLOR_0");
    if (accessor < 0) return {};
    if (componentCount(document_.model.accessors[static_cast<size_t>(accessor)]) == 4) {
      return readMatching<glm::vec4>("COLOR_0", kColorTypes, count);
    }
    const std::vector<glm::vec3> rgb = readMatching<glm::vec3>("COLOR_0", kColorTypes, count);
    std::vector<glm::vec4> colors(rgb.size());
    for (size_t i = 0; i < rgb.size(); ++i) colors[i] = glm::vec4(rgb[i], 1.0f);
    return colors;
  }

  /// Vertex numbers in drawing order, each below `count`.
  std::vector<uint32_t> readOrder(size_t count) const {
    std::vector<uint32_t> order;
    if (source_.indices < 0) {
      order.resize(count);
      for (size_t i = 0; i < count; ++i) order[i] = static_cast<uint32_t>(i);
      return order;
    }
    order = readUnsigned(document_, source_.indices, 1, field_ + ".indices");
    for (size_t i = 0; i < order.size(); ++i) {
      if (order[i] >= count) {
        document_.fail(field_ + ".indices", "element " + std::to_string(i) + " is " + std::to_string(order[i]) +
                                                ", out of range: there are " + std::to_string(count) + " vertices");
      }
    }
    return order;
  }

 private:
  const Document& document_;
  const tinygltf::Primitive& source_;
  std::string field_;
};

// glTF 2.0 §3.7.2.1: strips alternate their winding, fans turn round the first vertex.
std::vector<uint32_t> trianglesOf(std::vector<uint32_t> order, int mode) {
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    order.resize(order.size() - order.size() % 3);
    return order;
  }
  std::vector<uint32_t> triangles;
  for (size_t i = 0; i + 2 < order.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      triangles.insert(triangles.end(), {order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
    } else {
      triangles.insert(triangles.end(), {order[i + 1], order[i + 2], order[0]});
    }
  }
  return triangles;
}

void normalise(std::vector<glm::vec3>& normals) {
  for (glm::vec3& normal : normals) {
    const double length = glm::length(glm::dvec3(normal));
    normal = length > 0.0 ? glm::vec3(glm::dvec3(normal) / length) : glm::vec3(0.0f, 0.0f, 1.0f);
  }
}

void warnOfIgnored(Document& document, const tinygltf::Primitive& source, const std::string& field) {
  if (!source.targets.empty()) document.warn("morph targets are ignored, the rest pose is drawn");
  for (const auto& [name, accessor] : source.attributes) {
    if (name == "COLOR_1") document.warn(field + ".attributes." + name + " is ignored");
  }
}

}  // namespace

std::optional<Primitive> buildPrimitive(Document& document, size_t mesh, size_t primitive) {
  const tinygltf::Mesh& sourceMesh = document.model.meshes[mesh];
  const tinygltf::Primitive& source = sourceMesh.primitives[primitive];
  const std::string field = at("meshes", mesh) + at(".primitives", primitive);
  if (source.mode < 0 || source.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    document.fail(field + ".mode", std::to_string(source.mode) + " is no mode");
  }
  if (source.mode < TINYGLTF_MODE_TRIANGLES) {
    document.warn(field + ": points and lines are not drawn");
    return std::nullopt;
  }
  warnOfIgnored(document, source, field);
  const PrimitiveReader reader(document, source, field);
  if (reader.accessorOf("POSITION") < 0) document.fail(field + ".attributes.POSITION", "is missing");

  Primitive result;
  result.name = sourceMesh.name.empty() ? field : sourceMesh.name;
  result.positions = reader.read<glm::vec3>("POSITION", kPositionTypes);
  const size_t count = result.positions.size();
  if (count >= kNoIndex)
    document.fail(field + ".attributes.POSITION", "has more vertices than 32 bit indices can count");
  result.normals = reader.readMatching<glm::vec3>("NORMAL", kNormalTypes, count);
  result.tangents = reader.readMatching<glm::vec4>("TANGENT", kNormalTypes, count);
  result.uvs[0] = reader.readMatching<glm::vec2>("TEXCOORD_0", kPositionTypes, count);
  result.uvs[1] = reader.readMatching<glm::vec2>("TEXCOORD_1", kPositionTypes, count);
  result.colors = reader.readColors(count);
  std::vector<uint32_t> order = reader.readOrder(count);
  if (source.mode == TINYGLTF_MODE_TRIANGLES && order.size() % 3 != 0) {
    document.warn(field + ": " + std::to_string(order.size()) +
                  " vertices do not make whole triangles, the last are left out");
  }
  result.indices = trianglesOf(std::move(order), source.mode);
  if (result.indices.empty()) {
    document.warn(field + ": has no triangles");
    return std::nullopt;
  }
  normalise(result.normals);
  for (const glm::vec3& position : result.positions) result.bounds.add(glm::dvec3(position));
  return result;
}

}  // namespace lensgraph::engine::gltf
