// How a benchmark names what it measures, in its results and in file names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "samples/host/technique_choice.h"

namespace lensgraph::cli {

/// "railings" for railings.json and for railings/shot.json.
std::string shotId(const std::filesystem::path& shot);

/// "multiview_synthesis lensSamples=8 views=4": the technique, and what was set, by name.
std::string variantId(const host::TechniqueChoice& choice);

/// The text with everything but letters, digits, '.', '-' and '_' replaced by '_': fit for a file name. Texts that differ
/// in other characters alone become the same.
std::string fileNameOf(std::string_view text);

}  // namespace lensgraph::cli
