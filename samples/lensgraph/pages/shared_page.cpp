// The parts of pages with a picture viewer: see shared_page.h.
#include "samples/lensgraph/pages/shared_page.h"

#include <nlohmann/json.hpp>

#include "samples/lensgraph/pages/embedded_page.h"

namespace lensgraph::cli {
namespace {

constexpr char kStyle[] = {
#include "generated/page_style.inc"
};
constexpr char kParts[] = {
#include "generated/page_parts.inc"
};

}  // namespace

std::string filledPage(std::string_view page, std::string_view script, const nlohmann::ordered_json& data) {
  std::string filled(page);
  put(filled, "/*style*/", textOf(kStyle));
  put(filled, "/*libraries*/", d3Script());
  put(filled, "/*script*/", std::string(textOf(kParts)) + std::string(script));
  // The data last: their names could hold a mark.
  put(filled, "/*data*/", embedded(data));
  return filled;
}

}  // namespace lensgraph::cli
