// Materials of a glTF file with their textures. Private to engine/gltf.
#pragma once

#include <string>
#include <vector>

#include "engine/gltf/geometry/primitive.h"
#include "engine/gltf/image.h"
#include "engine/gltf/read/document.h"
#include "engine/scene/scene.h"

namespace lensgraph::engine::gltf {

/// Turns glTF materials into the scene's, with the textures and images that they use, each once, when first
/// asked for: what nothing drawn uses is never decoded.
class MaterialBuilder {
 public:
  /// Of a scene that is not lit, only what shows without light is built.
  MaterialBuilder(Document& document, Scene& scene, bool isLit);

  /// Index into Scene::materials of a glTF material; −1 is the default material.
  uint32_t materialIndex(int material);

  /// The UV sets that a material's TextureUse::uvSet 0 and 1 stand for. Precondition: materialIndex(material) was called.
  const UvSets& uvSetsOf(int material) const { return uvSets_[static_cast<size_t>(material + 1)]; }

 private:
  Material build(size_t index);
  // KHR_materials_transmission as alpha.
  void addTransmission(const tinygltf::Value& transmission, const std::string& field, Material& material);
  // Numbers the UV sets of a material's textures as slots, and returns which set is in which.
  UvSets placeUvSets(size_t index, Material& material);
  template <typename TextureInfo>
  TextureUse use(const TextureInfo& info, ColorEncoding encoding, const std::string& field);
  uint32_t textureIndex(int texture, ColorEncoding encoding);
  uint32_t imageIndex(int image, ColorEncoding encoding);
  [[noreturn]] void failWithoutSource(size_t texture) const;

  Document& document_;
  Scene& scene_;
  bool isLit_;
  ImageDecoder images_;
  std::vector<uint32_t> materials_;                      ///< By glTF material + 1; kNoIndex until built.
  std::vector<UvSets> uvSets_;                           ///< Likewise.
  std::vector<uint32_t> textures_[2], imageIndices_[2];  ///< By encoding, then by glTF index.
};

}  // namespace lensgraph::engine::gltf
