// Buffers and buffer views of a file. A buffer is opened, and a compressed view decoded, when its bytes are first asked
// for: what nothing drawn uses may be missing or damaged. Private to engine/gltf.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/gltf/read/meshopt.h"
#include "engine/gltf/read/source.h"

namespace lensgraph::engine::gltf {

class Buffers {
 public:
  /// Takes `buffers` and `bufferViews` out of a checked document. `binary` is the binary chunk of a .glb, if it has one.
  Buffers(Source source, nlohmann::json& root, std::optional<std::vector<uint8_t>> binary);

  /// The bytes of a buffer view, decompressed, valid as long as this object. Throws Error: missing or short file, range
  /// outside the buffer, damaged stream.
  std::span<const uint8_t> viewBytes(int view);
  /// byteStride of a view; 0 where elements are packed.
  size_t strideOf(int view) const { return views_[static_cast<size_t>(view)].byteStride; }

  /// Bytes that were read so far, and bytes that streams were decoded to.
  uint64_t bytesRead() const { return bytesRead_; }
  uint64_t bytesDecoded() const { return bytesDecoded_; }

 private:
  struct Buffer {
    std::string uri;
    uint64_t byteLength = 0;
    std::optional<std::vector<uint8_t>> bytes;  ///< None until asked for.
  };
  struct View {
    size_t buffer = 0;
    uint64_t byteOffset = 0, byteLength = 0;
    size_t byteStride = 0;
    std::optional<MeshoptView> compression;
    std::optional<std::vector<uint8_t>> decoded;  ///< None until asked for.
  };

  const std::vector<uint8_t>& bufferBytes(size_t index);
  std::span<const uint8_t> range(size_t buffer, uint64_t offset, uint64_t length, const std::string& field);

  Source source_;
  std::optional<std::vector<uint8_t>> binary_;
  std::vector<Buffer> buffers_;
  std::vector<View> views_;
  uint64_t bytesRead_ = 0, bytesDecoded_ = 0;
};

}  // namespace lensgraph::engine::gltf
