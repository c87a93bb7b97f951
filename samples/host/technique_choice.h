// Which technique with which parameters: from a shot file, a configuration file, and the command line.
//
// The techniques are those of the registry and `raytraced`, which the graph does not know (samples/host/raytraced.h).
// Names, types and ranges are checked against their lists, so that a choice that exists is a legal one; what
// needs the inputs to be seen (ConfiguredTechnique::validate) is checked when it renders.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "passes/parameters.h"
#include "passes/registry/registry.h"

namespace lensgraph::host {

class JsonNode;

struct TechniqueChoice {
  std::string name;
  passes::ParameterSet parameters;
};

/// All techniques that a user can name.
std::span<const passes::Technique> techniques();

/// The technique of that name. Throws engine::Error with the nearest name; `file` and `field` say who asked.
const passes::Technique& requireTechnique(std::string_view name, const std::string& file, const std::string& field);

/// The same, for a name that stands in a file.
const passes::Technique& requireTechnique(const JsonNode& node, std::string_view name);

/// The value of a parameter: a boolean, a number or a string. Throws engine::Error for others.
passes::ParameterValue parameterValue(const JsonNode& node);

/// {"name": …, parameters…}. Without "name" the parameters are for `defaultName`; empty: "name" must be
/// there.
TechniqueChoice parseTechnique(const JsonNode& node, std::string_view defaultName = {});

/// A file {"technique": {"name": …, parameters…}}. Throws engine::Error.
TechniqueChoice readTechniqueFile(const std::filesystem::path& file, std::string_view defaultName);

/// One assignment "key=value" as the command line gives it. Throws engine::Error; the choice is then
/// unchanged.
void setParameter(TechniqueChoice& choice, std::string_view assignment);

}  // namespace lensgraph::host
