// What a host chooses about an executor and about one execution.
#pragma once

#include <cstdint>

#include "rendergraph/compile_options.h"

namespace lensgraph::rendergraph {

class Jobs;

/// How pass times are measured.
enum class Timing : uint8_t {
  none,
  inlineTimestamps,  ///< Two timestamps a pass in the one submission. Cheap; wrong on lavapipe once raster is involved.
  isolated,          ///< Each pass in its own submission with a wait, timed by the host around both. Right on every
                     ///< device, including the cost of one submission (some 10 µs).
};

struct ExecutorOptions {
  /// Frames that the device may have before it: submit() waits for the frame that many calls ago. 1 … 4; default 1.
  /// With more than one the host declares and records while the device works. The graph's device memory is shared by
  /// all of them; upload and readback memory, descriptors and command buffers exist once for each.
  uint32_t framesInFlight = 1;
  /// Where recordings on several threads run; null: the executor makes threads of its own when they are first asked
  /// for. Outlives the executor.
  Jobs* jobs = nullptr;
};

struct ExecuteOptions {
  /// Isolated timing switches mergeRasterPasses, splitDistance and useQueues off, several frames in flight switch
  /// overlappingFrames on.
  CompileOptions compile;
  Timing timing = Timing::none;
  /// Threads that record passes at the same time, the caller's included; 1 … 64, default 1. The commands and their
  /// order are the same whatever the number. With more than one the recordings must be safe to run at once: see
  /// PassContext. Isolated timing, record() and host passes use one.
  uint32_t recordingThreads = 1;
};

}  // namespace lensgraph::rendergraph
