// The headers of an OpenEXR file, read and checked before a library sees them. Private to engine/image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lensgraph::engine {

struct ExrChannel {
  std::string name;
  uint32_t type = 0;  ///< 0: 32-bit unsigned, 1: half, 2: float.
  bool isSubsampled = false;
};

/// px; may lie anywhere around the origin.
struct ExrWindow {
  int64_t x = 0, y = 0, width = 0, height = 0;
};

struct ExrPart {
  std::string name;                  ///< Empty in files of one part without names.
  std::vector<ExrChannel> channels;  ///< In the file's order.
  ExrWindow data, display;
  bool isDeep = false;
};

/// Reads the headers of all parts, and checks that what they claim is within the limits of picture_file.h and can stand
/// in a file of this size. Attributes that decide nothing about pixels are made opaque in place (their type's name becomes
/// one that nobody knows), so that libraries do not interpret them. Throws Error that names the file.
std::vector<ExrPart> readExrHeaders(const std::filesystem::path& path, std::span<std::byte> file);

}  // namespace lensgraph::engine
