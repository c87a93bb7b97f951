// Which glTF file is being read: where its relative URIs start, and errors that name it. Private to engine/gltf.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace lensgraph::engine::gltf {

struct Source {
  std::string file;              ///< As the user gave it, for messages.
  std::filesystem::path folder;  ///< Where relative URIs start.

  /// Throws Error.
  [[noreturn]] void fail(const std::string& field, const std::string& reason, const std::string& remedy = {}) const;
};

/// "array[index]member" as it stands in messages.
std::string at(const char* array, size_t index, const std::string& member = {});

}  // namespace lensgraph::engine::gltf
