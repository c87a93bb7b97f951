// Walks the node tree.
#include "engine/gltf/node_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace lensgraph::engine::gltf {
namespace {

// Exporters write matrices with the digits of a float.
constexpr double kTolerance = 1e-5;

glm::dmat4 fromMatrix(const Document& document, const std::vector<double>& values, size_t index) {
  glm::dmat4 matrix;
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = values[static_cast<size_t>(i)];
  const bool isAffine = std::fabs(matrix[0][3]) <= kTolerance && std::fabs(matrix[1][3]) <= kTolerance &&
                        std::fabs(matrix[2][3]) <= kTolerance && std::fabs(matrix[3][3] - 1.0) <= kTolerance;
  if (!isAffine) document.fail(at("nodes", index, ".matrix"), "its last row is not 0 0 0 1 (elements 3, 7, 11, 15)");
  for (int column = 0; column < 4; ++column) matrix[column][3] = column == 3 ? 1.0 : 0.0;
  return matrix;
}

glm::dmat4 parentFromNode(const Document& document, size_t index) {
  const tinygltf::Node& node = document.model.nodes[index];
  if (!node.matrix.empty()) return fromMatrix(document, node.matrix, index);
  const auto vec3Of = [](const std::vector<double>& v, double otherwise) {
    return v.empty() ? glm::dvec3(otherwise) : glm::dvec3(v[0], v[1], v[2]);
  };
  const std::vector<double>& r = node.rotation;
  const glm::dvec4 rotation = r.empty() ? glm::dvec4(0.0, 0.0, 0.0, 1.0) : glm::dvec4(r[0], r[1], r[2], r[3]);
  const auto matrix = fromTrs(vec3Of(node.translation, 0.0), rotation, vec3Of(node.scale, 1.0));
  if (!matrix) document.fail(at("nodes", index, ".rotation"), "is no rotation: the quaternion has length 0");
  return *matrix;
}

bool isHiddenByExtension(const tinygltf::Node& node) {
  const auto found = node.extensions.find("KHR_node_visibility");
  return found != node.extensions.end() && found->second.Has("visible") && !found->second.Get("visible").Get<bool>();
}

// The roots of the scene to draw, checked to be nodes of a tree by the walk.
std::vector<int> rootNodes(const tinygltf::Model& model) {
  if (!model.scenes.empty()) return model.scenes[static_cast<size_t>(std::max(model.defaultScene, 0))].nodes;
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

}  // namespace

std::optional<glm::dmat4> fromTrs(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale) {
  const double length = glm::length(rotation);
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  const glm::dvec4 q = rotation / length;
  glm::dmat4 matrix = glm::mat4_cast(glm::dquat(q.w, q.x, q.y, q.z));
  for (int axis = 0; axis < 3; ++axis) matrix[axis] *= scale[axis];
  matrix[3] = glm::dvec4(translation, 1.0);
  return matrix;
}

// A stack of its own: files may nest nodes deeper than ours.
NodeTree placeNodes(const Document& document) {
  const tinygltf::Model& model = document.model;
  NodeTree tree;
  tree.fileFromNode.assign(model.nodes.size(), glm::dmat4(1.0));
  std::vector<bool> isVisited(model.nodes.size());
  struct Entry {
    int node;
    glm::dmat4 fileFromParent;
    bool isVisible;
  };
  std::vector<Entry> stack;
  const auto push = [&](const std::vector<int>& nodes, const glm::dmat4& fileFromParent, bool isVisible) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) stack.push_back({*node, fileFromParent, isVisible});
  };
  push(rootNodes(model), glm::dmat4(1.0), true);
  while (!stack.empty()) {
    const Entry entry = stack.back();
    stack.pop_back();
    const size_t index = static_cast<size_t>(entry.node);
    if (isVisited[index]) document.fail(at("nodes", index), "is reached twice: nodes must form a tree, not a cycle");
    isVisited[index] = true;
    tree.fileFromNode[index] = entry.fileFromParent * parentFromNode(document, index);
    const bool isVisible = entry.isVisible && !isHiddenByExtension(model.nodes[index]);
    tree.placed.push_back({.node = index, .isVisible = isVisible});
    push(model.nodes[index].children, tree.fileFromNode[index], isVisible);
  }
  return tree;
}

}  // namespace lensgraph::engine::gltf
