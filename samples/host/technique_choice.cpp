// Technique and parameters from configuration: see technique_choice.h.
#include "samples/host/technique_choice.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "engine/error.h"
#include "samples/host/json_reader.h"
#include "samples/host/raytraced/raytraced_technique.h"

namespace lensgraph::host {
namespace {

constexpr const char* kCommandLine = "command line";

std::string allTechniqueNames() {
  std::string names;
  for (const auto& technique : techniques()) {
    names += (names.empty() ? "" : ", ") + std::string(technique.name);
  }
  return names;
}

const passes::ParameterInfo* findParameter(const passes::Technique& technique, std::string_view name) {
  const auto found = std::find_if(technique.parameters.begin(), technique.parameters.end(),
                                  [&](const auto& info) { return info.name == name; });
  return found == technique.parameters.end() ? nullptr : &*found;
}

const passes::Technique* findTechnique(std::string_view name) {
  const auto all = techniques();
  const auto found = std::ranges::find(all, name, &passes::Technique::name);
  return found == all.end() ? nullptr : &*found;
}

struct Unknown {
  std::string reason, remedy;
};

Unknown unknownTechnique(std::string_view name) {
  std::vector<std::string_view> names;
  for (const auto& technique : techniques()) names.push_back(technique.name);
  const auto nearest = passes::nearestName(name, names);
  return {
      .reason = "unknown technique \"" + std::string(name) + "\"",
      .remedy = nearest.empty() ? "known are " + allTechniqueNames() : "did you mean " + std::string(nearest) + "?"};
}

}  // namespace

std::span<const passes::Technique> techniques() {
  static const std::vector<passes::Technique> all = [] {
    const auto ofGraph = passes::techniques();
    std::vector<passes::Technique> list(ofGraph.begin(), ofGraph.end());
    list.push_back(raytracedTechnique());
    return list;
  }();
  return all;
}

const passes::Technique& requireTechnique(std::string_view name, const std::string& file, const std::string& field) {
  if (const auto* technique = findTechnique(name)) return *technique;
  const Unknown unknown = unknownTechnique(name);
  throw engine::Error({.file = file, .field = field, .reason = unknown.reason, .remedy = unknown.remedy});
}

passes::ParameterValue parameterValue(const JsonNode& node) {
  const auto& value = node.json();
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_string()) return value.get<std::string>();
  // Beyond 64 bits an unsigned number would wrap round; as a double it stays out of every range.
  if (value.is_number_unsigned() && value.get<uint64_t>() > uint64_t{INT64_MAX}) return value.get<double>();
  if (value.is_number_integer()) return value.get<int64_t>();
  if (value.is_number()) return value.get<double>();
  node.fail("is " + std::string(node.typeName()) + ", must be a boolean, a number or a string");
}

const passes::Technique& requireTechnique(const JsonNode& node, std::string_view name) {
  if (const auto* technique = findTechnique(name)) return *technique;
  const Unknown unknown = unknownTechnique(name);
  node.fail(unknown.reason, unknown.remedy);
}

TechniqueChoice parseTechnique(const JsonNode& node, std::string_view defaultName) {
  node.requireObject();
  TechniqueChoice choice{std::string(defaultName), {}};
  for (const auto& [name, value] : node.fields()) {
    if (name == "name") {
      choice.name = value.text();
    } else {
      choice.parameters[name] = parameterValue(value);
    }
  }
  if (choice.name.empty()) node.failAt("name", "is missing", "name a technique: " + allTechniqueNames());
  const auto* technique = findTechnique(choice.name);
  if (technique == nullptr) {
    const Unknown unknown = unknownTechnique(choice.name);
    node.failAt("name", unknown.reason, unknown.remedy);
  }
  const auto problems = passes::check(choice.parameters, technique->parameters);
  if (!problems.empty()) node.failAt(problems.front().parameter, problems.front().reason, problems.front().remedy);
  return choice;
}

TechniqueChoice readTechniqueFile(const std::filesystem::path& file, std::string_view defaultName) {
  const auto document = readJsonFile(file);
  const JsonNode root(document, file);
  root.requireObject({"technique"});
  return parseTechnique(root.at("technique", "write {\"technique\": {\"name\": …}}"), defaultName);
}

void setParameter(TechniqueChoice& choice, std::string_view assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw engine::Error({.file = kCommandLine,
                         .field = "--set " + std::string(assignment),
                         .reason = "is no assignment",
                         .remedy = "write --set key=value"});
  }
  const std::string name(assignment.substr(0, equals));
  const auto text = assignment.substr(equals + 1);
  const auto fail = [&](const passes::Problem& problem) {
    throw engine::Error(
        {.file = kCommandLine, .field = "--set " + name, .reason = problem.reason, .remedy = problem.remedy});
  };
  const auto& technique = requireTechnique(choice.name, kCommandLine, "--technique");
  passes::ParameterValue value;
  if (const auto* info = findParameter(technique, name)) {
    passes::Problem problem;
    if (!passes::parse(*info, text, value, problem)) fail(problem);
  } else {
    value = std::string(text);  // check() below says that there is none of that name, and what is near.
  }
  const auto problems = passes::check({{name, value}}, technique.parameters);
  if (!problems.empty()) fail(problems.front());
  choice.parameters[name] = value;
}

}  // namespace lensgraph::host
