// A 5×7 dot face: capital letters, digits, a little punctuation. Ours, drawn for these scenes.
#pragma once

#include <array>
#include <string_view>

namespace scenes {

inline constexpr int kGlyphWidth = 5;
inline constexpr int kGlyphHeight = 7;

struct Glyph {
  std::array<std::string_view, kGlyphHeight> rows;  ///< '#' is ink.

  bool has(int x, int y) const {
    return x >= 0 && x < kGlyphWidth && y >= 0 && y < kGlyphHeight &&
           rows[static_cast<size_t>(y)][static_cast<size_t>(x)] == '#';
  }
};

/// A character that the face lacks is blank.
const Glyph& glyphOf(char character);

}  // namespace scenes
