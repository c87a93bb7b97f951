// The template engine: see page_template.h.
#include "samples/lensgraph/pages/page_template.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

namespace lensgraph::cli {
namespace {

using nlohmann::json;
using Scopes = std::vector<const json*>;

const json& lookUp(const Scopes& scopes, std::string_view name) {
  for (auto scope = scopes.rbegin(); scope != scopes.rend(); ++scope) {
    const auto found = (*scope)->find(name);
    if (found != (*scope)->end()) return *found;
  }
  throw std::logic_error("template: no value for " + std::string(name));
}

struct Tag {
  char kind = 0;  ///< '#', '^', '/', or 0 for a value.
  std::string_view name;
  std::size_t begin = 0, end = 0;  ///< Of the tag with its braces.
};

/// The next tag from `from` on; begin is npos when there is none.
Tag nextTag(std::string_view text, std::size_t from) {
  Tag tag;
  tag.begin = text.find("{{", from);
  if (tag.begin == std::string_view::npos) return tag;
  const auto close = text.find("}}", tag.begin);
  if (close == std::string_view::npos) throw std::logic_error("template: {{ without }}");
  tag.end = close + 2;
  tag.name = text.substr(tag.begin + 2, close - tag.begin - 2);
  if (!tag.name.empty() && std::string_view("#^/").find(tag.name.front()) != std::string_view::npos) {
    tag.kind = tag.name.front();
    tag.name.remove_prefix(1);
  }
  return tag;
}

/// The closing tag of a section whose body begins at `from`.
Tag closingTag(std::string_view text, std::size_t from, std::string_view name) {
  int depth = 1;
  for (Tag tag = nextTag(text, from); tag.begin != std::string_view::npos; tag = nextTag(text, tag.end)) {
    if (tag.kind == '#' || tag.kind == '^') ++depth;
    if (tag.kind != '/') continue;
    if (--depth == 0) {
      if (tag.name == name) return tag;
      break;
    }
  }
  throw std::logic_error("template: section " + std::string(name) + " is not closed");
}

bool isFalse(const json& value) {
  return value.is_null() || (value.is_boolean() && !value.get<bool>()) || (value.is_array() && value.empty());
}

void fill(std::string_view text, Scopes& scopes, std::string& out);

void fillSection(std::string_view body, const json& value, Scopes& scopes, std::string& out) {
  if (!value.is_array()) return fill(body, scopes, out);
  for (const auto& element : value) {
    scopes.push_back(&element);
    fill(body, scopes, out);
    scopes.pop_back();
  }
}

void fill(std::string_view text, Scopes& scopes, std::string& out) {
  std::size_t at = 0;
  for (Tag tag = nextTag(text, 0); tag.begin != std::string_view::npos; tag = nextTag(text, at)) {
    out += text.substr(at, tag.begin - at);
    at = tag.end;
    if (tag.kind == '/') throw std::logic_error("template: stray end of " + std::string(tag.name));
    const json& value = lookUp(scopes, tag.name);
    if (tag.kind == 0) {
      out += escapeHtml(value.is_string() ? value.get_ref<const std::string&>() : value.dump());
      continue;
    }
    const Tag close = closingTag(text, tag.end, tag.name);
    const auto body = text.substr(tag.end, close.begin - tag.end);
    if (isFalse(value)) {
      if (tag.kind == '^') fill(body, scopes, out);
    } else if (tag.kind == '#') {
      fillSection(body, value, scopes, out);
    }
    at = close.end;
  }
  out += text.substr(at);
}

}  // namespace

std::string escapeHtml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string fillTemplate(std::string_view text, const json& values) {
  std::string out;
  Scopes scopes{&values};
  fill(text, scopes, out);
  return out;
}

}  // namespace lensgraph::cli
