// Reads primitives: attributes, triangles, and the vertices that the triangles use.
#include "engine/gltf/geometry/primitive.h"

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "engine/gltf/geometry/draco.h"
#include "engine/gltf/geometry/morph.h"
#include "engine/gltf/geometry/skin.h"

namespace lensgraph::engine::gltf {
namespace {

// Types that glTF 2.0 and KHR_mesh_quantization allow.
constexpr unsigned kPositionTypes = kFloat | kNormalizedUnsigned | kNormalizedSigned | kPlainInteger;
constexpr unsigned kNormalTypes = kFloat | kNormalizedSigned;
constexpr unsigned kColorTypes = kFloat | kNormalizedUnsigned;

const tinygltf::Primitive& sourceOf(const Document& document, const PrimitiveUse& use) {
  return document.model.meshes[use.mesh].primitives[use.primitive];
}

class PrimitiveReader {
 public:
  PrimitiveReader(Document& document, const PrimitiveUse& use)
      : document_(document), source_(sourceOf(document, use)), use_(use), field_(fieldOf(use)) {
    if (isDraco(source_)) draco_ = decodeDraco(document, source_, field_);
    const Elements positions = elements("POSITION", 3, kPositionTypes);
    count_ = positions.count;
    if (count_ >= kNoIndex)
      document_.fail(attributeField("POSITION"), "has more vertices than 32 bit indices can count");
    triangles_ = trianglesOf(readOrder());
    pickVertices();
  }

  std::optional<Primitive> build(const std::vector<glm::dmat4>& joints) {
    if (triangles_.empty()) {
      document_.warn("primitives without triangles are not drawn", field_);
      return std::nullopt;
    }
    Primitive result;
    const std::string& meshName = document_.model.meshes[use_.mesh].name;
    result.name = meshName.empty() ? field_ : meshName;
    result.positions = read<glm::vec3>("POSITION", kPositionTypes);
    result.normals = read<glm::vec3>("NORMAL", kNormalTypes);
    result.tangents = read<glm::vec4>("TANGENT", kNormalTypes);
    for (size_t slot = 0; slot < use_.uvSets.size(); ++slot)
      result.uvs[slot] = read<glm::vec2>("TEXCOORD_" + std::to_string(use_.uvSets[slot]), kPositionTypes);
    result.colors = readColors();
    warnOfIgnored();
    applyMorphTargets(document_, source_, use_.weights, count_, picked(), field_, result);
    normalise(result.normals);
    result.indices = std::move(triangles_);
    if (use_.skin >= 0) {
      const Influences influences{.joints = influence("JOINTS_0", kUnsigned),
                                  .weights = influence("WEIGHTS_0", kFloat | kNormalizedUnsigned)};
      applyRestPose(document_, joints, influences, picked(), field_, result);
    }
    if (result.normals.empty()) flatten(result);
    for (const glm::vec3& position : result.positions) result.bounds.add(glm::dvec3(position));
    return result;
  }

 private:
  std::string attributeField(const std::string& name) const { return field_ + ".attributes." + name; }

  // Accessor of an attribute; −1 when the primitive has none.
  int accessorOf(const std::string& name) const {
    const auto found = source_.attributes.find(name);
    return found == source_.attributes.end() ? -1 : found->second;
  }

  Picked picked() const { return isPicked_ ? &picked_ : nullptr; }

  // An attribute that the primitive has to have.
  Elements elements(const std::string& name, int components, unsigned types) const {
    const int accessor = accessorOf(name);
    if (accessor < 0) document_.fail(attributeField(name), "is missing");
    Elements result;
    if (const auto found = draco_.attributes.find(name); found != draco_.attributes.end()) {
      requireType(document_, document_.model.accessors[static_cast<size_t>(accessor)], components, types,
                  attributeField(name));
      result = found->second;
    } else {
      result = elementsOf(document_, accessor, components, types, attributeField(name));
    }
    if (name != "POSITION" && result.count != count_) {
      document_.fail(attributeField(name),
                     "has " + std::to_string(result.count) + " elements, POSITION has " + std::to_string(count_));
    }
    return result;
  }

  // One attribute as vectors; empty when the primitive has none.
  template <typename Vector>
  std::vector<Vector> read(const std::string& name, unsigned types) const {
    if (accessorOf(name) < 0) return {};
    const std::vector<float> values =
        toFloats(document_, elements(name, Vector::length(), types), attributeField(name), picked());
    std::vector<Vector> result(values.size() / Vector::length());
    if (!values.empty()) std::memcpy(result.data(), values.data(), values.size() * sizeof(float));
    return result;
  }

  std::vector<glm::vec4> readColors() const {
    const int accessor = accessorOf("COLOR_0");
    if (accessor < 0) return {};
    if (componentCount(document_.model.accessors[static_cast<size_t>(accessor)]) == 4)
      return read<glm::vec4>("COLOR_0", kColorTypes);
    const std::vector<glm::vec3> rgb = read<glm::vec3>("COLOR_0", kColorTypes);
    std::vector<glm::vec4> colors(rgb.size());
    for (size_t i = 0; i < rgb.size(); ++i) colors[i] = glm::vec4(rgb[i], 1.0f);
    return colors;
  }

  Elements influence(const char* name, unsigned types) const {
    if (accessorOf(name) < 0)
      document_.fail(field_ + ".attributes", "JOINTS_0 or WEIGHTS_0 is missing in a skinned mesh");
    return elements(name, 4, types);
  }

