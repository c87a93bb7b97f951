// Trace events: https://docs.google.com/document/d/1CvAClvFfyA5R-PhYUmn5OOQtYMH4h6I0nSsKchNAySU (format, 2016).
#include "rendergraph/trace.h"

#include <cstdio>
#include <ostream>
#include <set>
#include <string>

#include "rendergraph/declare/names.h"
#include "rendergraph/inspect/json_text.h"

namespace lensgraph::rendergraph {

namespace {

constexpr int kProcess = 1;
constexpr int kHostTrack = 1;
constexpr int kFirstQueueTrack = 10;  // Leaves room for further host threads.

/// Microseconds, the unit of the format, to the nanosecond.
std::string microseconds(double ms) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3f", ms * 1e3);
  return text;
}

class Events {
 public:
  explicit Events(std::ostream& out) : out_(out) {}

  void name(const char* what, int track, std::string_view name) {
    begin("M", what) << ", \"tid\": " << track << ", \"args\": {\"name\": " << jsonString(name) << "}}";
  }
  void sortIndex(int track, int index) {
    begin("M", "thread_sort_index") << ", \"tid\": " << track << ", \"args\": {\"sort_index\": " << index << "}}";
  }
  void slice(std::string_view name, int track, double startMs, double ms, const std::string& arguments) {
    begin("X", name) << ", \"tid\": " << track << ", \"ts\": " << microseconds(startMs)
                     << ", \"dur\": " << microseconds(ms) << ", \"args\": {" << arguments << "}}";
  }
  void counter(std::string_view name, double ms, VkDeviceSize bytes) {
    begin("C", name) << ", \"ts\": " << microseconds(ms) << ", \"args\": {\"bytes\": " << bytes << "}}";
  }

 private:
  std::ostream& begin(const char* phase, std::string_view name) {
    out_ << (first_ ? "\n" : ",\n") << "{\"ph\": \"" << phase << "\", \"name\": " << jsonString(name)
         << ", \"pid\": " << kProcess;
    first_ = false;
    return out_;
  }

  std::ostream& out_;
  bool first_ = true;
};

std::string argumentsOf(const CapturedPass& pass, uint32_t step) {
  return "\"step\": " + std::to_string(step) + ", \"kind\": " + jsonString(nameOf(pass.kind)) +
         ", \"bytesRead\": " + std::to_string(pass.bytesRead) +
         ", \"bytesWritten\": " + std::to_string(pass.bytesWritten) +
         ", \"imageBarriers\": " + std::to_string(pass.imageBarriers) +
         ", \"bufferBarriers\": " + std::to_string(pass.bufferBarriers) + ", \"resolution\": \"" +
         std::to_string(pass.resolution.width) + "x" + std::to_string(pass.resolution.height) + "\"";
}

bool isTimed(const CapturedPass& pass) {
  return pass.gpuMs >= 0.0;
}

void writeFrame(Events& events, const Capture& frame, std::size_t number, double startMs) {
  events.slice(
      "frame " + std::to_string(number), kHostTrack, startMs, frame.frameWallMs,
      "\"timing\": " + jsonString(frame.timing) + ", \"planReused\": " + (frame.planReused ? "true" : "false"));
  for (uint32_t step = 0; step < frame.passes.size(); ++step) {
    const CapturedPass& pass = frame.passes[step];
    const std::string arguments = argumentsOf(pass, step);
    events.slice(pass.name, kHostTrack, startMs + pass.recordStartMs, pass.recordMs, arguments);
    if (isTimed(pass)) {
      events.slice(pass.name, kFirstQueueTrack + static_cast<int>(pass.queue), startMs + pass.gpuStartMs, pass.gpuMs,
                   arguments);
    }
    const double begins = isTimed(pass) ? pass.gpuStartMs : pass.recordStartMs;
    events.counter("graph memory in use", startMs + begins, bytesAlive(frame, step));
  }
  events.counter("graph memory in use", startMs + frame.frameWallMs,
                 bytesAlive(frame, static_cast<uint32_t>(frame.passes.size())));
}

}  // namespace

void writeTrace(std::ostream& out, std::span<const Capture> frames, std::string_view process) {
  out << "{\"displayTimeUnit\": \"ms\", \"traceEvents\": [";
  Events events(out);
  events.name("process_name", kHostTrack, process);
  events.name("thread_name", kHostTrack, "host: recording");
  events.sortIndex(kHostTrack, kHostTrack);
  std::set<uint32_t> queues;
  for (const Capture& frame : frames) {
    for (const CapturedPass& pass : frame.passes) {
      if (isTimed(pass)) queues.insert(pass.queue);
    }
  }
  for (const uint32_t queue : queues) {
    const int track = kFirstQueueTrack + static_cast<int>(queue);
    events.name("thread_name", track, "device: queue " + std::to_string(queue));
    events.sortIndex(track, track);
  }
  double startMs = 0.0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    writeFrame(events, frames[i], i, startMs);
    startMs += frames[i].frameWallMs;
  }
  out << "\n]}\n";
}

}  // namespace lensgraph::rendergraph
