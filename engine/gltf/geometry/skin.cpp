// Bakes skins into vertices.
#include "engine/gltf/geometry/skin.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace lensgraph::engine::gltf {
namespace {

std::vector<uint32_t> readJoints(Document& document, const Elements& joints, Picked picked, size_t jointCount,
                                 const std::string& field) {
  std::vector<uint32_t> result = toUnsigned(document, joints, field, picked);
  for (uint32_t joint : result) {
    if (joint >= jointCount) document.fail(field, "joint " + std::to_string(joint) + " is out of range");
  }
  return result;
}

/// Returns whether the matrix mirrors.
bool moveVertex(const glm::dmat4& fileFromVertex, size_t vertex, Primitive& target) {
  target.positions[vertex] = glm::vec3(fileFromVertex * glm::dvec4(target.positions[vertex], 1.0));
  const glm::dmat3 rotation(fileFromVertex);
  const double determinant = glm::determinant(rotation);
  if (!target.tangents.empty()) {
    const glm::dvec3 tangent = rotation * glm::dvec3(target.tangents[vertex]);
    const float side = target.tangents[vertex].w * (determinant < 0.0 ? -1.0f : 1.0f);
    if (glm::length(tangent) > 0.0) target.tangents[vertex] = glm::vec4(glm::vec3(glm::normalize(tangent)), side);
  }
  if (!target.normals.empty() && std::fabs(determinant) > 0.0) {
    target.normals[vertex] =
        glm::vec3(glm::normalize(glm::transpose(glm::inverse(rotation)) * glm::dvec3(target.normals[vertex])));
  }
  return determinant < 0.0;
}

// An instance's mirroring matrix turns the winding; here the vertices hold it, so the triangles are turned back.
void turnMirroredTriangles(const std::vector<bool>& isMirrored, Primitive& target) {
  for (size_t i = 0; i + 2 < target.indices.size(); i += 3) {
    uint32_t* corners = target.indices.data() + i;
    const int mirrored = isMirrored[corners[0]] + isMirrored[corners[1]] + isMirrored[corners[2]];
    if (mirrored >= 2) std::swap(corners[1], corners[2]);
  }
}

}  // namespace

std::vector<glm::dmat4> jointMatrices(Document& document, size_t index, const std::vector<glm::dmat4>& fileFromNode) {
  const tinygltf::Skin& skin = document.model.skins[index];
  std::vector<glm::dmat4> matrices(skin.joints.size());
  for (size_t i = 0; i < matrices.size(); ++i) matrices[i] = fileFromNode[static_cast<size_t>(skin.joints[i])];
  if (skin.inverseBindMatrices < 0) return matrices;
  const std::string field = at("skins", index, ".inverseBindMatrices");
  const std::vector<float> inverses = readFloats(document, skin.inverseBindMatrices, 16, kFloat, field);
  if (inverses.size() < matrices.size() * 16) document.fail(field, "has fewer matrices than the skin has joints");
  for (size_t i = 0; i < matrices.size(); ++i) {
    glm::dmat4 inverse;
    for (size_t k = 0; k < 16; ++k) inverse[static_cast<int>(k / 4)][static_cast<int>(k % 4)] = inverses[i * 16 + k];
    matrices[i] *= inverse;
  }
  return matrices;
}

void applyRestPose(Document& document, const std::vector<glm::dmat4>& joints, const Influences& influences,
                   Picked picked, const std::string& field, Primitive& target) {
  const std::vector<uint32_t> numbers =
      readJoints(document, influences.joints, picked, joints.size(), field + ".attributes.JOINTS_0");
  const std::vector<float> weights = toFloats(document, influences.weights, field + ".attributes.WEIGHTS_0", picked);
  std::vector<bool> isMirrored(target.positions.size());
  for (size_t v = 0; v < target.positions.size(); ++v) {
    glm::dmat4 fileFromVertex(0.0);
    double total = 0.0;
    for (size_t k = 4 * v; k < 4 * v + 4; ++k) {
      fileFromVertex += double{weights[k]} * joints[numbers[k]];
      total += weights[k];
    }
    // Exporters round weights; an unnormalised sum would scale the mesh.
    fileFromVertex = total > 0.0 ? fileFromVertex / total : glm::dmat4(1.0);
    isMirrored[v] = moveVertex(fileFromVertex, v, target);
    if (!std::isfinite(glm::length(glm::dvec3(target.positions[v]))))
      document.fail(field, "is skinned out of the world");
  }
  turnMirroredTriangles(isMirrored, target);
}

}  // namespace lensgraph::engine::gltf
