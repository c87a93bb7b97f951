// Checks what EXT_meshopt_compression asks for and decodes it.
#include "engine/gltf/read/meshopt.h"

#include <meshoptimizer.h>

namespace lensgraph::engine::gltf {
namespace {

// The first byte of a stream: its kind in the high half, its version in the low.
constexpr uint8_t kAttributeStream = 0xA0, kTriangleStream = 0xE0, kIndexStream = 0xD0;

class Decoder {
 public:
  Decoder(const Source& source, const MeshoptView& view, std::span<const uint8_t> stream, const std::string& field)
      : source_(source), view_(view), stream_(stream), field_(field) {}

  std::vector<uint8_t> decode() const {
    if (view_.mode == "ATTRIBUTES") return attributes();
    if (view_.mode == "TRIANGLES" || view_.mode == "INDICES") return indices();
    source_.fail(field_ + ".mode", "'" + view_.mode + "' is none of ATTRIBUTES, TRIANGLES, INDICES");
  }

 private:
  std::vector<uint8_t> attributes() const {
    if (view_.byteStride == 0 || view_.byteStride % 4 != 0 || view_.byteStride > 256) failStride();
    requireKind(kAttributeStream);
    std::vector<uint8_t> bytes = room();
    requireSuccess(
        meshopt_decodeVertexBuffer(bytes.data(), view_.count, view_.byteStride, stream_.data(), stream_.size()));
    applyFilter(bytes);
    return bytes;
  }

  std::vector<uint8_t> indices() const {
    if (view_.byteStride != 2 && view_.byteStride != 4) failStride();
    if (view_.filter != "NONE") source_.fail(field_ + ".filter", "is only for the mode ATTRIBUTES");
    const bool isTriangles = view_.mode == "TRIANGLES";
    if (isTriangles && view_.count % 3 != 0) source_.fail(field_ + ".count", "is not a multiple of 3");
    requireKind(isTriangles ? kTriangleStream : kIndexStream);
    std::vector<uint8_t> bytes = room();
    requireSuccess(
        isTriangles
            ? meshopt_decodeIndexBuffer(bytes.data(), view_.count, view_.byteStride, stream_.data(), stream_.size())
            : meshopt_decodeIndexSequence(bytes.data(), view_.count, view_.byteStride, stream_.data(), stream_.size()));
    return bytes;
  }

  void applyFilter(std::vector<uint8_t>& bytes) const {
    const uint64_t stride = view_.byteStride;
    const auto require = [&](bool isAllowed) {
      if (!isAllowed) failStride();
    };
    if (view_.filter == "NONE") return;
    if (view_.filter == "OCTAHEDRAL") {
      require(stride == 4 || stride == 8);
      meshopt_decodeFilterOct(bytes.data(), view_.count, stride);
    } else if (view_.filter == "QUATERNION") {
      require(stride == 8);
      meshopt_decodeFilterQuat(bytes.data(), view_.count, stride);
    } else if (view_.filter == "EXPONENTIAL") {
      meshopt_decodeFilterExp(bytes.data(), view_.count, stride);
    } else {
      source_.fail(field_ + ".filter", "'" + view_.filter + "' is none of NONE, OCTAHEDRAL, QUATERNION, EXPONENTIAL");
    }
  }

  // Zeros for what is to be decoded.
  std::vector<uint8_t> room() const {
    const uint64_t limit = kMeshoptBytesOfOne * stream_.size();
    if (view_.count > limit / view_.byteStride) {
      source_.fail(field_ + ".count", std::to_string(view_.count) + " elements of " + std::to_string(view_.byteStride) +
                                          " bytes are more than a stream of " + std::to_string(stream_.size()) +
                                          " bytes holds");
    }
    return std::vector<uint8_t>(view_.count * view_.byteStride);
  }

  // Version 0 is that of EXT_meshopt_compression; index streams also have a version 1.
  void requireKind(uint8_t kind) const {
    const uint8_t first = stream_.empty() ? 0 : stream_[0];
    if ((first & 0xF0) != kind) failStream("does not hold what its mode " + view_.mode + " says");
    if ((first & 0x0F) > (kind == kAttributeStream ? 0 : 1))
      source_.fail(field_, view_.extension + ": its stream is of a newer version, which is not read",
                   "export with EXT_meshopt_compression");
  }

  void requireSuccess(int result) const {
    if (result != 0) failStream("is damaged");
  }

  [[noreturn]] void failStream(const std::string& reason) const {
    source_.fail(field_, view_.extension + ": its stream " + reason);
  }
  [[noreturn]] void failStride() const {
    source_.fail(field_ + ".byteStride", std::to_string(view_.byteStride) + " is not allowed for " + view_.mode +
                                             " with filter " + view_.filter);
  }

  const Source& source_;
  const MeshoptView& view_;
  std::span<const uint8_t> stream_;
  const std::string& field_;
};

}  // namespace

std::vector<uint8_t> decodeMeshopt(const Source& source, const MeshoptView& view, std::span<const uint8_t> stream,
                                   const std::string& field) {
  return Decoder(source, view, stream, field).decode();
}

}  // namespace lensgraph::engine::gltf
