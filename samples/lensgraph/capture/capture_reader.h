// Reads capture files back: checked, so that what works on them need not.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "rendergraph/capture_series.h"

namespace lensgraph::cli {

/// A time that was measured, ms.
using MeasuredTime = std::optional<rendergraph::Spread>;

struct PassFacts {
  std::string name;
  MeasuredTime gpuMs, recordMs;
  uint64_t bytesRead = 0, bytesWritten = 0;
  uint64_t imageBarriers = 0, bufferBarriers = 0;
  uint64_t width = 0, height = 0;  ///< px
};

struct CaptureFacts {
  std::string file;
  std::map<std::string, std::string> conditions;  ///< Device, driver, version, shot, technique, parameters, …
  std::string timing;
  uint64_t frames = 0;
  MeasuredTime frameGpuMs, frameWallMs;
  uint64_t peakBytes = 0, unaliasedBytes = 0, lowerBound = 0;
  uint64_t barrierBatches = 0;
  std::vector<PassFacts> passes;
  nlohmann::json document;  ///< All of it. Every index in it is in range, every field that a page shows is there.
};

/// Throws engine::Error (bad input): unreadable, no capture, of a version that is not known, or broken.
CaptureFacts readCapture(const std::filesystem::path& file);

}  // namespace lensgraph::cli
