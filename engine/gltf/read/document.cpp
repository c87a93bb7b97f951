// From a file's bytes to a checked document: container, JSON, buffers, extensions.
//
// tinygltf gets only JSON that has been checked, without buffers, images and animations. Its own handling of
// those reads past the end of truncated .glb files, forms pointers outside buffers for image views, refuses
// external buffers longer than byteLength (legal), and turns '+' in file names into blanks; so they are read
// here.
#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "engine/error.h"
#include "engine/gltf/check.h"
#include "engine/gltf/internal.h"

namespace lensgraph::engine::gltf {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Deeper JSON than this is no glTF file but an attack on recursive readers, such as tinygltf's of "extras".
constexpr int kMaxNesting = 100;

constexpr std::string_view kReadExtensions[] = {
    "KHR_lights_punctual",   "KHR_materials_emissive_strength", "KHR_materials_unlit",
    "KHR_mesh_quantization", "KHR_texture_transform",
};

bool isReadExtension(const std::string& name) {
  return std::find(std::begin(kReadExtensions), std::end(kReadExtensions), name) != std::end(kReadExtensions);
}

// Bytes of a file; `reason` says why not when there are none.
std::optional<std::vector<uint8_t>> fileBytes(const fs::path& path, std::string& reason) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    reason = "no such file";
    return std::nullopt;
  }
  if (fs::is_directory(status)) {
    reason = "is a folder";
    return std::nullopt;
  }
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  const std::streamoff length = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  std::vector<uint8_t> bytes(length > 0 ? static_cast<size_t>(length) : 0);
  if (length >= 0) stream.seekg(0).read(reinterpret_cast<char*>(bytes.data()), length);
  if (!stream || length < 0) {
    reason = "cannot be read";
    return std::nullopt;
  }
  return bytes;
}

// ---- Container

struct Chunks {
  std::string_view json;
  std::optional<std::span<const uint8_t>> binary;
};

uint32_t littleEndian32(const uint8_t* bytes) {
  return uint32_t{bytes[0]} | uint32_t{bytes[1]} << 8 | uint32_t{bytes[2]} << 16 | uint32_t{bytes[3]} << 24;
}

std::string_view asText(std::span<const uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// glTF 2.0 §4.4: 12 byte header, then chunks of length, type, data.
Chunks splitGlb(const Document& document, std::span<const uint8_t> bytes) {
  constexpr uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
  const std::string remedy = "export or copy the file again";
  if (bytes.size() < 20) document.fail("", "truncated .glb: " + std::to_string(bytes.size()) + " bytes", remedy);
  if (const uint32_t version = littleEndian32(bytes.data() + 4); version != 2) {
    document.fail("", "glTF binary version " + std::to_string(version) + ", only 2 is read");
  }
  const uint32_t length = littleEndian32(bytes.data() + 8);
  if (length > bytes.size()) {
    document.fail("", "truncated .glb: " + std::to_string(bytes.size()) + " of " + std::to_string(length) + " bytes",
                  remedy);
  }
  bytes = bytes.first(std::max(length, 12u));
  Chunks chunks;
  for (size_t offset = 12; bytes.size() - offset >= 8;) {
    const size_t chunkLength = littleEndian32(bytes.data() + offset);
    const uint32_t type = littleEndian32(bytes.data() + offset + 4);
    if (chunkLength > bytes.size() - offset - 8)
      document.fail("", "damaged .glb: a chunk reaches past the end", remedy);
    const auto data = bytes.subspan(offset + 8, chunkLength);
    if (offset == 12 && type != kJsonChunk) document.fail("", "damaged .glb: the first chunk is not JSON", remedy);
    if (offset == 12) chunks.json = asText(data);
    if (offset != 12 && type == kBinaryChunk && !chunks.binary) chunks.binary = data;
    offset += 8 + chunkLength;
  }
  // Some writers pad the JSON with zeros instead of blanks.
  while (chunks.json.ends_with('\0')) chunks.json.remove_suffix(1);
  if (chunks.json.empty()) document.fail("", "damaged .glb: no JSON chunk", remedy);
  return chunks;
}

Chunks splitContainer(const Document& document, std::span<const uint8_t> bytes) {
  if (bytes.empty()) document.fail("", "is empty (0 bytes)");
  if (asText(bytes).starts_with("glTF")) return splitGlb(document, bytes);
  std::string_view text = asText(bytes);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return {.json = text, .binary = std::nullopt};
}

// ---- JSON

void requireShallow(const Document& document, std::string_view text) {
  int depth = 0;
  bool isInString = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (isInString) {
      if (c == '\\') ++i;
      if (c == '"') isInString = false;
      continue;
    }
    if (c == '"') isInString = true;
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth > kMaxNesting)
      document.fail("", "its JSON is nested deeper than " + std::to_string(kMaxNesting) + " levels");
  }
}

