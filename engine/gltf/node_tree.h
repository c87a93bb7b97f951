// The nodes of the scene to draw, and where each stands. Private to engine/gltf.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "engine/gltf/read/document.h"

namespace lensgraph::engine::gltf {

/// T · R · S; none when the quaternion (x, y, z, w) has no direction.
std::optional<glm::dmat4> fromTrs(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale);

struct NodeTree {
  struct Placed {
    size_t node;
    bool isVisible;  ///< False where KHR_node_visibility hides it or a node above it.
  };
  std::vector<Placed> placed;            ///< Nodes of the scene, parents first.
  std::vector<glm::dmat4> fileFromNode;  ///< By node; only those in `placed` count.
};

/// Throws Error: nodes that form no tree, a matrix that is none of a transform, a rotation without direction.
NodeTree placeNodes(const Document& document);

}  // namespace lensgraph::engine::gltf
