// What `render` and `apply` tell about a picture that they made: device, technique, times, memory, what went wrong.
#pragma once

#include <string>
#include <vector>

#include "engine/vulkan/device.h"
#include "samples/host/rendering.h"
#include "samples/host/technique_choice.h"
#include "samples/lensgraph/capture/capture_file.h"
#include "samples/lensgraph/capture/measurement.h"

namespace lensgraph::cli {

/// Refers to what a subcommand has at hand when it is done.
struct Report {
  const engine::DeviceDescription& device;
  const CaptureInput& input;
  const host::TechniqueChoice& choice;
  const host::Rendering& rendering;  ///< Of the picture; its times are of a frame that may have compiled shaders.
  const FrameTimes& warm;            ///< Of frames after it; may be empty.
  std::vector<std::string> lines;    ///< More to tell, a line each.
};

/// Prints it on stdout, in words or as one JSON object ("lensgraph report"). Warnings go to stderr; the JSON object holds
/// them too.
void printReport(const Report& report, bool asJson);

/// What the reports of `--json` say that they are, in their fields "format" and "formatVersion".
inline constexpr const char* kReportFormat = "lensgraph report";
inline constexpr int kReportVersion = 1;

}  // namespace lensgraph::cli
