// Reads TRANSLATION, ROTATION and SCALE of instances.
#include "engine/gltf/instancing.h"

#include "engine/gltf/geometry/accessor.h"
#include "engine/gltf/node_tree.h"

namespace lensgraph::engine::gltf {
namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";

class InstanceReader {
 public:
  InstanceReader(Document& document, size_t node)
      : document_(document),
        attributes_(document.model.nodes[node].extensions.at(kExtension).Get("attributes")),
        field_(at("nodes", node, std::string(".extensions.") + kExtension + ".attributes")) {}

  std::vector<glm::dmat4> read(uint64_t memoryFor) {
    for (const std::string& name : attributes_.Keys()) {
      const size_t count = document_.model.accessors[accessorOf(name.c_str())].count;
      if (!count_) count_ = count;
      if (*count_ != count) {
        document_.fail(fieldOf(name),
                       "has " + std::to_string(count) + " elements, another attribute has " + std::to_string(*count_));
      }
    }
    const size_t count = count_.value_or(1);
    const std::vector<float> translations = values("TRANSLATION", 3, kFloat);
    const std::vector<float> rotations = values("ROTATION", 4, kFloat | kNormalizedSigned);
    const std::vector<float> scales = values("SCALE", 3, kFloat);
    document_.takeInstances(count * (memoryFor + sizeof(glm::dmat4)), field_);
    std::vector<glm::dmat4> result;
    result.reserve(count);
    for (size_t i = 0; i < count; ++i) {
      const auto matrix = fromTrs(glm::dvec3(vectorAt<3>(translations, i, 0.0)), rotationAt(rotations, i),
                                  glm::dvec3(vectorAt<3>(scales, i, 1.0)));
      if (!matrix) document_.fail(fieldOf("ROTATION"), "element " + std::to_string(i) + " has length 0");
      result.push_back(*matrix);
    }
    return result;
  }

 private:
  std::string fieldOf(const std::string& name) const { return field_ + "." + name; }
  size_t accessorOf(const char* name) const { return static_cast<size_t>(attributes_.Get(name).GetNumberAsInt()); }

  std::vector<float> values(const char* name, int components, unsigned types) {
    if (!attributes_.Has(name)) return {};
    return readFloats(document_, static_cast<int>(accessorOf(name)), components, types, fieldOf(name));
  }

  template <int N>
  static glm::vec<N, double> vectorAt(const std::vector<float>& values, size_t index, double otherwise) {
    glm::vec<N, double> result(otherwise);
    for (int c = 0; c < N && !values.empty(); ++c) result[c] = values[index * N + static_cast<size_t>(c)];
    return result;
  }

  static glm::dvec4 rotationAt(const std::vector<float>& values, size_t index) {
    return values.empty() ? glm::dvec4(0.0, 0.0, 0.0, 1.0) : vectorAt<4>(values, index, 0.0);
  }

  Document& document_;
  const tinygltf::Value& attributes_;
  std::string field_;
  std::optional<size_t> count_;
};

}  // namespace

std::vector<glm::dmat4> meshPlacements(Document& document, size_t node, uint64_t memoryFor) {
  if (!document.model.nodes[node].extensions.contains(kExtension)) return {glm::dmat4(1.0)};
  document.startPart();
  return InstanceReader(document, node).read(memoryFor);
}

}  // namespace lensgraph::engine::gltf
