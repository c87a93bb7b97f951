// The files that a shot's picture is made from, and a hash of their content.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "samples/host/shot.h"

namespace lensgraph::host {

/// The shot file, the files of its scene with the buffers and images that .gltf files name, its environment. Files that are
/// missing are in the list too; a .gltf that cannot be read names none.
std::vector<std::filesystem::path> filesOf(const Shot& shot);

/// FNV-1a over the bytes of the files in this order, as 16 hexadecimal digits. Unreadable files count as empty.
std::string hashOfFiles(const std::vector<std::filesystem::path>& files);

/// The same of a text.
std::string hashOfText(std::string_view text);

}  // namespace lensgraph::host
