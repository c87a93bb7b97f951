// The rest pose of a skin, baked into the vertices: joints where the file's nodes put them, no animation. Private to
// engine/gltf.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "engine/gltf/geometry/accessor.h"
#include "engine/scene/scene.h"

namespace lensgraph::engine::gltf {

/// fileFromVertex of each joint of skins[index], in the rest pose: where the joint is, times the inverse of where it was
/// when the skin was bound.
std::vector<glm::dmat4> jointMatrices(Document& document, size_t index, const std::vector<glm::dmat4>& fileFromNode);

/// JOINTS_0 and WEIGHTS_0 of a primitive, four for each vertex.
struct Influences {
  Elements joints, weights;
};

/// Moves the vertices of `target`, which are those in `picked` of the file's, to where the joints put them, in the file's
/// space. Its triangles keep their front faces outside where joints mirror. Throws Error naming `field`.
void applyRestPose(Document& document, const std::vector<glm::dmat4>& joints, const Influences& influences,
                   Picked picked, const std::string& field, Primitive& target);

}  // namespace lensgraph::engine::gltf
