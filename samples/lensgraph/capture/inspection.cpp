// Measures first and dumps images afterwards, in a frame of their own.
#include "samples/lensgraph/capture/inspection.h"

#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "engine/error.h"
#include "rendergraph/trace.h"
#include "samples/lensgraph/session.h"

namespace lensgraph::cli {

Inspection::Inspection(const InspectionArguments& arguments) : arguments_(arguments), dumps_(arguments.dumps) {
  if (arguments.capture) checkOutput(*arguments.capture, "--capture");
  if (arguments.trace) checkOutput(*arguments.trace, "--trace");
  if (arguments.measures()) return;
  const char* idle = arguments.frames ? "--capture-frames" : arguments.timing ? "--timing" : nullptr;
  if (idle == nullptr) return;
  throw engine::Error({.file = "command line",
                       .field = idle,
                       .reason = "nothing is measured",
                       .remedy = "give --capture FILE.json or --trace FILE.json too"});
}

std::vector<OutputFile> Inspection::outputs() const {
  std::vector<OutputFile> files;
  if (arguments_.capture) files.push_back({*arguments_.capture, "--capture"});
  if (arguments_.trace) files.push_back({*arguments_.trace, "--trace"});
  dumps_.appendOutputs(files);
  return files;
}

host::Rendering Inspection::render(const engine::DeviceDescription& device, host::RenderOptions options,
                                   const RenderOnce& renderOnce) {
  host::Rendering rendering = renderPicture(device, options, renderOnce);
  options.execute.timing = rendergraph::Timing::inlineTimestamps;
  for (int frame = 0; frame < arguments_.timedFrames() && !dumps_.listsOnly(); ++frame) {
    times_.add(renderOnce(options));
  }
  return rendering;
}

host::Rendering Inspection::renderPicture(const engine::DeviceDescription& device, host::RenderOptions options,
                                          const RenderOnce& renderOnce) {
  host::Rendering measured;
  if (arguments_.measures()) {
    host::RenderOptions timed = options;
    timed.execute.timing = timingOf(arguments_, device);
    measurement_.emplace();
    measured = measureFrames(arguments_, timed, renderOnce, *measurement_);
    if (!dumps_.wanted()) return measured;
  }
  options.execute.timing = rendergraph::Timing::inlineTimestamps;
  if (dumps_.wanted()) dumps_.addTo(options);
  host::Rendering rendering = renderOnce(options);
  if (dumps_.wanted()) dumps_.requireMatches();
  return arguments_.measures() ? std::move(measured) : std::move(rendering);
}

void Inspection::write(const engine::DeviceDescription& device, const CaptureInput& input,
                       const host::TechniqueChoice& choice, const host::Rendering& rendering) const {
  if (arguments_.capture) {
    writeTextFile(*arguments_.capture, captureJson(device, input, choice, rendering, *measurement_)
                                               .dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
                                           "\n");
  }
  if (arguments_.trace) {
    std::ostringstream text;
    rendergraph::writeTrace(text, measurement_->executions, "lensgraph " + choice.name + " on " + describe(device));
    writeTextFile(*arguments_.trace, text.str());
  }
  dumps_.write();
}

}  // namespace lensgraph::cli
