// Fetches, checks and decodes images.
#include "engine/gltf/image.h"

#include <climits>
#include <span>
#include <vector>

#include "engine/gltf/image_pixels.h"
#include "engine/gltf/image_size.h"
#include "engine/gltf/read/uri.h"

namespace lensgraph::engine::gltf {
SceneImage ImageDecoder::decode(int index) {
  const tinygltf::Image& source = document_.model.images[static_cast<size_t>(index)];
  const std::string field = at("images", static_cast<size_t>(index));
  std::vector<uint8_t> external;
  std::span<const uint8_t> bytes;
  if (source.bufferView >= 0) {
    bytes = document_.buffers.viewBytes(source.bufferView);
  } else {
    if (source.uri.empty()) document_.fail(field, "has neither uri nor bufferView");
    external = readUri(document_, source.uri, uint64_t{INT_MAX} + 1, field + ".uri");
    bytes = external;
  }
  const bool isNamed = !source.uri.empty() && !isDataUri(source.uri);
  const std::string name = isNamed ? "'" + source.uri + "' " : std::string();
  if (bytes.empty()) document_.fail(field, name + "is empty (0 bytes)");
  // Only what glTF allows: the decoder's other formats have seen less care.
  if (!isPng(bytes) && !isJpeg(bytes)) document_.fail(field, name + "is neither PNG nor JPEG", "convert it to PNG");
  if (bytes.size() > static_cast<size_t>(INT_MAX)) document_.fail(field, name + "is larger than 2 GB");

  const std::string damaged = name + "is damaged and cannot be decoded";
  const auto size = imageSize(bytes);
  if (!size || size->width == 0 || size->height == 0) document_.fail(field, damaged);
  if (size->width > kMaxSide || size->height > kMaxSide) {
    document_.fail(field,
                   name + "is " + std::to_string(size->width) + "x" + std::to_string(size->height) + ", larger than " +
                       std::to_string(kMaxSide) + " pixels a side",
                   "make it smaller");
  }
  takePixels(uint64_t{size->width} * size->height, bytes.size(), field);

  SceneImage image;
  image.name = isNamed ? source.uri : source.name.empty() ? field : source.name;
  image.width = size->width;
  image.height = size->height;
  image.rgba = decodeRgba(bytes, *size);
  if (image.rgba.empty()) document_.fail(field, damaged);
  return image;
}

SceneImage ImageDecoder::copy(const SceneImage& decoded, int image) {
  takePixels(uint64_t{decoded.width} * decoded.height, 0, at("images", static_cast<size_t>(image)));
  return decoded;
}

void ImageDecoder::takePixels(uint64_t pixels, uint64_t bytes, const std::string& field) {
  pixels_ += pixels;
  bytes_ += bytes;
  const uint64_t limit = kBasePixels + kPixelsOfByte * bytes_;
  if (pixels_ <= limit) return;
  document_.fail(field,
                 "brings the file's images to " + std::to_string(pixels_ / 1'000'000) +
                     " million pixels, more than the " + std::to_string(limit / 1'000'000) + " million that their " +
                     std::to_string(bytes_) + " bytes may hold",
                 "make them smaller");
}

}  // namespace lensgraph::engine::gltf
