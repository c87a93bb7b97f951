// Images of a glTF file as pixels. Private to engine/gltf.
#pragma once

#include <cstdint>
#include <string>

#include "engine/gltf/read/document.h"
#include "engine/scene/scene.h"

namespace lensgraph::engine::gltf {

/// Decodes images, and keeps to limits that their headers are held against before a pixel is decoded: a few kilobytes
/// of PNG may stand for gigabytes.
class ImageDecoder {
 public:
  static constexpr uint32_t kMaxSide = 16384;  ///< px; what devices promise for textures.
  /// Pixels of all images of a file: this, and kPixelsOfByte for each byte of them.
  static constexpr uint64_t kBasePixels = uint64_t{16384} * 16384;
  static constexpr uint64_t kPixelsOfByte = 32;

  explicit ImageDecoder(Document& document) : document_(document) {}

  /// RGBA8 of a glTF image. Throws Error: missing, empty, damaged, too large, neither PNG nor JPEG.
  SceneImage decode(int image);
  /// A second copy of a decoded image.
  SceneImage copy(const SceneImage& decoded, int image);

 private:
  void takePixels(uint64_t pixels, uint64_t bytes, const std::string& field);

  Document& document_;
  uint64_t pixels_ = 0, bytes_ = 0;
};

}  // namespace lensgraph::engine::gltf
