// Opens buffers and decodes buffer views when they are needed.
#include "engine/gltf/read/buffers.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "engine/gltf/read/uri.h"

namespace lensgraph::engine::gltf {
namespace {

using Json = nlohmann::json;

// The extension's object in a buffer view; none in most.
std::optional<MeshoptView> compressionOf(const Json& view) {
  const Json extensions = view.value("extensions", Json::object());
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const auto found = extensions.find(name);
    if (found == extensions.end()) continue;
    MeshoptView result;
    result.extension = name;
    result.buffer = found->at("buffer").get<size_t>();
    result.byteOffset = found->value("byteOffset", uint64_t{0});
    result.byteLength = found->at("byteLength").get<uint64_t>();
    result.byteStride = found->at("byteStride").get<uint64_t>();
    result.count = found->at("count").get<uint64_t>();
    result.mode = found->at("mode").get<std::string>();
    result.filter = found->value("filter", result.filter);
    return result;
  }
  return std::nullopt;
}

}  // namespace

Buffers::Buffers(Source source, Json& root, std::optional<std::vector<uint8_t>> binary)
    : source_(std::move(source)), binary_(std::move(binary)) {
  // The reference keeps megabytes of data URIs from being copied.
  for (Json& from : root["buffers"]) {
    Buffer& buffer = buffers_.emplace_back();
    buffer.byteLength = from["byteLength"].get<uint64_t>();
    if (from.contains("uri")) buffer.uri = std::move(from["uri"].get_ref<std::string&>());
  }
  for (const Json& from : root["bufferViews"]) {
    View& view = views_.emplace_back();
    view.buffer = from["buffer"].get<size_t>();
    view.byteOffset = from.value("byteOffset", uint64_t{0});
    view.byteLength = from["byteLength"].get<uint64_t>();
    view.byteStride = from.value("byteStride", size_t{0});
    view.compression = compressionOf(from);
  }
  root.erase("buffers");
  root.erase("bufferViews");
}

const std::vector<uint8_t>& Buffers::bufferBytes(size_t index) {
  Buffer& buffer = buffers_[index];
  if (buffer.bytes) return *buffer.bytes;
  std::vector<uint8_t> bytes;
  if (!buffer.uri.empty()) {
    bytes = readUri(source_, buffer.uri, buffer.byteLength, at("buffers", index, ".uri"));
    buffer.uri = {};
  } else if (index == 0 && binary_) {
    bytes = std::exchange(binary_, std::nullopt).value();
  } else {
    source_.fail(at("buffers", index, ".uri"), "is missing and there is no binary chunk to take its place");
  }
  if (bytes.size() < buffer.byteLength) {
    source_.fail(at("buffers", index, ".byteLength"),
                 "promises " + std::to_string(buffer.byteLength) + " bytes, there are " + std::to_string(bytes.size()));
  }
  bytes.resize(buffer.byteLength);
  bytesRead_ += bytes.size();
  return buffer.bytes.emplace(std::move(bytes));
}

std::span<const uint8_t> Buffers::range(size_t buffer, uint64_t offset, uint64_t length, const std::string& field) {
  const std::vector<uint8_t>& bytes = bufferBytes(buffer);
  if (offset > bytes.size() || length > bytes.size() - offset) {
    source_.fail(field, "bytes " + std::to_string(offset) + " + " + std::to_string(length) +
                            " are outside its buffer of " + std::to_string(bytes.size()));
  }
  return std::span(bytes).subspan(offset, length);
}

std::span<const uint8_t> Buffers::viewBytes(int index) {
  View& view = views_[static_cast<size_t>(index)];
  const std::string field = at("bufferViews", static_cast<size_t>(index));
  if (!view.compression) return range(view.buffer, view.byteOffset, view.byteLength, field);
  if (!view.decoded) {
    const MeshoptView& compression = *view.compression;
    const std::string streamField = field + ".extensions." + compression.extension;
    const auto stream = range(compression.buffer, compression.byteOffset, compression.byteLength, streamField);
    view.decoded = decodeMeshopt(source_, compression, stream, streamField);
    bytesDecoded_ += view.decoded->size();
    // Only views that share a stream come to more.
    if (bytesDecoded_ > kMeshoptBytesOfOne * bytesRead_)
      source_.fail(streamField, "the file's streams decode to more than " + std::to_string(kMeshoptBytesOfOne) +
                                    " bytes for each of its own");
  }
  // The buffer that the view names is a fallback for readers without the extension, and may hold nothing.
  if (view.byteLength > view.decoded->size()) {
    source_.fail(field + ".byteLength", "promises " + std::to_string(view.byteLength) +
                                            " bytes, its stream decodes to " + std::to_string(view.decoded->size()));
  }
  return std::span(*view.decoded).first(view.byteLength);
}

}  // namespace lensgraph::engine::gltf
