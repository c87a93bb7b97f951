// Captures of several frames of one graph, merged: medians with their spread. Pure; writes JSON.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "rendergraph/capture.h"

namespace lensgraph::rendergraph {

/// Of one time over the frames, ms; all negative when it was not measured.
struct Spread {
  double median = -1.0;  ///< Of an even number of frames: the mean of the two in the middle.
  double min = -1.0, max = -1.0;
  bool operator==(const Spread&) const = default;
};

/// Median, smallest and largest; values below zero are left out, as not measured.
Spread spreadOf(std::vector<double> values);

/// Frames are merged only with their like: the same passes with the same bytes and barriers, the same resources at
/// the same places, timed the same way. Medians over different graphs would be of neither.
class CaptureSeries {
 public:
  /// Takes in one frame. When it differs from those before in more than its times, these are forgotten and the series
  /// begins anew with it: a host that changes its settings keeps measuring what it now draws.
  /// Returns false then, true otherwise (the first frame included).
  bool add(const Capture& capture);
  void clear() { frames_.clear(); }

  /// Frames that the figures are of.
  uint32_t frames() const { return static_cast<uint32_t>(frames_.size()); }
  /// The newest frame: everything but the times is the same in all. Precondition: frames() > 0.
  const Capture& structure() const { return frames_.back(); }

  // Over the frames; not measured when there are none.
  Spread frameGpuMs() const;
  Spread frameWallMs() const;
  /// Sum of the passes' device times, of frames in which one was measured. Near frameGpuMs() with isolated timing; with
  /// inline timing, less by what lies between passes.
  Spread passSumMs() const;
  Spread gpuMs(uint32_t step) const;
  Spread recordMs(uint32_t step) const;
  /// Frames that found their plan compiled.
  uint32_t plansReused() const;

 private:
  std::vector<Capture> frames_;
};

/// One JSON object. Times are {"median", "min", "max"} in ms, or null when not measured. Precondition: frames() > 0.
void writeJson(std::ostream& out, const CaptureSeries& series);
/// A series of this one frame.
void writeJson(std::ostream& out, const Capture& capture);

}  // namespace lensgraph::rendergraph
