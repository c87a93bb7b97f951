// lensgraph capture-view: a capture as a page. What the page shows is drawn by capture_page.js, in the browser.
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/error.h"
#include "samples/lensgraph/capture/capture_reader.h"
#include "samples/lensgraph/output.h"
#include "samples/lensgraph/pages/capture_page.h"
#include "samples/lensgraph/pages/embedded_page.h"
#include "samples/lensgraph/subcommands.h"

namespace lensgraph::cli {
namespace {

constexpr char kPage[] = {
#include "generated/capture_page.inc"
};
constexpr char kScript[] = {
#include "generated/capture_page_script.inc"
};

}  // namespace

bool canMakeCapturePages() {
  return !d3Script().empty() && !dagreScript().empty();
}

std::string capturePage(const nlohmann::json& capture) {
  std::string page(textOf(kPage));
  // The capture last: its names could hold a mark.
  put(page, "/*libraries*/", std::string(d3Script()) + std::string(dagreScript()));
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
