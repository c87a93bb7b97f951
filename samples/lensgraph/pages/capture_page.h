// The page of `lensgraph capture-view`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lensgraph::cli {

/// Whether the program was built with the libraries that draw the page.
bool canMakeCapturePages();

/// One self-contained HTML document that draws a checked capture (CaptureFacts::document).
/// Precondition: canMakeCapturePages().
std::string capturePage(const nlohmann::json& capture);

}  // namespace lensgraph::cli
