// What belongs to one frame in flight. It serves one frame after the other: the next one when the last has finished.
#pragma once

#include <cstdint>
#include <vector>

#include "rendergraph/capture.h"
#include "rendergraph/execute/frame/export_table.h"
#include "rendergraph/execute/frame/recording_context.h"
#include "rendergraph/execute/resources/unique_handle.h"
#include "rendergraph/execute/resources/view_cache.h"

namespace lensgraph::rendergraph {

/// One vkQueueSubmit2 of a frame.
struct SentSubmission {
  uint32_t submission = 0;  // Index in Plan::submissions.
  uint32_t queue = 0;
  uint64_t value = 0;                    // That the queue's timeline reaches with it.
  uint32_t firstStep = 0, lastStep = 0;  // Inclusive.
  bool hasSteps = false;
  double sentMs = 0.0;  // Since the frame's beginning.
};

struct FrameInFlight {
  enum class State : uint8_t {
    idle,
    submitted,
    recorded,  // Into a command buffer of the host, who knows when it has finished.
  };
  State state = State::idle;
  uint32_t index = 0;
  uint64_t frame = 0;  // Number of the latest frame that it served; 0: none yet.
  std::vector<SentSubmission> sent;
  std::vector<UniqueRecorder> recorders;  // By lane, then by queue. None for pairs that never occurred.
  UniqueTimestamps timestamps;
  uint32_t timestampSteps = 0;  // Steps that have room in it.
  std::vector<uint32_t> stamped;
  ViewCache importedViews;  // A host may destroy an imported image after any frame, so these live for one.
  ExportTable exports;
  Capture capture;
  Clock::time_point start;
};

}  // namespace lensgraph::rendergraph