Json parseJson(const Document& document, std::string_view text) {
  requireShallow(document, text);
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: …": the bracket says nothing to a
    // user.
    const std::string_view message = error.what();
    const size_t start = message.find("] ");
    document.fail("", "is not valid glTF JSON: " +
                          std::string(start == std::string_view::npos ? message : message.substr(start + 2)));
  }
}

void checkVersionAndExtensions(Document& document, const Json& root) {
  const std::string version = root["asset"]["version"].get<std::string>();
  if (!version.starts_with("2."))
    document.fail("asset.version", "glTF " + version + " is not read", "convert it to glTF 2.0");
  std::string unread;
  for (const Json& name : root.value("extensionsRequired", Json::array())) {
    if (!isReadExtension(name)) unread += (unread.empty() ? "" : ", ") + name.get<std::string>();
  }
  if (!unread.empty()) {
    document.fail("extensionsRequired", "needs " + unread + ", which is not supported", "export without it");
  }
  for (const Json& name : root.value("extensionsUsed", Json::array())) {
    if (!isReadExtension(name)) document.warn("extension " + name.get<std::string>() + " is ignored");
  }
}

// ---- URIs

std::optional<std::vector<uint8_t>> fromBase64(std::string_view text) {
  const auto valueOf = [](char c) -> int {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
  };
  while (text.ends_with('=')) text.remove_suffix(1);
  std::vector<uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0;
  int bitCount = 0;
  for (char c : text) {
    const int value = valueOf(c);
    if (value < 0) return std::nullopt;
    bits = (bits << 6 | static_cast<uint32_t>(value)) & 0xFFFFu;
    bitCount += 6;
    if (bitCount < 8) continue;
    bitCount -= 8;
    bytes.push_back(static_cast<uint8_t>(bits >> bitCount));
  }
  return bytes;
}

std::string percentDecoded(std::string_view uri) {
  const auto hexOf = [](char c) -> int {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
  };
  std::string text;
  for (size_t i = 0; i < uri.size(); ++i) {
    const int high = i + 2 < uri.size() && uri[i] == '%' ? hexOf(uri[i + 1]) : -1;
    const int low = high >= 0 ? hexOf(uri[i + 2]) : -1;
    if (low < 0) {
      text += uri[i];
      continue;
    }
    text += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return text;
}

// ---- Buffers and images

std::vector<uint8_t> bufferBytes(const Document& document, const Json& buffer, size_t index, const Chunks& chunks) {
  const uint64_t byteLength = buffer["byteLength"].get<uint64_t>();
  std::vector<uint8_t> bytes;
  if (buffer.contains("uri")) {
    bytes = readUri(document, buffer["uri"].get<std::string>(), at("buffers", index, ".uri"));
  } else if (index == 0 && chunks.binary) {
    bytes.assign(chunks.binary->begin(), chunks.binary->end());
  } else {
    document.fail(at("buffers", index, ".uri"), "is missing and there is no binary chunk to take its place");
  }
  if (bytes.size() < byteLength) {
    document.fail(at("buffers", index, ".byteLength"),
                  "promises " + std::to_string(byteLength) + " bytes, there are " + std::to_string(bytes.size()));
  }
  bytes.resize(byteLength);
  return bytes;
}

// Takes buffers and images out of the JSON into the model; tinygltf never sees them.
void takeBinaries(Json& root, const Chunks& chunks, std::vector<tinygltf::Buffer>& buffers,
                  std::vector<tinygltf::Image>& images, const Document& document) {
  const Json bufferList = root.value("buffers", Json::array());
  for (size_t i = 0; i < bufferList.size(); ++i) {
    buffers.emplace_back().data = bufferBytes(document, bufferList[i], i, chunks);
  }
  for (const Json& source : root.value("images", Json::array())) {
    tinygltf::Image& image = images.emplace_back();
    image.name = source.value("name", std::string());
    image.uri = source.value("uri", std::string());
    image.bufferView = source.value("bufferView", -1);
  }
  root.erase("buffers");
  root.erase("images");
}

}  // namespace

