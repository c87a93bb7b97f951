// Bytes behind paths and URIs: regular files and data URIs (RFC 2397). Private to engine/gltf.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gltf/read/source.h"

namespace lensgraph::engine::gltf {

/// The first `atMost` bytes of a regular file. None when there are none, and `reason` says why. What is no regular file
/// (pipe, socket, device) is never opened: opening alone may block, and reading may have no end.
std::optional<std::vector<uint8_t>> fileBytes(const std::filesystem::path& path, uint64_t atMost, std::string& reason);

bool isDataUri(std::string_view uri);

/// The first `atMost` bytes behind a URI: a data URI, base64 or not, percent-encoded or not; or a file, by its
/// percent-encoded name relative to the glTF file. Throws Error that names the field.
std::vector<uint8_t> readUri(const Source& source, std::string_view uri, uint64_t atMost, const std::string& field);

}  // namespace lensgraph::engine::gltf
