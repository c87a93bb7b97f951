// The libraries of pages, and the filling of pages: see embedded_page.h.
#include "samples/lensgraph/pages/embedded_page.h"

#include <cassert>
#include <nlohmann/json.hpp>

#include "engine/error.h"

namespace lensgraph::cli {
namespace {

constexpr char kD3[] = {
#include "generated/page_d3.inc"
};
constexpr char kDagre[] = {
#include "generated/page_dagre.inc"
};

template <class Json>
std::string withoutTags(const Json& value) {
  std::string text;
  for (const char c : value.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

std::string_view d3Script() {
  return textOf(kD3);
}

std::string_view dagreScript() {
  return textOf(kDagre);
}

void requireD3(std::string_view command) {
  if (!d3Script().empty()) return;
  throw engine::Error({.file = std::string(command),
                       .field = {},
                       .reason = "this program was built without d3, which draws the page",
                       .remedy = "install node-d3, then build again"},
                      engine::ErrorKind::failed);
}

void put(std::string& page, std::string_view mark, std::string_view content) {
  const auto at = page.find(mark);
  assert(at != std::string::npos);
  page.replace(at, mark.size(), content);
}

std::string embedded(const nlohmann::json& value) {
  return withoutTags(value);
}

std::string embedded(const nlohmann::ordered_json& value) {
  return withoutTags(value);
}

}  // namespace lensgraph::cli
