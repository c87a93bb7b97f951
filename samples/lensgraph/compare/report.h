// A comparison as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "samples/lensgraph/compare/comparison.h"

namespace lensgraph::cli {

/// One picture: {"picture", "reference", "exposureEv", figures…}. Several: {"reference", "exposureEv", "pictures":
/// [{"picture", figures…}, …]}. Figures: those of host::toJson(), "maxErrorLinear", "pixelCount", "nonFiniteReference",
/// "hdrFlip" and "hdrFlipExposures"; "masks" only where there are any.
nlohmann::ordered_json reportJson(const Comparison& comparison);

/// One picture: a line for each figure. Several: a table with a row for each. A table for each mask follows.
std::string reportText(const Comparison& comparison);

}  // namespace lensgraph::cli
