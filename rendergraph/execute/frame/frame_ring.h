// The frames in flight of an executor, and the numbers of its frames.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendergraph/execute/frame/frame_in_flight.h"

namespace lensgraph::rendergraph {

/// Frames are numbered from 1 in the order in which they are closed. The frame with number n is served by the frame in
/// flight (n - 1) mod size(), which is not idle until the frame has finished.
class FrameRing {
 public:
  explicit FrameRing(uint32_t size) : frames_(size) {
    for (uint32_t i = 0; i < size; ++i) frames_[i].index = i;
  }

  uint32_t size() const { return static_cast<uint32_t>(frames_.size()); }
  std::span<FrameInFlight> all() { return frames_; }
  std::span<const FrameInFlight> all() const { return frames_; }

  /// Number of the frame that was closed last; 0 before the first.
  uint64_t lastFrame() const { return lastFrame_; }
  /// The one that serves the next frame.
  FrameInFlight& next() { return frames_[lastFrame_ % frames_.size()]; }
  /// The frame was given to the device (submitted) or into a command buffer of the host (recorded): takes a number.
  void close(FrameInFlight& frame, FrameInFlight::State state) {
    frame.frame = ++lastFrame_;
    frame.state = state;
  }

  /// The submitted frame with the smallest number that is at most `number`; null when all of these have finished.
  FrameInFlight* oldestUnfinished(uint64_t number);
  /// This frame and all before it have finished, as far as the executor was told.
  uint64_t finishedFrame() const;

 private:
  std::vector<FrameInFlight> frames_;
  uint64_t lastFrame_ = 0;
};

}  // namespace lensgraph::rendergraph
