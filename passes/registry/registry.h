// All techniques by name. A new technique is one folder and one line in registry.cpp.
#pragma once

#include <span>
#include <string_view>

#include "passes/technique.h"

namespace lensgraph::passes {

std::span<const Technique> techniques();
/// Null when there is none of that name.
const Technique* findTechnique(std::string_view name);
/// The most similar name, to suggest; empty when none is near.
std::string_view nearestTechniqueName(std::string_view name);

}  // namespace lensgraph::passes
