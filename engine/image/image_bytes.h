// The bytes of a picture file. Private to engine/image.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace lensgraph::engine {

/// The whole content of a regular file. Devices, pipes and sockets are never opened, so that reading cannot block.
/// Throws Error that names the file: missing, a folder, not a regular file, empty or unreadable.
std::vector<std::byte> readImageBytes(const std::filesystem::path& path);

}  // namespace lensgraph::engine
