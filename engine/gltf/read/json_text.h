// The JSON of a glTF file, from text. Private to engine/gltf.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "engine/gltf/read/source.h"

namespace lensgraph::engine::gltf {

/// Throws Error: no JSON (with line and column), nested deeper than 100 levels, an object that gives a member twice.
nlohmann::json parseJson(const Source& source, std::string_view text);

}  // namespace lensgraph::engine::gltf
