// Splits a file into its chunks (glTF 2.0 §4.4).
#include "engine/gltf/read/container.h"

#include <algorithm>
#include <string>

namespace lensgraph::engine::gltf {
namespace {

uint32_t littleEndian32(const uint8_t* bytes) {
  return uint32_t{bytes[0]} | uint32_t{bytes[1]} << 8 | uint32_t{bytes[2]} << 16 | uint32_t{bytes[3]} << 24;
}

std::string_view asText(std::span<const uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// 12 byte header, then chunks of length, type, data.
Container splitGlb(const Source& source, std::span<const uint8_t> bytes) {
  constexpr uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
  const std::string remedy = "export or copy the file again";
  if (bytes.size() < 20) source.fail("", "truncated .glb: " + std::to_string(bytes.size()) + " bytes", remedy);
  const uint32_t version = littleEndian32(bytes.data() + 4);
  if (version == 1) failVersion1(source);
  if (version != 2) source.fail("", "glTF binary version " + std::to_string(version) + ", only 2 is read");
  const uint32_t length = littleEndian32(bytes.data() + 8);
  if (length > bytes.size()) {
    source.fail("", "truncated .glb: " + std::to_string(bytes.size()) + " of " + std::to_string(length) + " bytes",
                remedy);
  }
  bytes = bytes.first(std::max(length, 12u));
  Container chunks;
  for (size_t offset = 12; bytes.size() - offset >= 8;) {
    const size_t chunkLength = littleEndian32(bytes.data() + offset);
    const uint32_t type = littleEndian32(bytes.data() + offset + 4);
    if (chunkLength > bytes.size() - offset - 8) source.fail("", "damaged .glb: a chunk reaches past the end", remedy);
    const auto data = bytes.subspan(offset + 8, chunkLength);
    if (offset == 12 && type != kJsonChunk) source.fail("", "damaged .glb: the first chunk is not JSON", remedy);
    if (offset == 12) chunks.json = asText(data);
    if (offset != 12 && type == kBinaryChunk && !chunks.binary) chunks.binary = data;
    offset += 8 + chunkLength;
  }
  // Some writers pad the JSON with zeros instead of blanks.
  while (chunks.json.ends_with('\0')) chunks.json.remove_suffix(1);
  if (chunks.json.empty()) source.fail("", "damaged .glb: no JSON chunk", remedy);
  return chunks;
}

}  // namespace

Container splitContainer(const Source& source, std::span<const uint8_t> bytes) {
  if (bytes.empty()) source.fail("", "is empty (0 bytes)");
  if (asText(bytes).starts_with("glTF")) return splitGlb(source, bytes);
  std::string_view text = asText(bytes);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos || (text[start] != '{' && text[start] != '[')) {
    source.fail("", "is neither glTF nor GLB");
  }
  return {.json = text, .binary = std::nullopt};
}

void failVersion1(const Source& source) {
  source.fail("", "is glTF 1.0, which is not read", "convert it to glTF 2.0");
}

}  // namespace lensgraph::engine::gltf
