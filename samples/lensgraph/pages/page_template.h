// Fills a text template with values, escaped for HTML: the part of Mustache that the demo's page needs.
//
//   {{name}}                 the value as text, escaped
//   {{#name}}…{{/name}}      once for each element of an array, or once when it is true; inside, an element's
//   fields
//                            are found first, then those around it
//   {{^name}}…{{/name}}      when it is false, null or an empty array
// Does not do: partials, comments, unescaped values, other delimiters.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace lensgraph::cli {

/// & < > " ' as entities: safe in text and in quoted attributes.
std::string escapeHtml(std::string_view text);

/// Throws std::logic_error on a name without a value and on sections that do not match.
std::string fillTemplate(std::string_view text, const nlohmann::json& values);

}  // namespace lensgraph::cli
