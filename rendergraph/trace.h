// Captures as a timeline: Chrome's trace-event format, which Perfetto and chrome://tracing open.
#pragma once

#include <iosfwd>
#include <span>
#include <string_view>

#include "rendergraph/capture.h"

namespace lensgraph::rendergraph {

/// Writes the frames one after the other, each beginning where the one before ended on the host's clock. That is how
/// execute() runs them. Frames in flight of submit() overlap in truth, and a capture does not say when its frame began:
/// of those each frame by itself is right, their places and the gaps between them are not.
/// One track for the host (a slice a frame, with the recording of each pass inside), one for each queue that passes
/// were timed on, and a counter of the graph's memory in use. Passes carry bytes, barriers and resolution as arguments.
/// Frames that were not timed (Timing::none) show the host's track and the counter alone.
/// `process`: what the tracks are grouped under, such as the program and its device.
void writeTrace(std::ostream& out, std::span<const Capture> frames, std::string_view process);

}  // namespace lensgraph::rendergraph
