// Files that are there whole or not at all: written under another name beside the place, then renamed.
#pragma once

#include <filesystem>
#include <functional>
#include <system_error>

namespace scenes {

/// Calls `write` with the temporary name, which has the extension of `file`. What `write` throws is passed on, and the
/// temporary file removed; a program that is killed leaves it.
inline void writeWhole(const std::filesystem::path& file,
                       const std::function<void(const std::filesystem::path&)>& write) {
  const std::filesystem::path temporary = file.parent_path() / ("unfinished-" + file.filename().string());
  try {
    write(temporary);
    std::filesystem::rename(temporary, file);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

}  // namespace scenes
