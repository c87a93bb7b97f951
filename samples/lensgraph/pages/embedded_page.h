// What the program's self-contained pages share: the libraries that draw them, and the filling of a page with scripts and
// data. Pages load nothing from elsewhere, which their Content-Security-Policy enforces.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace lensgraph::cli {

/// The text of an array that cmake/embed_text.cmake filled. The length of an array is known; measuring half a megabyte at
/// compile time is beyond compilers' limits.
template <std::size_t Size>
std::string_view textOf(const char (&array)[Size]) {
  return {array, Size - 1};
}

/// d3 with its license as one script; empty when the program was built without it.
std::string_view d3Script();
/// dagre with its license as one script; empty when the program was built without it.
std::string_view dagreScript();

/// Throws engine::Error (kind failed) that names `command`, such as "bench", when the program was built without d3.
void requireD3(std::string_view command);

/// Replaces the first `mark` of the page, such as "/*data*/". Precondition: the page has the mark.
void put(std::string& page, std::string_view mark, std::string_view content);

/// JSON that cannot end the <script> element it stands in, whatever strings it holds.
std::string embedded(const nlohmann::json& value);
std::string embedded(const nlohmann::ordered_json& value);

}  // namespace lensgraph::cli
