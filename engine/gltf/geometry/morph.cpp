// Adds weighted morph targets (glTF 2.0 §3.7.2.2).
#include "engine/gltf/geometry/morph.h"

#include <algorithm>

namespace lensgraph::engine::gltf {
namespace {

// The types that glTF 2.0 and KHR_mesh_quantization allow for differences.
constexpr unsigned kTargetTypes = kFloat | kNormalizedSigned | kPlainInteger;

class MorphTarget {
 public:
  MorphTarget(Document& document, const std::map<std::string, int>& accessors, size_t count, Picked picked,
              std::string field)
      : document_(document), accessors_(accessors), count_(count), picked_(picked), field_(std::move(field)) {}

  /// Adds weight · difference to the first three components.
  template <typename Vector>
  void add(const char* name, double weight, std::vector<Vector>& values) const {
    const auto accessor = accessors_.find(name);
    if (accessor == accessors_.end() || values.empty()) return;
    const std::string field = field_ + "." + name;
    const Elements elements = elementsOf(document_, accessor->second, 3, kTargetTypes, field);
    if (elements.count != count_) {
      document_.fail(field,
                     "has " + std::to_string(elements.count) + " elements, POSITION has " + std::to_string(count_));
    }
    const std::vector<float> differences = toFloats(document_, elements, field, picked_);
    for (size_t i = 0; i < differences.size(); ++i) {
      float& value = values[i / 3][static_cast<int>(i % 3)];
      value = toFloat(document_, double{value} + weight * double{differences[i]}, field);
    }
  }

  void warnOfIgnored() const {
    for (const auto& [name, accessor] : accessors_) {
      if (name != "POSITION" && name != "NORMAL" && name != "TANGENT")
        document_.warn("morph targets move no " + name, field_);
    }
  }

 private:
  Document& document_;
  const std::map<std::string, int>& accessors_;
  size_t count_;
  Picked picked_;
  std::string field_;
};

}  // namespace

void applyMorphTargets(Document& document, const tinygltf::Primitive& source, const std::vector<double>& weights,
                       size_t count, Picked picked, const std::string& field, Primitive& target) {
  for (size_t i = 0; i < std::min(source.targets.size(), weights.size()); ++i) {
    if (weights[i] == 0.0) continue;
    const MorphTarget morph(document, source.targets[i], count, picked, field + at(".targets", i));
    morph.add("POSITION", weights[i], target.positions);
    morph.add("NORMAL", weights[i], target.normals);
    morph.add("TANGENT", weights[i], target.tangents);
    morph.warnOfIgnored();
  }
}

}  // namespace lensgraph::engine::gltf
