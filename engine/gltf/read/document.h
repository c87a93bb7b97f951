// What the files of engine/gltf share: the parsed document and the steps from it to a scene. Private to them.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/scene.h"

namespace lensgraph::engine::gltf {

/// A parsed file. Every index in the model has been checked against the array that it points into, every
/// member's type and length against the specification; byte ranges have not: they are checked where bytes are
/// read.
struct Document {
  std::string file;              ///< As the user gave it, for messages.
  std::filesystem::path folder;  ///< Where relative URIs start.
  /// buffers hold their bytes; images hold uri or bufferView, not pixels; animations are left out.
  tinygltf::Model model;
  std::vector<std::string> warnings;

  [[noreturn]] void fail(const std::string& field, const std::string& reason, const std::string& remedy = {}) const;
  /// Adds a warning once, however often it is found.
  void warn(const std::string& text);
};

/// "array[index]member" as it stands in messages.
std::string at(const char* array, size_t index, const std::string& member = {});

/// A JSON number (double) as float; throws Error naming the field where it would become infinite.
float toFloat(const Document& document, double value, const std::string& field);

/// Reads and checks a .gltf or .glb file (told apart by content) and its buffers.
Document readDocument(const std::filesystem::path& path);

/// Bytes behind a URI: base64 data or a file beside the document. Throws Error that names the field.
std::vector<uint8_t> readUri(const Document& document, const std::string& uri, const std::string& field);

// ---- Bytes and accessors

/// The bytes of a buffer view, checked against its buffer.
std::span<const uint8_t> viewBytes(const Document& document, int bufferView);

/// Component types of an accessor that an attribute allows, as bits.
enum ComponentTypes : unsigned {
  kFloat = 1,
  kNormalizedUnsigned = 2,  ///< u8 and u16 that stand for 0…1
  kNormalizedSigned = 4,    ///< s8 and s16 that stand for −1…1
  kPlainInteger = 8,        ///< 8 and 16 bit integers that stand for themselves (KHR_mesh_quantization)
};

/// An accessor's elements as floats, tightly packed, sparse values in place. `components` per element must
/// match its type. Throws Error naming `field` for a type that is not allowed, a range outside the buffer, a
/// non-finite value.
std::vector<float> readFloats(const Document& document, int accessor, int components, unsigned allowedTypes,
                              const std::string& field);

/// An accessor of unsigned integers (scalars or vectors of `components`).
std::vector<uint32_t> readUnsigned(const Document& document, int accessor, int components, const std::string& field);

/// 2 for VEC2 and so on; 0 for what is no vector.
int componentCount(const tinygltf::Accessor& accessor);

// ---- Parts of the scene

/// Turns glTF materials into the scene's, with the textures and images that they use, each once, when first
/// asked for: what nothing drawn uses is never decoded.
class MaterialBuilder {
 public:
  MaterialBuilder(Document& document, Scene& scene, bool loadShadingTextures);
  /// Index into Scene::materials of a glTF material; −1 is the default material.
  uint32_t materialIndex(int material);

 private:
  Material build(size_t index);
  template <typename TextureInfo>
  TextureUse use(const TextureInfo& info, ColorEncoding encoding, const std::string& field);
  uint32_t textureIndex(int texture, ColorEncoding encoding);
  uint32_t imageIndex(int image, ColorEncoding encoding);

  Document& document_;
  Scene& scene_;
  bool loadShadingTextures_;
  std::vector<uint32_t> materials_;                ///< By glTF material + 1; kNoIndex until built.
  std::vector<uint32_t> textures_[2], images_[2];  ///< By encoding, then by glTF index.
};

/// Decodes one glTF image to RGBA8. Throws Error: missing, empty, damaged or neither PNG nor JPEG.
SceneImage decodeImage(const Document& document, int image, ColorEncoding encoding);

/// Triangles of meshes[mesh].primitives[primitive], without its material, and without normals if it has none.
/// None (and a warning) when there is nothing to draw in it.
std::optional<Primitive> buildPrimitive(Document& document, size_t mesh, size_t primitive);

/// Moves the vertices (as many as in the file) of a skinned primitive to where the joints' rest pose puts
/// them, in the file's space.
void applyRestPose(Document& document, size_t mesh, size_t primitive, int skin,
                   const std::vector<glm::dmat4>& fileFromNode, Primitive& target);

}  // namespace lensgraph::engine::gltf
