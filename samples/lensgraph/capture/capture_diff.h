// What changed from one capture to another. Pure: facts in, differences out.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "samples/lensgraph/capture/capture_reader.h"

namespace lensgraph::cli {

/// A measured time in both captures. A difference is noise when the two ranges from smallest to largest frame meet; it
/// is of unknown weight when one of the captures is of a single frame, which has no range.
struct TimeChange {
  enum class Weight : uint8_t { changed, noise, unknown };
  MeasuredTime before, after;
  /// Difference of the medians, ms; what is missing on one side counts as 0.
  double ms() const;
  Weight weight = Weight::unknown;
};

struct CountChange {
  uint64_t before = 0, after = 0;
  bool changed() const { return before != after; }
};

struct PassChange {
  enum class Kind : uint8_t { same, added, removed };  ///< same: in both, changed or not.
  std::string name;                                    ///< With #2, #3 … for a name's further passes.
  Kind kind = Kind::same;
  TimeChange gpuMs, recordMs;
  CountChange bytesRead, bytesWritten, imageBarriers, bufferBarriers, width, height;
  /// Anything but a time within the noise.
  bool changed() const;
};

struct ConditionChange {
  std::string what, before, after;  ///< Empty: absent.
};

struct CaptureDiff {
  std::vector<ConditionChange> conditions;  ///< Those that differ.
  TimeChange frameGpuMs, frameWallMs;
  CountChange peakBytes, unaliasedBytes, lowerBound, barrierBatches, passCount;
  std::vector<PassChange> passes;  ///< All; those that changed first, by weight of the time, then of the bytes.
};

CaptureDiff diffCaptures(const CaptureFacts& before, const CaptureFacts& after);

std::string diffText(const CaptureDiff& diff, const std::string& before, const std::string& after);
nlohmann::json diffJson(const CaptureDiff& diff);

}  // namespace lensgraph::cli
