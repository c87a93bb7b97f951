// Values inside JSON documents that may be absent.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace lensgraph::cli {

/// The value at a JSON pointer such as "/quality/psnr"; null where there is none.
inline nlohmann::ordered_json valueAt(const nlohmann::ordered_json& value, const std::string& pointer) {
  const nlohmann::ordered_json::json_pointer at(pointer);
  return value.contains(at) ? value[at] : nlohmann::ordered_json();
}

}  // namespace lensgraph::cli
