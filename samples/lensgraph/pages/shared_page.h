// What the pages with a picture viewer share: the style, the viewer, tables and the switch of light and dark.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace lensgraph::cli {

/// The page with the shared style and parts, d3, its own script and its data. Precondition: requireD3() passes, and the
/// page has the marks /*style*/, /*libraries*/, /*script*/ and /*data*/.
std::string filledPage(std::string_view page, std::string_view script, const nlohmann::ordered_json& data);

}  // namespace lensgraph::cli
