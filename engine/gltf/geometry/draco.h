// Primitives compressed with KHR_draco_mesh_compression. The only user of libdraco. Private to engine/gltf.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/gltf/geometry/accessor.h"

namespace lensgraph::engine::gltf {

/// What a primitive's stream holds, as if its accessors held it.
struct DracoMesh {
  std::map<std::string, Elements> attributes;  ///< By the attribute's name.
  std::vector<uint32_t> triangles;             ///< Vertex numbers, not checked.
};

/// True when a primitive has the extension; what its accessors hold then is a fallback for others.
bool isDraco(const tinygltf::Primitive& primitive);

/// Decodes a primitive's stream. Its accessors say how much that is, and a stream that claims or holds something else is
/// refused before it is decoded. Throws Error naming `field` and the extension.
DracoMesh decodeDraco(Document& document, const tinygltf::Primitive& primitive, const std::string& field);

}  // namespace lensgraph::engine::gltf
