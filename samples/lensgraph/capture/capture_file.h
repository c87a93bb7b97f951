// The capture of one rendering as JSON: program, device, shot, parameters, times, memory; enough to hold two
// together.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/vulkan/device.h"
#include "passes/parameters.h"
#include "rendergraph/capture_series.h"
#include "samples/host/renderer.h"
#include "samples/host/technique_choice.h"
#include "samples/lensgraph/capture/measurement.h"

namespace lensgraph::cli {

nlohmann::json toJson(const passes::ParameterValue& value);
nlohmann::json toJson(const engine::DeviceDescription& device);
/// JSON has no infinity: it becomes "infinity", "-infinity" or "nan".
nlohmann::json toJson(double value);

/// {"median", "min", "max"}, or null when nothing was measured.
nlohmann::json toJson(const rendergraph::Spread& spread);

struct CaptureInput {
  std::string source;                        ///< The shot file, or the colour picture.
  std::vector<std::filesystem::path> files;  ///< What the hash covers.
  const passes::Lens* lens = nullptr;
  std::optional<engine::DrawnFaces> faces;  ///< Of a shot.
};

/// {"median", "min", "max", "samples"}: the spread and what it is of; null without samples.
nlohmann::json samplesJson(const std::vector<double>& samples);

/// What captures and reports alike say of a rendering: program, device, input with its hash, resolution, lens, technique
/// with every parameter, executions, statistics.
nlohmann::json renderingJson(const engine::DeviceDescription& device, const CaptureInput& input,
                             const host::TechniqueChoice& choice, const host::Rendering& rendering);

/// Every parameter of the technique: those of the set, and the defaults of the others.
nlohmann::json allParameters(const host::TechniqueChoice& choice);

/// What the program's capture files say that they are, in their fields "format" and "formatVersion".
inline constexpr const char* kCaptureFormat = "lensgraph capture";
inline constexpr int kCaptureVersion = 1;

/// "graph" is of the last execution of each measured frame; "executions" says how many a frame took, "gpuMs" and
/// "wallMs" are of all of them. Precondition: something was measured.
nlohmann::json captureJson(const engine::DeviceDescription& device, const CaptureInput& input,
                           const host::TechniqueChoice& choice, const host::Rendering& rendering,
                           const Measurement& measurement);

}  // namespace lensgraph::cli
