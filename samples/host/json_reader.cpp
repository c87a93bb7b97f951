// JSON values that know where they stand: see json_reader.h.
#include "samples/host/json_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/error.h"
#include "passes/parameters.h"

namespace lensgraph::host {

using nlohmann::json;

namespace {

/// More than any shot, configuration or capture needs; a device such as /dev/zero never ends.
constexpr std::size_t kMostBytes = std::size_t{256} << 20;

[[noreturn]] void failFile(const std::string& file, const std::string& field, const std::string& reason,
                           const std::string& remedy) {
  throw engine::Error({.file = file, .field = field, .reason = reason, .remedy = remedy});
}

std::string readText(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code code;
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) failFile(name, "", "no such file", "check the path");
  if (std::filesystem::is_directory(status)) failFile(name, "", "is a folder", "name a JSON file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) failFile(name, "", "cannot be opened", "check its permissions");
  std::string text;
  // Pieces, not the file's size: pipes and standard input have none.
  for (std::array<char, 65536> piece; stream && text.size() <= kMostBytes;) {
    stream.read(piece.data(), piece.size());
    text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (text.size() > kMostBytes) failFile(name, "", "is larger than 256 MiB", "check the path");
  if (stream.bad()) failFile(name, "", "cannot be read", "");
  if (text.empty()) failFile(name, "", "is empty", "write a JSON object");
  return text;
}

/// "line 3, column 7" of a byte, both counted from 1.
std::string placeOf(std::string_view text, std::size_t byte) {
  const auto before = text.substr(0, std::min(byte, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const auto lineStart = before.rfind('\n');
  const auto column = before.size() - (lineStart == std::string_view::npos ? 0 : lineStart + 1) + 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// The library's message without its name, number and place: "syntax error while parsing value - …".
std::string reasonOf(const json::exception& error) {
  const std::string_view message = error.what();
  const auto syntax = message.find("syntax error");
  if (syntax != std::string_view::npos) return std::string(message.substr(syntax));
  const auto bracket = message.find("] ");
  return std::string(bracket == std::string_view::npos ? message : message.substr(bracket + 2));
}

/// The token between the last pair of quotes in a message, as "number overflow parsing '1e999'" has.
std::string_view quotedToken(std::string_view message) {
  const auto last = message.rfind('\'');
  if (last == std::string_view::npos || last == 0) return {};
  const auto first = message.rfind('\'', last - 1);
  return first == std::string_view::npos ? std::string_view{} : message.substr(first + 1, last - first - 1);
}

std::string join(const std::string& path, std::string_view name) {
  return path.empty() ? std::string(name) : path + "." + std::string(name);
}

/// Refuses objects that give a field twice: of which one would win, JSON says nothing.
class DuplicateCheck {
 public:
  explicit DuplicateCheck(std::string file) : file_(std::move(file)) {}

  bool operator()(json::parse_event_t event, const json& parsed) {
    using Event = json::parse_event_t;
    if (event == Event::object_start || event == Event::array_start) {
      open_.push_back({.isArray = event == Event::array_start});
      return true;
    }
    if (event == Event::key) {
      open_.back().name = parsed.get_ref<const std::string&>();
      if (!open_.back().names.insert(open_.back().name).second) {
        failFile(file_, path(), "is given twice", "remove one of them");
      }
      return true;
    }
    if (event != Event::value) open_.pop_back();
    if (!open_.empty()) ++open_.back().index;
    return true;
  }

 private:
  /// An object or array that has begun and not ended, and what of it is being read.
  struct Open {
    bool isArray = false;
    std::size_t index = 0;
    std::string name = {};
    std::set<std::string> names = {};
  };

  /// Of the value that is being read: "scene[1].path".
  std::string path() const {
    std::string text;
    for (const Open& open : open_) {
      text = open.isArray ? text + "[" + std::to_string(open.index) + "]" : join(text, open.name);
    }
    return text;
  }

  std::string file_;
  std::vector<Open> open_;
};

/// Shortest text that reads back as the same number.
std::string numberText(double value) {
  return json(value).dump();
}

}  // namespace

json readJsonFile(const std::filesystem::path& file) {
  const std::string text = readText(file);
  DuplicateCheck duplicates(file.string());
  const auto onEvent = [&](int, json::parse_event_t event, json& parsed) { return duplicates(event, parsed); };
  try {
    return json::parse(text, onEvent);
  } catch (const json::parse_error& error) {
    failFile(file.string(), placeOf(text, error.byte == 0 ? 0 : error.byte - 1), reasonOf(error),
             "correct the JSON there");
  } catch (const json::out_of_range& error) {
    failFile(file.string(), placeOf(text, text.find(quotedToken(error.what()))), reasonOf(error),
             "write a finite number");
  }
}

JsonNode::JsonNode(const nlohmann::json& document, const std::filesystem::path& file)
    : value_(&document), file_(file.string()) {}

JsonNode::JsonNode(const nlohmann::json& value, const JsonNode& parent, std::string path)
    : value_(&value), file_(parent.file_), path_(std::move(path)) {}

void JsonNode::fail(const std::string& reason, const std::string& remedy) const {
  failFile(file_, path_, reason, remedy);
}

void JsonNode::failAt(std::string_view name, const std::string& reason, const std::string& remedy) const {
  failFile(file_, join(path_, name), reason, remedy);
}

std::string_view JsonNode::typeName() const {
  switch (value_->type()) {
    case json::value_t::null:
      return "null";
    case json::value_t::object:
      return "an object";
    case json::value_t::array:
      return "an array";
    case json::value_t::string:
      return "a string";
    case json::value_t::boolean:
      return "a boolean";
    default:
      return "a number";
  }
}

void JsonNode::requireObject() const {
  if (!value_->is_object()) fail("is " + std::string(typeName()) + ", must be an object", "write { … }");
}

void JsonNode::requireObject(std::initializer_list<std::string_view> known) const {
  requireObject();
  for (const auto& [name, value] : value_->items()) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const auto nearest = passes::nearestName(name, {known.begin(), known.size()});
    std::string remedy;
    if (!nearest.empty()) {
      remedy = "did you mean " + std::string(nearest) + "?";
    } else {
      for (const auto field : known) remedy += (remedy.empty() ? "known are " : ", ") + std::string(field);
    }
    failAt(name, "unknown field", remedy);
  }
}

bool JsonNode::has(std::string_view name) const {
  return value_->contains(name);
}

std::optional<JsonNode> JsonNode::find(std::string_view name) const {
  const auto found = value_->find(name);
  if (found == value_->end()) return std::nullopt;
  return JsonNode(*found, *this, join(path_, name));
}

JsonNode JsonNode::at(std::string_view name, const std::string& remedy) const {
  auto found = find(name);
  if (!found) failAt(name, "is missing", remedy);
  return *found;
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::fields() const {
  std::vector<std::pair<std::string, JsonNode>> all;
  for (const auto& [name, value] : value_->items()) {
    all.emplace_back(name, JsonNode(value, *this, join(path_, name)));
  }
  return all;
}

std::vector<JsonNode> JsonNode::elements() const {
  if (!value_->is_array()) fail("is " + std::string(typeName()) + ", must be an array", "write [ … ]");
  std::vector<JsonNode> all;
  for (std::size_t i = 0; i < value_->size(); ++i) {
    all.push_back(JsonNode((*value_)[i], *this, path_ + "[" + std::to_string(i) + "]"));
  }
  return all;
}

std::vector<JsonNode> JsonNode::elements(std::size_t count, const std::string& what) const {
  auto all = elements();
  if (all.size() != count) {
    fail("has " + std::to_string(all.size()) + " values, must have " + std::to_string(count), "write " + what);
  }
  return all;
}

bool JsonNode::isString() const {
  return value_->is_string();
}

std::string JsonNode::text() const {
  if (!value_->is_string()) fail("is " + std::string(typeName()) + ", must be a string");
  return value_->get<std::string>();
}

double JsonNode::number() const {
  if (!value_->is_number()) fail("is " + std::string(typeName()) + ", must be a number");
  return value_->get<double>();
}

double JsonNode::number(double min, double max) const {
  const double value = number();
  if (!(value >= min && value <= max)) {
    fail("is " + numberText(value) + ", must be from " + numberText(min) + " to " + numberText(max));
  }
  return value;
}

int64_t JsonNode::integer(int64_t min, int64_t max) const {
  const double value = number();
  if (value != std::floor(value)) fail("is " + numberText(value) + ", must be an integer");
  if (value < static_cast<double>(min) || value > static_cast<double>(max)) {
    fail("is " + value_->dump() + ", must be from " + std::to_string(min) + " to " + std::to_string(max));
  }
  return static_cast<int64_t>(value);
}

glm::dvec3 JsonNode::vector(const std::string& what) const {
  const auto parts = elements(3, what);
  return {parts[0].number(), parts[1].number(), parts[2].number()};
}

}  // namespace lensgraph::host
