// All techniques by name. docs/new_technique.md says how to add one.
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
