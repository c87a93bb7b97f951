// Loads glTF 2.0 (.gltf, .glb) into a scene. The files of engine/gltf are the only users of tinygltf.
//
// Read: node hierarchy, triangles, strips and fans, indexed or not; sparse, normalised, interleaved and
// quantised accessors (KHR_mesh_quantization); metallic-roughness, emissive
// (KHR_materials_emissive_strength), unlit (KHR_materials_unlit), alpha modes; textures, samplers, two UV
// sets, KHR_texture_transform; vertex colours; skins, in the pose that the file's nodes give their joints
// (with a warning); cameras; KHR_lights_punctual; embedded and external buffers and images. Not read, with a
// warning: animations and morph targets (the pose without them is drawn), points and lines, UV
// sets above 1, other extensions in extensionsUsed. Other extensions in extensionsRequired are an
// error.
#pragma once

#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace lensgraph::engine {

/// Where a file stands in the world: worldFromFile = T · R · S, as a glTF node's.
struct FileTransform {
  glm::dvec3 translation{0.0};
  glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0};  ///< Quaternion x, y, z, w; need not be normalised, must not be zero.
  glm::dvec3 scale{1.0};
};

/// Throws Error (fields "rotation", "translation", "scale"): non-finite numbers, zero quaternion.
glm::dmat4 worldFromFileTransform(const FileTransform& placement);

struct GltfOptions {
  /// False for pictures without light: normal, metallic-roughness and occlusion textures are left out, since nothing of
  /// them shows and decoding them is most of the time and memory of large files; transmission is ignored.
  bool isLit = true;
};

/// Adds the default scene of a file to a scene (the first one if none is default; all root nodes if it has no
/// scenes). Returns warnings, each one line that begins with the file. Throws Error and leaves the scene
/// unchanged when the file is missing, damaged or needs an extension that is not read. A file without
/// anything to draw is legal.
std::vector<std::string> appendGltf(Scene& scene, const std::filesystem::path& path,
                                    const glm::dmat4& worldFromFile = glm::dmat4(1.0), const GltfOptions& options = {});

}  // namespace lensgraph::engine
