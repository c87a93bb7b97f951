// Strings as JSON.
#pragma once

#include <string>
#include <string_view>

namespace lensgraph::rendergraph {

/// The text in quotes, with what JSON wants escaped. UTF-8 passes through.
inline std::string jsonString(std::string_view text) {
  constexpr char kHex[] = "0123456789abcdef";
  std::string out = "\"";
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20) {
      out += "\\u00";
      out += kHex[byte >> 4];
      out += kHex[byte & 15];
    } else {
      out += c;
    }
  }
  return out + '"';
}

}  // namespace lensgraph::rendergraph
