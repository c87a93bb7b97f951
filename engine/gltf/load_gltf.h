// Loads glTF 2.0 (.gltf, .glb) into a scene. Inside, read/ makes a checked document of a file, geometry/ primitives of its
// accessors; the files beside this one put the scene together. They are the only users of tinygltf, stb_image, Draco and
// meshoptimizer.
//
// Read: node hierarchy, visibility (KHR_node_visibility), instances (EXT_mesh_gpu_instancing); triangles, strips and fans,
// indexed or not; sparse, normalised, interleaved and quantised accessors (KHR_mesh_quantization); compressed ones
// (KHR_draco_mesh_compression, EXT_meshopt_compression, and KHR_meshopt_compression where it holds the same);
// metallic-roughness, emissive (KHR_materials_emissive_strength), unlit (KHR_materials_unlit), alpha modes; textures,
// samplers, KHR_texture_transform; of all UV sets the two that a material uses; vertex colours; morph targets with the
// weights that the file gives; skins, in the pose that the file's nodes give their joints (with a warning); cameras;
// KHR_lights_punctual; embedded and external buffers and images, data URIs (RFC 2397).
// KHR_materials_transmission is alpha in lit pictures, with a warning: at least 0.08, so that reflections stay; in an
// opaque material the alpha of the base colour's texture counts then too.
// Not read, with a warning: animations (the rest pose is drawn), points and lines, a third UV set of a material, morph targets of UVs and colours, other extensions in extensionsUsed. Other extensions in
// extensionsRequired, and textures that have their image in an extension alone, are an error.
// Also an error: what would change the picture silently. asset.minVersion above 2.0, a matrix whose last row is not
// 0 0 0 1, a member that an object gives twice, compressed streams that hold something else than their accessors say.
//
// Buffers and images are opened when something drawn needs them; what nothing needs may be missing or wrong. Only regular
// files are opened.
//
// Limits, each an error that names the field:
//   file, JSON      4 GiB; JSON nested 100 levels deep; names are cut to 200 bytes
//   geometry        what the file repeats or leaves to zeros (primitives that share all of an accessor, accessors without
//                   buffer view): 12 MB of memory, and 6 bytes for each byte of the file. Meshes that several nodes place,
//                   and primitives that use parts of one accessor, are no repetition
//   instances       32 MB for placements of primitives beyond the first of each node, and 16 bytes for each byte of buffers
//   Draco           8 MB of vertices and indices, and 256 bytes for each byte of the file
//   meshopt         64 bytes for each byte of a stream, and of the file
//   images          16384 pixels a side; together 268 million pixels, and 32 for each byte of the images
//   lines           500 bytes; warnings of one kind are one line
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
/// scenes). Returns warnings, each one line that begins with the file, one for each kind. Throws Error and leaves the scene
/// unchanged when the file is missing, damaged or needs an extension that is not read. A file without
/// anything to draw is legal.
std::vector<std::string> appendGltf(Scene& scene, const std::filesystem::path& path,
                                    const glm::dmat4& worldFromFile = glm::dmat4(1.0), const GltfOptions& options = {});

}  // namespace lensgraph::engine