  // Vertex numbers in drawing order, each below the count.
  std::vector<uint32_t> readOrder() {
    std::vector<uint32_t> order;
    const std::string field = field_ + ".indices";
    if (isDraco(source_)) {
      order = std::move(draco_.triangles);
    } else if (source_.indices >= 0) {
      order = toUnsigned(document_, elementsOf(document_, source_.indices, 1, kUnsigned, field), field);
    } else {
      document_.takeMemory(count_ * sizeof(uint32_t), 0, attributeField("POSITION"));
      order.resize(count_);
      std::iota(order.begin(), order.end(), 0u);
    }
    const auto bad = std::find_if(order.begin(), order.end(), [&](uint32_t vertex) { return vertex >= count_; });
    if (bad != order.end()) {
      document_.fail(field, "element " + std::to_string(bad - order.begin()) + " is " + std::to_string(*bad) +
                                ", out of range: there are " + std::to_string(count_) + " vertices");
    }
    return order;
  }

  // glTF 2.0 §3.7.2.1: strips alternate their winding, fans turn round the first vertex.
  std::vector<uint32_t> trianglesOf(std::vector<uint32_t> order) {
    if (source_.mode == TINYGLTF_MODE_TRIANGLES || isDraco(source_)) {
      if (order.size() % 3 != 0)
        document_.warn("the vertices do not make whole triangles, the last are left out", field_);
      order.resize(order.size() - order.size() % 3);
      return order;
    }
    document_.takeMemory(order.size() * 3 * sizeof(uint32_t), 0, field_ + ".indices");
    std::vector<uint32_t> triangles;
    for (size_t i = 0; i + 2 < order.size(); ++i) {
      if (source_.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
        triangles.insert(triangles.end(), {order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
      } else {
        triangles.insert(triangles.end(), {order[i + 1], order[i + 2], order[0]});
      }
    }
    return triangles;
  }

  // Many primitives may share one long accessor and use a few of its vertices each.
  void pickVertices() {
    picked_ = triangles_.size() < count_ ? sortedVertices() : markedVertices();
    isPicked_ = picked_.size() < count_;
    if (!isPicked_) {
      picked_ = {};
      return;
    }
    for (uint32_t& vertex : triangles_)
      vertex = static_cast<uint32_t>(std::lower_bound(picked_.begin(), picked_.end(), vertex) - picked_.begin());
  }

  // The vertices that the triangles use, in time that depends on the triangles alone.
  std::vector<uint32_t> sortedVertices() const {
    std::vector<uint32_t> vertices = triangles_;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  // The same where they may well be all.
  std::vector<uint32_t> markedVertices() const {
    std::vector<bool> isUsed(count_);
    for (uint32_t vertex : triangles_) isUsed[vertex] = true;
    std::vector<uint32_t> vertices;
    for (uint32_t vertex = 0; vertex < count_; ++vertex) {
      if (isUsed[vertex]) vertices.push_back(vertex);
    }
    return vertices;
  }

  void normalise(std::vector<glm::vec3>& normals) const {
    for (glm::vec3& normal : normals) {
      const double length = glm::length(glm::dvec3(normal));
      normal = length > 0.0 ? glm::vec3(glm::dvec3(normal) / length) : glm::vec3(0.0f, 0.0f, 1.0f);
    }
  }

  void flatten(Primitive& primitive) const {
    const size_t vertexSize = sizeof(glm::vec3) * 2 + (primitive.uvs[0].empty() ? 0 : sizeof(glm::vec2)) +
                              (primitive.uvs[1].empty() ? 0 : sizeof(glm::vec2)) +
                              (primitive.colors.empty() ? 0 : sizeof(glm::vec4));
    document_.takeMemory(primitive.indices.size() * vertexSize, 0, field_);
    computeFlatNormals(primitive);
  }

  void warnOfIgnored() const {
    for (const char* name : {"COLOR_1", "JOINTS_1"}) {
      if (accessorOf(name) >= 0) document_.warn(std::string(name) + " is ignored", field_);
    }
  }

  Document& document_;
  const tinygltf::Primitive& source_;
  const PrimitiveUse& use_;
  std::string field_;
  DracoMesh draco_;
  size_t count_ = 0;                 ///< Vertices in the file.
  std::vector<uint32_t> triangles_;  ///< Numbers of vertices: of the picked ones when there are such.
  bool isPicked_ = false;
  std::vector<uint32_t> picked_;  ///< Vertices that the triangles use, ascending.
};

}  // namespace

std::string fieldOf(const PrimitiveUse& use) {
  return at("meshes", use.mesh) + at(".primitives", use.primitive);
}

bool isOfTriangles(Document& document, const PrimitiveUse& use) {
  const int mode = sourceOf(document, use).mode;
  if (mode < 0 || mode > TINYGLTF_MODE_TRIANGLE_FAN)
    document.fail(fieldOf(use) + ".mode", std::to_string(mode) + " is no mode");
  if (mode >= TINYGLTF_MODE_TRIANGLES) return true;
  document.warn(mode == TINYGLTF_MODE_POINTS ? "point primitives are not drawn" : "line primitives are not drawn",
                fieldOf(use));
  return false;
}

std::optional<Primitive> buildPrimitive(Document& document, const PrimitiveUse& use,
                                        const std::vector<glm::dmat4>& joints) {
  document.startPart();
  return PrimitiveReader(document, use).build(joints);
}

}  // namespace lensgraph::engine::gltf
