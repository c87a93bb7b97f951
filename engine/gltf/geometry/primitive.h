// One primitive of a glTF mesh as triangles with checked attributes. Private to engine/gltf.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

#include "engine/gltf/geometry/accessor.h"
#include "engine/scene/scene.h"

namespace lensgraph::engine::gltf {

/// Which TEXCOORD_n go into Primitive::uvs.
using UvSets = std::array<uint32_t, 2>;

/// What decides how meshes[mesh].primitives[primitive] looks, besides its material.
struct PrimitiveUse {
  size_t mesh = 0, primitive = 0;
  UvSets uvSets{0, 1};
  std::vector<double> weights;  ///< Of the morph targets; those that are missing are 0.
  int skin = -1;                ///< −1: none.
};

/// "meshes[2].primitives[0]"
std::string fieldOf(const PrimitiveUse& use);

/// False, with a warning, for points and lines. Throws Error for an unknown mode.
bool isOfTriangles(Document& document, const PrimitiveUse& use);

/// The primitive without its material, morphed and skinned; vertices that no triangle uses are left out. It has flat
/// normals when the file gives none. None, with a warning, when it has no triangles. `joints` are the skin's, if it has one.
/// Precondition: isOfTriangles().
std::optional<Primitive> buildPrimitive(Document& document, const PrimitiveUse& use,
                                        const std::vector<glm::dmat4>& joints);

}  // namespace lensgraph::engine::gltf
