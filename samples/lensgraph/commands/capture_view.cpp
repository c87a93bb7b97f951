// lensgraph capture-view: a capture as a page. What the page shows is drawn by capture_page.js, in the browser.
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "engine/error.h"
#include "samples/lensgraph/capture/capture_reader.h"
#include "samples/lensgraph/output.h"
#include "samples/lensgraph/pages/capture_page.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {
namespace {

constexpr char kPage[] = {
#include "generated/capture_page.inc"
};
constexpr char kScript[] = {
#include "generated/capture_page_script.inc"
};
constexpr char kLibraries[] = {
#include "generated/page_libraries.inc"
};

/// An array's length is known; measuring half a megabyte at compile time is beyond compilers' limits.
template <std::size_t Size>
std::string_view textOf(const char (&array)[Size]) {
  return {array, Size - 1};
}

void put(std::string& page, std::string_view mark, std::string_view content) {
  page.replace(page.find(mark), mark.size(), content);
}

/// JSON that cannot end the element it stands in, whatever names it holds.
std::string embedded(const nlohmann::json& value) {
  std::string text;
  for (const char c : value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

bool canMakeCapturePages() {
  return !textOf(kLibraries).empty();
}

std::string capturePage(const nlohmann::json& capture) {
  std::string page(textOf(kPage));
  // The capture last: its names could hold a mark.
  put(page, "/*libraries*/", textOf(kLibraries));
  put(page, "/*script*/", textOf(kScript));
  put(page, "/*capture*/", embedded(capture));
  return page;
}

int runCaptureView(const CaptureViewArguments& arguments) {
  if (arguments.output != "-")
    checkOutput(arguments.output, "--output", std::array<std::string_view, 2>{".html", ".htm"});
  const CaptureFacts capture = readCapture(arguments.capture);
  if (!canMakeCapturePages()) {
    throw engine::Error({.file = "capture-view",
                         .field = {},
                         .reason = "this program was built without d3 and dagre, which draw the page",
                         .remedy = "install node-d3 and node-dagre-layout, then build again"},
                        engine::ErrorKind::failed);
  }
  writeTextFile(arguments.output, capturePage(capture.document));
  return 0;
}

}  // namespace lensgraph::cli
