// Buffer views compressed with EXT_meshopt_compression. The only user of libmeshoptimizer. Private to engine/gltf.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/gltf/read/source.h"

namespace lensgraph::engine::gltf {

/// The extension's object in a buffer view, with its members' types checked and nothing else.
struct MeshoptView {
  std::string extension;  ///< EXT_meshopt_compression, or KHR_meshopt_compression, which holds the same and more.
  size_t buffer = 0;      ///< Holds the stream.
  uint64_t byteOffset = 0, byteLength = 0;
  uint64_t byteStride = 0, count = 0;
  std::string mode;
  std::string filter = "NONE";
};

/// The densest stream spends two bits on sixteen bytes; its header and tail only make it longer.
inline constexpr uint64_t kMeshoptBytesOfOne = 64;

/// The count · byteStride bytes that a stream stands for. Throws Error naming `field`: values that the extension does
/// not allow, more bytes than a stream of that length can hold, a damaged stream, one of a newer version.
std::vector<uint8_t> decodeMeshopt(const Source& source, const MeshoptView& view, std::span<const uint8_t> stream,
                                   const std::string& field);

}  // namespace lensgraph::engine::gltf
