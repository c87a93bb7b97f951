// The outermost layer of a file: JSON text, alone or in a GLB container with a binary chunk. Private to engine/gltf.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "engine/gltf/read/source.h"

namespace lensgraph::engine::gltf {

/// Views into the file's bytes.
struct Container {
  std::string_view json;
  std::optional<std::span<const uint8_t>> binary;
};

/// Tells .gltf and .glb apart by content. Throws Error: empty, neither of them, truncated, damaged, glTF 1.0.
Container splitContainer(const Source& source, std::span<const uint8_t> bytes);

/// Throws the error for files of the first version of glTF.
[[noreturn]] void failVersion1(const Source& source);

}  // namespace lensgraph::engine::gltf
