// Kinds of passes, the queues that they prefer, and what becomes of an attachment's content when a pass begins.
#pragma once

#include <cstdint>

namespace lensgraph::rendergraph {

enum class PassKind : uint8_t {
  raster,  ///< Draws into attachments (dynamic rendering is begun and ended around the recording).
  compute,
  transfer,  ///< Copies, clears, fills.
  host,      ///< Runs on the host between submissions.
};

/// Which queue a pass would like; a device without it uses the graphics queue.
enum class QueuePreference : uint8_t { graphics, asyncCompute, transfer };

enum class LoadOp : uint8_t {
  clear,
  load,      ///< Keep what is there: the access is a modify.
  dontCare,  ///< Every texel will be written.
};

}  // namespace lensgraph::rendergraph