void Document::fail(const std::string& field, const std::string& reason, const std::string& remedy) const {
  throw Error(ErrorParts{.file = file, .field = field, .reason = reason, .remedy = remedy});
}

void Document::warn(const std::string& text) {
  std::string line = file + ": " + text;
  if (std::find(warnings.begin(), warnings.end(), line) == warnings.end()) warnings.push_back(std::move(line));
}

std::string at(const char* array, size_t index, const std::string& member) {
  return std::string(array) + "[" + std::to_string(index) + "]" + member;
}

std::vector<uint8_t> readUri(const Document& document, const std::string& uri, const std::string& field) {
  const std::string_view text = uri;
  if (text.starts_with("data:")) {
    constexpr std::string_view kBase64 = ";base64,";
    const size_t start = text.find(kBase64);
    if (start == std::string_view::npos) document.fail(field, "data URI is not base64");
    auto bytes = fromBase64(text.substr(start + kBase64.size()));
    if (!bytes) document.fail(field, "data URI holds characters that are not base64");
    return std::move(*bytes);
  }
  if (text.find("://") != std::string_view::npos) {
    document.fail(field, "'" + uri.substr(0, 80) + "' is not a local file", "download it and make the URI relative");
  }
  const std::string name = percentDecoded(text);
  if (name.empty()) document.fail(field, "is empty");
  std::string reason;
  auto bytes = fileBytes(document.folder / name, reason);
  if (!bytes) document.fail(field, "'" + name + "': " + reason, "put it beside the glTF file");
  return std::move(*bytes);
}

Document readDocument(const fs::path& path) {
  Document document;
  document.file = path.string();
  document.folder = path.parent_path();
  std::string reason;
  const auto bytes = fileBytes(path, reason);
  if (!bytes) document.fail("", reason);

  const Chunks chunks = splitContainer(document, *bytes);
  Json root = parseJson(document, chunks.json);
  checkStructure(root, document.file);
  checkVersionAndExtensions(document, root);
  if (!root.value("animations", Json::array()).empty()) document.warn("animations are ignored, the rest pose is drawn");
  root.erase("animations");
  std::vector<tinygltf::Buffer> buffers;
  std::vector<tinygltf::Image> images;
  takeBinaries(root, chunks, buffers, images, document);

  const std::string text = root.dump();
  tinygltf::TinyGLTF loader;
  std::string errors, warnings;
  if (!loader.LoadASCIIFromString(&document.model, &errors, &warnings, text.data(), static_cast<unsigned>(text.size()),
                                  "", tinygltf::NO_REQUIRE)) {
    document.fail("", "is not valid glTF: " + errors);
  }
  document.model.buffers = std::move(buffers);
  document.model.images = std::move(images);
  return document;
}

}  // namespace lensgraph::engine::gltf
