// Searches the few frames in flight by their numbers.
#include "rendergraph/execute/frame/frame_ring.h"

#include <algorithm>

namespace lensgraph::rendergraph {

FrameInFlight* FrameRing::oldestUnfinished(uint64_t number) {
  FrameInFlight* oldest = nullptr;
  for (FrameInFlight& frame : frames_) {
    if (frame.state != FrameInFlight::State::submitted || frame.frame > number) continue;
    if (oldest == nullptr || frame.frame < oldest->frame) oldest = &frame;
  }
  return oldest;
}

uint64_t FrameRing::finishedFrame() const {
  uint64_t finished = lastFrame_;
  for (const FrameInFlight& frame : frames_) {
    if (frame.state != FrameInFlight::State::idle) finished = std::min(finished, frame.frame - 1);
  }
  return finished;
}

}  // namespace lensgraph::rendergraph
