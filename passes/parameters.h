// Parameters of techniques: plain structs in code, names with units, ranges and defaults for configuration.
//
// A technique describes each member of its Parameters once, as a Field; listing, parsing, range checks and
// documentation all come from that table.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace lensgraph::passes {

using ParameterValue = std::variant<bool, int64_t, double, std::string>;

/// Parameters by name, as configuration gives them. Absent ones take their defaults.
using ParameterSet = std::map<std::string, ParameterValue, std::less<>>;

enum class ParameterType : uint8_t { toggle, integer, number, choice };

/// Everything a user can be told of a parameter.
struct ParameterInfo {
  std::string_view name;
  ParameterType type = ParameterType::number;
  std::string_view unit;        ///< "px", "m", …; empty when it has none.
  double min = 0.0, max = 0.0;  ///< Inclusive; numbers and integers.
  std::vector<std::string_view> choices;
  ParameterValue defaultValue;
  std::string_view description;  ///< What it does and what it costs.
};

/// Something wrong with a configuration, in words: which parameter, why, what to do.
struct Problem {
  std::string parameter;
  std::string reason;
  std::string remedy;
};

/// One described member of a Parameters struct.
template <class Parameters>
struct Field {
  ParameterInfo info;
  ParameterValue (*get)(const Parameters&);
  void (*set)(Parameters&, const ParameterValue&);  ///< Precondition: the value has passed check().
};

namespace detail {
template <class>
struct MemberOf;
template <class Class, class Member>
struct MemberOf<Member Class::*> {
  using Owner = Class;
  using Type = Member;
};
}  // namespace detail

/// A bool member.
template <auto member, class Owner = typename detail::MemberOf<decltype(member)>::Owner>
Field<Owner> toggle(std::string_view name, std::string_view description) {
  return {{.name = name,
           .type = ParameterType::toggle,
           .unit = "",
           .choices = {},
           .defaultValue = Owner{}.*member,
           .description = description},
          [](const Owner& owner) -> ParameterValue { return owner.*member; },
          [](Owner& owner, const ParameterValue& value) { owner.*member = std::get<bool>(value); }};
}

/// An integer or floating-point member with its inclusive range.
template <auto member, class Owner = typename detail::MemberOf<decltype(member)>::Owner>
Field<Owner> number(std::string_view name, std::string_view unit, double min, double max,
                    std::string_view description) {
  using Type = typename detail::MemberOf<decltype(member)>::Type;
  using Stored = std::conditional_t<std::is_integral_v<Type>, int64_t, double>;
  constexpr auto type = std::is_integral_v<Type> ? ParameterType::integer : ParameterType::number;
  return {
      {.name = name,
       .type = type,
       .unit = unit,
       .min = min,
       .max = max,
       .choices = {},
       .defaultValue = static_cast<Stored>(Owner{}.*member),
       .description = description},
      [](const Owner& owner) -> ParameterValue { return static_cast<Stored>(owner.*member); },
      [](Owner& owner, const ParameterValue& value) { owner.*member = static_cast<Type>(std::get<Stored>(value)); }};
}

/// An enum member whose values 0, 1, … have these names. `choiceNames` points to a static array of names.
template <auto member, const auto& choiceNames, class Owner = typename detail::MemberOf<decltype(member)>::Owner>
Field<Owner> choice(std::string_view name, std::string_view description) {
  using Type = typename detail::MemberOf<decltype(member)>::Type;
  static constexpr auto nameOf = [](Type value) {
    return ParameterValue(std::string(choiceNames[static_cast<std::size_t>(value)]));
  };
  return {{.name = name,
           .type = ParameterType::choice,
           .unit = "",
           .choices = {std::begin(choiceNames), std::end(choiceNames)},
           .defaultValue = nameOf(Owner{}.*member),
           .description = description},
          [](const Owner& owner) -> ParameterValue { return nameOf(owner.*member); },
          [](Owner& owner, const ParameterValue& value) {
            for (std::size_t i = 0; i < std::size(choiceNames); ++i) {
              if (choiceNames[i] == std::get<std::string>(value)) owner.*member = static_cast<Type>(i);
            }
          }};
}

/// Problems of a set against the described parameters: unknown names (with the nearest known one), wrong types,
/// values out of range or not finite. Empty when all is well.
std::vector<Problem> check(const ParameterSet& set, std::span<const ParameterInfo> known);

/// `text` as a value of the parameter's type ("true", "12", "0.5", "halton"). Reports what is wrong in `problem`
/// and returns false when the text is no such value.
bool parse(const ParameterInfo& info, std::string_view text, ParameterValue& value, Problem& problem);

/// The closest of `names` by edit distance; empty when none is near (more than a third of the letters differ).
std::string_view nearestName(std::string_view name, std::span<const std::string_view> names);

std::string toString(const ParameterValue& value);

template <class Parameters>
std::vector<ParameterInfo> describe(std::span<const Field<Parameters>> fields) {
  std::vector<ParameterInfo> infos;
  for (const auto& field : fields) infos.push_back(field.info);
  return infos;
}

/// The parameters that differ from the defaults, by name.
template <class Parameters>
ParameterSet toSet(const Parameters& parameters, std::span<const Field<Parameters>> fields) {
  ParameterSet set;
  for (const auto& field : fields) {
    const ParameterValue value = field.get(parameters);
    if (value != field.info.defaultValue) set.emplace(field.info.name, value);
  }
  return set;
}

/// Precondition: check() found no problem. Integers are accepted where numbers are asked for.
template <class Parameters>
Parameters fromSet(const ParameterSet& set, std::span<const Field<Parameters>> fields) {
  Parameters parameters;
  for (const auto& field : fields) {
    const auto found = set.find(field.info.name);
    if (found == set.end()) continue;
    const auto* integer = std::get_if<int64_t>(&found->second);
    const bool widen = integer != nullptr && field.info.type == ParameterType::number;
    field.set(parameters, widen ? ParameterValue(static_cast<double>(*integer)) : found->second);
  }
  return parameters;
}

}  // namespace lensgraph::passes
