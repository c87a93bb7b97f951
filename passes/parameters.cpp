// Checks, parsing and suggestions for parameters of techniques (parameters.h). Knows no technique.
#include "passes/parameters.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

namespace lensgraph::passes {
namespace {

std::string quoted(std::string_view text) {
  return "'" + std::string(text) + "'";
}

std::string joined(std::span<const std::string_view> names) {
  std::string text;
  for (const auto name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

/// "did you mean 'x'?" where a name is near, else the list of all there are.
std::string suggestion(std::string_view name, std::span<const std::string_view> names) {
  const std::string_view near = nearestName(name, names);
  if (!near.empty()) return "did you mean " + quoted(near) + "?";
  return names.empty() ? "there are none to set" : "known are: " + joined(names);
}

std::string rangeText(const ParameterInfo& info) {
  std::string text = toString(ParameterValue(info.min)) + " to " + toString(ParameterValue(info.max));
  if (!info.unit.empty()) text += " " + std::string(info.unit);
  return text;
}

/// What a value of this parameter looks like.
std::string expectation(const ParameterInfo& info) {
  switch (info.type) {
    case ParameterType::toggle:
      return "use true or false";
    case ParameterType::integer:
      return "use a whole number from " + rangeText(info);
    case ParameterType::number:
      return "use a number from " + rangeText(info);
    case ParameterType::choice:
      return "use one of: " + joined(info.choices);
  }
  return {};
}

bool hasType(const ParameterInfo& info, const ParameterValue& value) {
  switch (info.type) {
    case ParameterType::toggle:
      return std::holds_alternative<bool>(value);
    case ParameterType::integer:
      return std::holds_alternative<int64_t>(value);
    case ParameterType::number:
      return std::holds_alternative<double>(value) || std::holds_alternative<int64_t>(value);
    case ParameterType::choice:
      return std::holds_alternative<std::string>(value);
  }
  return false;
}

double asDouble(const ParameterValue& value) {
  const auto* integer = std::get_if<int64_t>(&value);
  return integer != nullptr ? static_cast<double>(*integer) : std::get<double>(value);
}

void checkOne(const ParameterInfo& info, const ParameterValue& value, std::vector<Problem>& problems) {
  const auto report = [&](std::string reason, std::string remedy) {
    problems.push_back({std::string(info.name), std::move(reason), std::move(remedy)});
  };
  const std::string text = quoted(toString(value));
  if (!hasType(info, value)) return report(text + " has the wrong type", expectation(info));
  if (info.type == ParameterType::toggle) return;
  if (info.type == ParameterType::choice) {
    const auto& chosen = std::get<std::string>(value);
    if (std::find(info.choices.begin(), info.choices.end(), chosen) == info.choices.end()) {
      report(text + " is not one of its choices", suggestion(chosen, info.choices));
    }
    return;
  }
  const double number = asDouble(value);
  if (!std::isfinite(number)) return report(text + " is not a finite number", expectation(info));
  if (number < info.min || number > info.max) report(text + " is out of range", expectation(info));
}

/// The whole of `text` as a number of type T.
template <class T>
std::errc parseNumber(std::string_view text, T& value) {
  // from_chars takes no leading plus, people type it; "+-1" stays refused.
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return error;
  return end == text.data() + text.size() ? std::errc{} : std::errc::invalid_argument;
}

char lowerCase(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

/// Edits (insert, delete, replace, swap of neighbours) that turn one name into the other, whatever the case
/// of the letters: optimal string alignment distance.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> beforeLast(b.size() + 1), last(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const auto differs = [&](std::size_t k, std::size_t l) { return lowerCase(a[k]) != lowerCase(b[l]); };
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, last[j - 1] + (differs(i - 1, j - 1) ? 1 : 0)});
      if (i > 1 && j > 1 && !differs(i - 1, j - 2) && !differs(i - 2, j - 1)) {
        current[j] = std::min(current[j], beforeLast[j - 2] + 1);
      }
    }
    beforeLast.swap(last);
    last.swap(current);
  }
  return last[b.size()];
}

}  // namespace

std::vector<Problem> check(const ParameterSet& set, std::span<const ParameterInfo> known) {
  std::vector<Problem> problems;
  for (const auto& [name, value] : set) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const auto& info) { return info.name == name; });
    if (found != known.end()) {
      checkOne(*found, value, problems);
      continue;
    }
    std::vector<std::string_view> names;
    for (const auto& info : known) names.push_back(info.name);
    problems.push_back({name, "there is no parameter of this name", suggestion(name, names)});
  }
  return problems;
}

bool parse(const ParameterInfo& info, std::string_view text, ParameterValue& value, Problem& problem) {
  const auto refuse = [&](std::string reason, std::string remedy) {
    problem = {std::string(info.name), quoted(text) + " " + std::move(reason), std::move(remedy)};
    return false;
  };
  switch (info.type) {
    case ParameterType::toggle: {
      if (text != "true" && text != "false") return refuse("is neither true nor false", expectation(info));
      value = text == "true";
      return true;
    }
    case ParameterType::integer: {
      int64_t number = 0;
      const std::errc error = parseNumber(text, number);
      if (error == std::errc::result_out_of_range) return refuse("is out of range", expectation(info));
      if (error != std::errc{}) return refuse("is not a whole number", expectation(info));
      value = number;
      return true;
    }
    case ParameterType::number: {
      double number = 0.0;
      const std::errc error = parseNumber(text, number);
      if (error == std::errc::result_out_of_range) return refuse("is out of range", expectation(info));
      if (error != std::errc{}) return refuse("is not a number", expectation(info));
      if (!std::isfinite(number)) return refuse("is not a finite number", expectation(info));
      value = number;
      return true;
    }
    case ParameterType::choice: {
      if (std::find(info.choices.begin(), info.choices.end(), text) == info.choices.end()) {
        return refuse("is not one of its choices", suggestion(text, info.choices));
      }
      value = std::string(text);
      return true;
    }
  }
  return false;
}

std::string_view nearestName(std::string_view name, std::span<const std::string_view> names) {
  std::string_view nearest;
  std::size_t smallest = SIZE_MAX;
  for (const auto candidate : names) {
    const std::size_t distance = editDistance(name, candidate);
    if (distance >= smallest || 3 * distance > std::max(name.size(), candidate.size())) continue;
    smallest = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string toString(const ParameterValue& value) {
  if (const auto* boolean = std::get_if<bool>(&value)) return *boolean ? "true" : "false";
  if (const auto* integer = std::get_if<int64_t>(&value)) return std::to_string(*integer);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  std::array<char, 32> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), std::get<double>(value));
  return error == std::errc{} ? std::string(digits.data(), end) : std::string("?");
}

}  // namespace lensgraph::passes
