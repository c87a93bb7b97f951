// The trace is what the format's readers expect: tracks with names, slices that nest, a counter.
#include "rendergraph/trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

namespace lensgraph {

using namespace rendergraph;
using nlohmann::json;

namespace {

Capture frame(bool timed = true) {
  Capture capture;
  capture.timing = timed ? "inline" : "none";
  capture.frameWallMs = 10.0;
  for (uint32_t i = 0; i < 2; ++i) {
    CapturedPass pass;
    pass.name = i == 0 ? "draw \"it\"" : "blur";
    pass.queue = i;
    pass.recordStartMs = 1.0 + i;
    pass.recordMs = 0.5;
    if (timed) pass.gpuStartMs = 4.0 + 2.0 * i;
    if (timed) pass.gpuMs = 1.5;
    pass.bytesWritten = 100 + i;
    pass.imageBarriers = 3;
    capture.passes.push_back(pass);
  }
  capture.resources.push_back({.name = "r", .heap = 0, .offset = 0, .size = 64, .firstStep = 0, .lastStep = 1});
  capture.resources.push_back({.name = "s", .heap = 0, .offset = 64, .size = 32, .firstStep = 1, .lastStep = 2});
  return capture;
}

json trace(const std::vector<Capture>& frames) {
  std::ostringstream out;
  writeTrace(out, frames, "program");
  return json::parse(out.str())["traceEvents"];
}

std::vector<json> ofPhase(const json& events, const char* phase, int track = -1) {
  std::vector<json> found;
  for (const json& event : events) {
    if (event["ph"] == phase && (track < 0 || event["tid"] == track)) found.push_back(event);
  }
  return found;
}

TEST(Trace, NamesTheProcessAndItsTracks) {
  std::map<int, std::string> threads;
  std::string process;
  for (const json& event : ofPhase(trace({frame()}), "M")) {
    if (event["name"] == "process_name") process = event["args"]["name"];
    if (event["name"] == "thread_name") threads[event["tid"]] = event["args"]["name"];
  }
  EXPECT_EQ(process, "program");
  EXPECT_EQ(threads,
            (std::map<int, std::string>{{1, "host: recording"}, {10, "device: queue 0"}, {11, "device: queue 1"}}));
}

TEST(Trace, PassesLieOnTheirTracksInMicroseconds) {
  const json events = trace({frame(), frame()});
  const auto host = ofPhase(events, "X", 1), queue = ofPhase(events, "X", 11);
  ASSERT_EQ(host.size(), 6u) << "a frame and two passes, twice";
  ASSERT_EQ(queue.size(), 2u);
  EXPECT_EQ(host[1]["name"], "draw \"it\"");
  EXPECT_DOUBLE_EQ(host[1]["ts"], 1000.0);
  EXPECT_DOUBLE_EQ(host[1]["dur"], 500.0);
  EXPECT_DOUBLE_EQ(host[3]["ts"], 10000.0) << "the second frame begins where the first has ended";
  EXPECT_DOUBLE_EQ(queue[0]["ts"], 6000.0);
  EXPECT_DOUBLE_EQ(queue[0]["dur"], 1500.0);
  EXPECT_DOUBLE_EQ(queue[1]["ts"], 16000.0);
  EXPECT_EQ(queue[0]["args"]["bytesWritten"], 101);
  EXPECT_EQ(queue[0]["args"]["imageBarriers"], 3);
}

TEST(Trace, CountsTheMemoryInUse) {
  std::vector<std::pair<double, int>> counted;
  for (const json& event : ofPhase(trace({frame()}), "C")) counted.emplace_back(event["ts"], event["args"]["bytes"]);
  EXPECT_THAT(counted, testing::ElementsAre(std::pair(4000.0, 64), std::pair(6000.0, 96), std::pair(10000.0, 32)));
}

TEST(Trace, WithoutDeviceTimesThereIsNoDeviceTrack) {
  const json events = trace({frame(false)});
  for (const json& event : events) {
    EXPECT_EQ(event.value("tid", 1), 1);
  }
  EXPECT_EQ(ofPhase(events, "C").size(), 3u);
}

}  // namespace

}  // namespace lensgraph
