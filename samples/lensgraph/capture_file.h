// The capture of one rendering as JSON: program, device, shot, parameters, times, memory; enough to hold two
// together.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/device.h"
#include "passes/parameters.h"
#include "samples/host/renderer.h"
#include "samples/host/technique_choice.h"

namespace cli {

nlohmann::json toJson(const passes::ParameterValue& value);
nlohmann::json toJson(const engine::DeviceDescription& device);
/// JSON has no infinity: it becomes "infinity", "-infinity" or "nan".
nlohmann::json toJson(double value);

/// FNV-1a over the bytes of the files in this order, as 16 hexadecimal digits. A glTF file's external buffers
/// and images are not followed. Unreadable files count as empty.
std::string hashOfFiles(const std::vector<std::filesystem::path>& files);

struct CaptureInput {
  std::string source;                        ///< The shot file, or the colour picture.
  std::vector<std::filesystem::path> files;  ///< What the hash covers.
  const engine::Lens* lens = nullptr;
};

nlohmann::json captureJson(const engine::DeviceDescription& device, const CaptureInput& input,
                           const host::TechniqueChoice& choice, const host::Rendering& rendering);

}  // namespace cli
