// EXT_mesh_gpu_instancing: many placements of a node's mesh in three accessors. Private to engine/gltf.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "engine/gltf/read/document.h"

namespace lensgraph::engine::gltf {

/// Where the mesh of a node stands in the node's own space: once, at its origin, without the extension. `memoryFor` bytes
/// are taken for each placement before any is made. Throws Error: counts that differ, types that are not allowed,
/// rotations without direction.
std::vector<glm::dmat4> meshPlacements(Document& document, size_t node, uint64_t memoryFor);

}  // namespace lensgraph::engine::gltf
