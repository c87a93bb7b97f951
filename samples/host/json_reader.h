// JSON files whose every value knows where it stands, so that each complaint names file, field, reason,
// remedy.
//
// Does not do: writing, comments, trailing commas (JSON has none).
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lensgraph::host {

/// Throws engine::Error: missing, a folder, empty, malformed (with line and column), a field given twice, a
/// number that overflows.
nlohmann::json readJsonFile(const std::filesystem::path& file);

/// One value of a file. The document outlives it.
class JsonNode {
 public:
  /// The document itself.
  JsonNode(const nlohmann::json& document, const std::filesystem::path& file);

  /// Throws engine::Error about this value.
  [[noreturn]] void fail(const std::string& reason, const std::string& remedy = {}) const;
  /// The same about a field of this object that may be absent.
  [[noreturn]] void failAt(std::string_view name, const std::string& reason, const std::string& remedy = {}) const;

  /// An object with no other fields than these; an unknown one is an error that names the nearest known.
  void requireObject(std::initializer_list<std::string_view> known) const;
  /// An object with any fields.
  void requireObject() const;
  bool has(std::string_view name) const;
  std::optional<JsonNode> find(std::string_view name) const;
  /// A field that must be there; `remedy` tells what to write when it is not.
  JsonNode at(std::string_view name, const std::string& remedy) const;
  /// All fields, sorted by name.
  std::vector<std::pair<std::string, JsonNode>> fields() const;

  std::vector<JsonNode> elements() const;
  std::vector<JsonNode> elements(std::size_t count, const std::string& what) const;

  bool isString() const;
  std::string text() const;
  double number() const;
  double number(double min, double max) const;  ///< Inclusive.
  /// Numbers without a fraction count as integers, however they are written (640 or 640.0).
  int64_t integer(int64_t min, int64_t max) const;
  glm::dvec3 vector(const std::string& what) const;
  const nlohmann::json& json() const { return *value_; }
  /// Name of the JSON type with its article: "a string", "an array".
  std::string_view typeName() const;

 private:
  JsonNode(const nlohmann::json& value, const JsonNode& parent, std::string path);

  const nlohmann::json* value_;
  std::string file_;
  std::string path_;  ///< "scene[0].translation"; empty for the document.
};

}  // namespace lensgraph::host
