// Parses JSON with the care that files of strangers need.
#include "engine/gltf/read/json_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "engine/error.h"

namespace lensgraph::engine::gltf {
namespace {

using Json = nlohmann::json;

// Deeper JSON than this is no glTF file but an attack on recursive readers, such as tinygltf's of "extras".
constexpr int kMaxNesting = 100;

void requireShallow(const Source& source, std::string_view text) {
  int depth = 0;
  bool isInString = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (isInString) {
      if (c == '\\') ++i;
      if (c == '"') isInString = false;
      continue;
    }
    if (c == '"') isInString = true;
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth > kMaxNesting)
      source.fail("", "its JSON is nested deeper than " + std::to_string(kMaxNesting) + " levels");
  }
}

// Refuses objects that give a member twice: of which one would win, JSON says nothing. A pass of its own, because the
// library's parser with callbacks takes time in the square of the length of arrays.
class DuplicateCheck : public Json::json_sax_t {
 public:
  explicit DuplicateCheck(const Source& source) : source_(source) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(Json::number_integer_t) override { return value(); }
  bool number_unsigned(Json::number_unsigned_t) override { return value(); }
  bool number_float(Json::number_float_t, const std::string&) override { return value(); }
  bool string(std::string&) override { return value(); }
  bool binary(Json::binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return enter(false); }
  bool start_array(std::size_t) override { return enter(true); }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  // What is no JSON is reported by the parser itself.
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override { return false; }

  bool key(std::string& name) override {
    levels_.back().member = name;
    if (!levels_.back().seen.insert(name).second) source_.fail(path(), "is given twice", "remove one of them");
    return true;
  }

 private:
  // An object or array that is being parsed.
  struct Level {
    bool isArray;
    size_t count = 0;              ///< Elements of an array that have begun.
    std::string member{};          ///< Member of an object that is being parsed.
    std::set<std::string> seen{};  ///< Members of an object.
  };

  bool value() {
    if (!levels_.empty()) ++levels_.back().count;
    return true;
  }
  bool enter(bool isArray) {
    value();
    levels_.push_back({.isArray = isArray});
    return true;
  }
  bool leave() {
    levels_.pop_back();
    return true;
  }

  std::string path() const {
    std::string result;
    for (const Level& level : levels_) {
      if (level.isArray) {
        result += "[" + std::to_string(level.count - 1) + "]";
      } else {
        result += (result.empty() ? "" : ".") + level.member;
      }
    }
    return result;
  }

  const Source& source_;
  std::vector<Level> levels_;
};

}  // namespace

Json parseJson(const Source& source, std::string_view text) {
  requireShallow(source, text);
  DuplicateCheck duplicates(source);
  Json::sax_parse(text, &duplicates);
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: …": the bracket says nothing to a
    // user.
    const std::string_view message = error.what();
    const size_t start = message.find("] ");
    const std::string text(start == std::string_view::npos ? message : message.substr(start + 2));
    // The message may end with the token that was read last, of whatever length.
    const size_t token = std::min(text.find("; last read: "), text.size());
    source.fail("", "is not valid glTF JSON: " + asLine(text.substr(0, token), 200) + asLine(text.substr(token), 80));
  }
}

}  // namespace lensgraph::engine::gltf
