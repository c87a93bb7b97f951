// The rest pose of a skin, baked into the vertices: joints where the file's nodes put them, no animation.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "engine/gltf/internal.h"

namespace lensgraph::engine::gltf {
namespace {

// fileFromVertex of each joint: where the joint is, times the inverse of where it was when the skin was
// bound.
std::vector<glm::dmat4> jointMatrices(const Document& document, size_t skinIndex,
                                      const std::vector<glm::dmat4>& fileFromNode) {
  const tinygltf::Skin& skin = document.model.skins[skinIndex];
  std::vector<glm::dmat4> matrices(skin.joints.size());
  for (size_t i = 0; i < matrices.size(); ++i) matrices[i] = fileFromNode[static_cast<size_t>(skin.joints[i])];
  if (skin.inverseBindMatrices < 0) return matrices;
  const std::string field = at("skins", skinIndex, ".inverseBindMatrices");
  const std::vector<float> inverses = readFloats(document, skin.inverseBindMatrices, 16, kFloat, field);
  if (inverses.size() < matrices.size() * 16) document.fail(field, "has fewer matrices than the skin has joints");
  for (size_t i = 0; i < matrices.size(); ++i) {
    glm::dmat4 inverse;
    for (size_t k = 0; k < 16; ++k) inverse[static_cast<int>(k / 4)][static_cast<int>(k % 4)] = inverses[i * 16 + k];
    matrices[i] *= inverse;
  }
  return matrices;
}

struct Influences {
  std::vector<uint32_t> joints;  ///< Four per vertex.
  std::vector<float> weights;    ///< Four per vertex.
};

Influences readInfluences(const Document& document, const tinygltf::Primitive& source, size_t jointCount,
                          const std::string& field) {
  const auto joints = source.attributes.find("JOINTS_0");
  const auto weights = source.attributes.find("WEIGHTS_0");
  if (joints == source.attributes.end() || weights == source.attributes.end()) {
    document.fail(field + ".attributes", "JOINTS_0 or WEIGHTS_0 is missing in a skinned mesh");
  }
  Influences result;
  result.joints = readUnsigned(document, joints->second, 4, field + ".attributes.JOINTS_0");
  result.weights =
      readFloats(document, weights->second, 4, kFloat | kNormalizedUnsigned, field + ".attributes.WEIGHTS_0");
  if (result.joints.size() != result.weights.size())
    document.fail(field + ".attributes.WEIGHTS_0", "and JOINTS_0 differ in length");
  for (uint32_t joint : result.joints) {
    if (joint >= jointCount)
      document.fail(field + ".attributes.JOINTS_0", "joint " + std::to_string(joint) + " is out of range");
  }
  return result;
}

}  // namespace

void applyRestPose(Document& document, size_t mesh, size_t primitive, int skin,
                   const std::vector<glm::dmat4>& fileFromNode, Primitive& target) {
  const std::vector<glm::dmat4> matrices = jointMatrices(document, static_cast<size_t>(skin), fileFromNode);
  const std::string field = at("meshes", mesh) + at(".primitives", primitive);
  const tinygltf::Primitive& source = document.model.meshes[mesh].primitives[primitive];
  const Influences influences = readInfluences(document, source, matrices.size(), field);
  if (influences.joints.size() != target.positions.size() * 4) {
    document.fail(field + ".attributes.JOINTS_0", "and POSITION differ in length");
  }
  target.bounds = Bounds{};
  for (size_t v = 0; v < target.positions.size(); ++v) {
    glm::dmat4 fileFromVertex(0.0);
    double total = 0.0;
    for (size_t k = 4 * v; k < 4 * v + 4; ++k) {
      fileFromVertex += double{influences.weights[k]} * matrices[influences.joints[k]];
      total += influences.weights[k];
    }
    // Exporters round weights; an unnormalised sum would scale the mesh.
    fileFromVertex = total > 0.0 ? fileFromVertex / total : glm::dmat4(1.0);
    target.positions[v] = glm::vec3(fileFromVertex * glm::dvec4(target.positions[v], 1.0));
    if (!std::isfinite(glm::length(glm::dvec3(target.positions[v]))))
      document.fail(field, "is skinned out of the world");
    const glm::dmat3 rotation(fileFromVertex);
    const glm::dvec3 tangent = target.tangents.empty() ? glm::dvec3(0.0) : rotation * glm::dvec3(target.tangents[v]);
    if (glm::length(tangent) > 0.0)
      target.tangents[v] = glm::vec4(glm::vec3(glm::normalize(tangent)), target.tangents[v].w);
    if (!target.normals.empty() && std::fabs(glm::determinant(rotation)) > 0.0) {
      target.normals[v] =
          glm::vec3(glm::normalize(glm::transpose(glm::inverse(rotation)) * glm::dvec3(target.normals[v])));
    }
    target.bounds.add(glm::dvec3(target.positions[v]));
  }
}

}  // namespace lensgraph::engine::gltf
