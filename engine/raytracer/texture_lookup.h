// Textures of a scene as the shading reads them: level 0 alone (the area is integrated by pixel samples), the
// magnification filter, glTF's wrap modes, filtered in linear light without premultiplication.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "engine/scene/scene.h"

namespace lensgraph::engine {

/// A material's use of a texture, ready to be read. Without a texture it is white.
class TextureLookup {
 public:
  TextureLookup() = default;
  /// The scene outlives it. Precondition: the use's indices are valid.
  TextureLookup(const Scene& scene, const TextureUse& use);

  /// uvs: the vertex's sets 0 and 1, interpolated.
  glm::vec4 at(const std::array<glm::vec2, 2>& uvs) const;
  /// The UV that at() reads at.
  glm::vec2 transformed(const std::array<glm::vec2, 2>& uvs) const;
  bool isUsed() const { return image_ != nullptr; }

 private:
  std::size_t column(int64_t x) const;
  std::size_t row(int64_t y) const;
  glm::vec4 texel(std::size_t column, std::size_t row) const;

  const SceneImage* image_ = nullptr;
  const std::array<float, 256>* decoding_ = nullptr;  ///< Of the image's color bytes.
  Wrap wrapS_ = Wrap::repeat, wrapT_ = Wrap::repeat;
  bool isNearest_ = false;
  uint32_t uvSet_ = 0;
  glm::vec2 origin_{0.0f}, u_{1.0f, 0.0f}, v_{0.0f, 1.0f};  ///< uv' = origin + u·x + v·y
};

}  // namespace lensgraph::engine
