// lensgraph techniques, lensgraph devices: lists for people and for programs.
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "engine/vulkan/device.h"
#include "samples/host/technique_choice.h"
#include "samples/lensgraph/capture/capture_file.h"
#include "samples/lensgraph/session.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {
namespace {

using nlohmann::ordered_json;

const char* nameOf(passes::ParameterType type) {
  switch (type) {
    case passes::ParameterType::toggle:
      return "boolean";
    case passes::ParameterType::integer:
      return "integer";
    case passes::ParameterType::number:
      return "number";
    case passes::ParameterType::choice:
      return "choice";
  }
  return "";
}

const char* nameOf(passes::TechniqueInput input) {
  return input == passes::TechniqueInput::image ? "image" : "scene";
}

bool hasRange(const passes::ParameterInfo& info) {
  return info.type == passes::ParameterType::integer || info.type == passes::ParameterType::number;
}

std::string rangeOf(const passes::ParameterInfo& info) {
  if (info.type == passes::ParameterType::toggle) return "true|false";
  std::string text;
  for (const auto choice : info.choices) text += (text.empty() ? "" : "|") + std::string(choice);
  if (!hasRange(info)) return text;
  char range[64];
  std::snprintf(range, sizeof range, "%.6g … %.6g", info.min, info.max);
  return range;
}

ordered_json toOrderedJson(const passes::ParameterInfo& info) {
  ordered_json json = {{"name", info.name}, {"type", nameOf(info.type)}, {"unit", info.unit}};
  if (hasRange(info)) {
    json["min"] = info.min;
    json["max"] = info.max;
  }
  if (!info.choices.empty()) json["choices"] = info.choices;
  json["default"] = toJson(info.defaultValue);
  json["description"] = info.description;
  return json;
}

void printJson() {
  ordered_json all = ordered_json::array();
  for (const auto& technique : host::techniques()) {
    ordered_json parameters = ordered_json::array();
    for (const auto& info : technique.parameters) parameters.push_back(toOrderedJson(info));
    all.push_back({{"name", technique.name},
                   {"title", technique.title},
                   {"source", technique.source},
                   {"input", nameOf(technique.input)},
                   {"parameters", std::move(parameters)}});
  }
  std::cout << ordered_json{{"techniques", std::move(all)}}.dump(2) << "\n";
}

}  // namespace

int runTechniques(bool json) {
  if (json) {
    printJson();
    return 0;
  }
  for (const auto& technique : host::techniques()) {
    std::cout << technique.name << ": " << technique.title << " (" << technique.source << ")\n"
              << "  works on "
              << (technique.input == passes::TechniqueInput::image ? "any picture with depth" : "scenes") << "\n";
    for (const auto& info : technique.parameters) {
      std::cout << "  " << info.name << " = " << passes::toString(info.defaultValue);
      if (!info.unit.empty()) std::cout << " " << info.unit;
      std::cout << "   [" << rangeOf(info) << "]\n      " << info.description << "\n";
    }
    std::cout << "\n";
  }
  return 0;
}

int runDevices(bool json) {
  const auto devices = engine::listDevices();
  auto all = nlohmann::json::array();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (json) {
      all.push_back(toJson(devices[i]));
      all.back()["index"] = i;
      all.back()["missing"] = devices[i].missing;
      continue;
    }
    std::cout << i << "  " << describe(devices[i]);
    for (const auto& feature : devices[i].missing) std::cout << "; lacks " << feature;
    std::cout << "\n";
  }
  if (json) std::cout << nlohmann::json{{"devices", std::move(all)}}.dump(2) << "\n";
  return 0;
}

}  // namespace lensgraph::cli
