// Regular files, percent-encoding and base64.
#include "engine/gltf/read/uri.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <system_error>

namespace lensgraph::engine::gltf {
namespace {

namespace fs = std::filesystem;

bool startsWithIgnoringCase(std::string_view text, std::string_view lowercase) {
  return text.size() >= lowercase.size() &&
         std::equal(lowercase.begin(), lowercase.end(), text.begin(),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

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
  text.reserve(uri.size());
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

// data:[media type][;base64],data
std::vector<uint8_t> dataBytes(const Source& source, std::string_view uri, const std::string& field) {
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos) source.fail(field, "data URI has no comma before its data");
  constexpr std::string_view kBase64 = ";base64";
  const std::string_view header = uri.substr(0, comma);
  const bool isBase64 =
      header.size() >= kBase64.size() && startsWithIgnoringCase(header.substr(header.size() - kBase64.size()), kBase64);
  std::string data = percentDecoded(uri.substr(comma + 1));
  if (!isBase64) return {data.begin(), data.end()};
  std::erase_if(data, [](unsigned char c) { return std::isspace(c); });
  auto bytes = fromBase64(data);
  if (!bytes) source.fail(field, "data URI holds characters that are not base64");
  return std::move(*bytes);
}

}  // namespace

std::optional<std::vector<uint8_t>> fileBytes(const fs::path& path, uint64_t atMost, std::string& reason) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    reason = "no such file";
  } else if (fs::is_directory(status)) {
    reason = "is a folder";
  } else if (!fs::is_regular_file(status)) {
    reason = "is not a file";
  } else {
    std::ifstream stream(path, std::ios::binary | std::ios::ate);
    const std::streamoff end = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
    if (end >= 0) {
      std::vector<uint8_t> bytes(std::min(static_cast<uint64_t>(end), atMost));
      stream.seekg(0).read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
      if (stream) return bytes;
    }
    reason = "cannot be read";
  }
  return std::nullopt;
}

bool isDataUri(std::string_view uri) {
  return startsWithIgnoringCase(uri, "data:");
}

std::vector<uint8_t> readUri(const Source& source, std::string_view uri, uint64_t atMost, const std::string& field) {
  if (isDataUri(uri)) {
    std::vector<uint8_t> bytes = dataBytes(source, uri, field);
    bytes.resize(std::min<uint64_t>(bytes.size(), atMost));
    return bytes;
  }
  if (uri.find("://") != std::string_view::npos) {
    source.fail(field, "'" + std::string(uri) + "' is not a local file", "download it and make the URI relative");
  }
  const std::string name = percentDecoded(uri);
  if (name.empty()) source.fail(field, "is empty");
  // The file system would see the name end there.
  if (name.find('\0') != std::string::npos) source.fail(field, "'" + name + "': no such file");
  std::string reason;
  auto bytes = fileBytes(source.folder / name, atMost, reason);
  if (!bytes) source.fail(field, "'" + name + "': " + reason, "put it beside the glTF file");
  return std::move(*bytes);
}

}  // namespace lensgraph::engine::gltf
