// Morph targets, baked into the vertices with the weights that the file gives (no animation). Private to engine/gltf.
#pragma once

#include <vector>

#include "engine/gltf/geometry/accessor.h"
#include "engine/scene/scene.h"

namespace lensgraph::engine::gltf {

/// Adds the targets of `source` to the vertices of `target`, of which there are `count` in the file and those in `picked`
/// in `target`. Positions, normals and tangents move; other attributes of targets are left out with a warning.
void applyMorphTargets(Document& document, const tinygltf::Primitive& source, const std::vector<double>& weights,
                       size_t count, Picked picked, const std::string& field, Primitive& target);

}  // namespace lensgraph::engine::gltf
