// What reading and writing of picture files share: the formats, and how a file is refused. Private to engine/image.
#pragma once

#include <filesystem>
#include <string>

#include "engine/error.h"

namespace lensgraph::engine {

enum class ImageFormat { exr, png, hdr };

/// By the extension, in any case of letters. Throws Error for an unknown one.
ImageFormat imageFormatOf(const std::filesystem::path& path);

/// Throws Error that names the file.
[[noreturn]] void failImage(const std::filesystem::path& path, const std::string& reason,
                            const std::string& remedy = {}, ErrorKind kind = ErrorKind::badInput);

}  // namespace lensgraph::engine
