// Captures, traces, dumped images, capture-view and capture-diff as a user meets them: good input and bad.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "engine/image/image.h"
#include "engine/image/image_io.h"
#include "program.h"

namespace lensgraph {

namespace {

using nlohmann::json;
using testing::HasSubstr;

class Inspection : public cli_test::ProgramTest {
 protected:
  Inspection() {
    writeQuad();
    writeShot(shot());
  }
  std::string render(std::vector<std::string> arguments, const std::string& technique = "pinhole") const {
    arguments.insert(arguments.begin(),
                     {"render", "shot.json", "--validate", "--technique", technique, "-o", "out.exr"});
    return runWell(arguments);
  }
  std::string text(const std::string& file) const {
    std::ifstream stream(folder() / file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  json parsed(const std::string& file) const { return json::parse(text(file)); }
  void writePictures() const {
    engine::writeImage(folder() / "c.exr", engine::FloatImage(16, 12, 3, 0.5f));
    engine::writeImage(folder() / "z.exr", engine::FloatImage(16, 12, 1, 3.0f));
  }
  std::vector<std::string> apply(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {
        "apply", "--validate",        "--color", "c.exr",   "--depth", "z.exr",       "--fovy",
        "40",    "--aperture-radius", "0.01",    "--focus", "1",       "--technique", "two_pass_filter"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  void expectRefused(std::vector<std::string> arguments, const std::vector<std::string>& parts) const {
    arguments.insert(arguments.begin(), {"render", "shot.json", "--technique", "pinhole", "-o", "out.exr"});
    expectError(arguments, 2, parts);
  }
};

TEST_F(Inspection, CaptureHoldsTimesMemoryAndEdgesOfSeveralFrames) {
  render({"--capture", "c.json", "--capture-frames", "3"}, "two_pass_filter");
  const json capture = parsed("c.json"), graph = capture["graph"];
  EXPECT_EQ(capture["format"], "lensgraph capture");
  EXPECT_EQ(graph["frames"], 3);
  EXPECT_EQ(graph["plansReused"], 3) << "the warm-up compiled the plan";
  EXPECT_EQ(graph["timing"], capture["device"]["type"] == "cpu" ? "isolated" : "inline");
  for (const auto& pass : graph["passes"]) {
    EXPECT_LE(pass["gpuMs"]["min"], pass["gpuMs"]["median"]) << pass["name"];
    EXPECT_LE(pass["gpuMs"]["median"], pass["gpuMs"]["max"]) << pass["name"];
  }
  EXPECT_FALSE(graph["edges"].empty());
  uint64_t heaps = 0;
  for (const auto& heap : graph["memory"]["heaps"]) heaps += heap["size"].get<uint64_t>();
  EXPECT_EQ(graph["memory"]["peakBytes"], heaps);
}

TEST_F(Inspection, TimingCanBeChosen) {
  for (const std::string mode : {"inline", "isolated"}) {
    render({"--capture", "c.json", "--capture-frames", "1", "--timing", mode});
    EXPECT_EQ(parsed("c.json")["graph"]["timing"], mode);
    EXPECT_EQ(parsed("c.json")["uninterrupted"].is_null(), mode == "inline");
  }
}

TEST_F(Inspection, TraceHasTheMeasuredFramesAndTheirTracks) {
  render({"--trace", "t.json", "--capture-frames", "2"});
  int frames = 0, names = 0, counters = 0, onQueue = 0;
  const json trace = parsed("t.json");
  for (const auto& event : trace["traceEvents"]) {
    frames += event["ph"] == "X" && event["name"].get<std::string>().starts_with("frame ");
    names += event["name"] == "thread_name";
    counters += event["ph"] == "C";
    onQueue += event["ph"] == "X" && event["tid"] == 10;
  }
  EXPECT_EQ(frames, 2);
  EXPECT_EQ(names, 2);
  EXPECT_GT(counters, 0);
  EXPECT_GT(onQueue, 0);
}

TEST_F(Inspection, ApplyWritesCapturesTracesAndDumpsToo) {
  writePictures();
  runWell(apply({"-o", "out.exr", "--capture", "c.json", "--trace", "t.json", "--capture-frames", "1", "--dump-image",
                 "two_pass_filter.horizontal/two_pass_filter.color=d.exr"}));
  EXPECT_EQ(parsed("c.json")["graph"]["frames"], 1);
  EXPECT_FALSE(parsed("t.json")["traceEvents"].empty());
  const auto dumped = engine::readImage(folder() / "d.exr"), picture = engine::readImage(folder() / "out.exr");
  EXPECT_EQ(dumped.samples, picture.samples) << "the last pass writes the picture";
  EXPECT_THAT(runWell(apply({"--dump-image", "list"})), HasSubstr("two_pass_filter.prepare/two_pass_filter.prepared"));
}

TEST_F(Inspection, DumpedImagesAreThoseOfThePasses) {
  render({"--dump-image", "pinhole.opaque/pinhole.color=color.exr", "--dump-image",
          "pinhole.opaque/pinhole.depth[0,0]=depth.exr", "--dump-image", "pinhole.opaque/pinhole.color=color.png",
          "--depth-out", "z.exr", "--capture", "c.json", "--capture-frames", "1"});
  EXPECT_EQ(engine::readImage(folder() / "color.exr").samples, engine::readImage(folder() / "out.exr").samples);
  const auto depth = engine::readDepth(folder() / "depth.exr"), metres = engine::readDepth(folder() / "z.exr");
  const float constant = *depth.pixel(3, 4) * *metres.pixel(3, 4);
  EXPECT_GT(constant, 0.0f) << "reversed depth: near plane over distance";
  EXPECT_NEAR(*depth.pixel(30, 20) * *metres.pixel(30, 20), constant, 1e-5f);
  EXPECT_NEAR(engine::readImage(folder() / "color.png").pixel(5, 5)[1], 0.5f, 0.01f);
  const json capture = parsed("c.json");
  for (const auto& pass : capture["graph"]["passes"]) {
    EXPECT_FALSE(pass["name"].get<std::string>().starts_with("tap ")) << "the copies are not measured";
  }
}

TEST_F(Inspection, ListOfImagesNeedsNoOutput) {
  const auto list = runWell({"render", "shot.json", "--technique", "accumulation", "--dump-image", "list"});
  EXPECT_THAT(list, HasSubstr("accumulation.view0.opaque/accumulation.view0.color"));
  EXPECT_THAT(list, HasSubstr("accumulation.resolve/accumulation.color")) << "of the last execution";
  EXPECT_FALSE(std::filesystem::exists(folder() / "out.exr"));
}

TEST_F(Inspection, CaptureViewIsOnePage) {
  render({"--capture", "c.json", "--capture-frames", "2"});
  const auto outcome = run({"capture-view", "c.json", "-o", "page.html"});
  if (outcome.status == 1 && outcome.err.find("dagre") != std::string::npos) GTEST_SKIP() << outcome.err;
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(text("page.html").find("pinhole.opaque"), std::string::npos);
  EXPECT_EQ(runWell({"capture-view", "c.json", "-o", "-"}) == text("page.html"), true);
}

TEST_F(Inspection, CaptureDiffTellsWhatChanged) {
  render({"--capture", "a.json", "--capture-frames", "2"}, "pinhole");
  render({"--capture", "b.json", "--capture-frames", "2"}, "two_pass_filter");
  const auto said = runWell({"capture-diff", "a.json", "b.json"});
  EXPECT_THAT(said, testing::AllOf(HasSubstr("technique"), HasSubstr("pinhole -> two_pass_filter"),
                                   HasSubstr("+ two_pass_filter.vertical"), HasSubstr("memory, bytes")));
  const auto diff = json::parse(runWell({"capture-diff", "a.json", "b.json", "--json"}));
  EXPECT_LT(diff["passCount"]["before"], diff["passCount"]["after"]);
  EXPECT_THAT(runWell({"capture-diff", "a.json", "a.json"}), HasSubstr("passes that changed: 0 of"));
}

// ---- Bad input

TEST_F(Inspection, RefusesBadCaptureOptions) {
  for (const std::string frames : {"0", "-1", "1001", "many", "1.5"}) {
    SCOPED_TRACE(frames);
    expectRefused({"--capture", "c.json", "--capture-frames", frames}, {"--capture-frames"});
  }
  expectRefused({"--capture", "c.json", "--timing", "fast"}, {"--timing", "fast", "isolated"});
  expectRefused({"--capture-frames", "3"}, {"--capture-frames", "--capture FILE.json"});
  expectRefused({"--timing", "inline"}, {"--timing", "--capture FILE.json"});
  expectRefused({"--trace", "absent/t.json"}, {"absent/t.json", "--trace", "no such folder"});
  expectRefused({"--capture", "x.json", "--trace", "x.json"}, {"x.json", "same file"});
}

TEST_F(Inspection, RefusesBadDumps) {
  for (const std::string dump :
       {"", "list=x", "color", "pinhole.opaque/pinhole.color", "=x.exr", "a=b/c.exr", "/color=x.exr", "pass/=x.exr"}) {
    SCOPED_TRACE(dump);
    expectRefused({"--dump-image", dump}, {"--dump-image"});
  }
  for (const std::string range : {"[0]", "[0,", "[0,0", "[-1,0]", "[a,b]", "[0,0]x", "[99999999999,0]"}) {
    SCOPED_TRACE(range);
    expectRefused({"--dump-image", "pinhole.opaque/pinhole.color" + range + "=x.exr"}, {"[MIP,LAYER]"});
  }
  expectRefused({"--dump-image", "list", "--dump-image", "pinhole.opaque/pinhole.color=x.exr"},
                {"--dump-image", "list"});
  expectRefused({"--dump-image", "pinhole.opaque/pinhole.color=x.jpg"}, {"x.jpg", ".exr", ".png"});
  expectRefused({"--dump-image", "pinhole.opaque/pinhole.color=absent/x.exr"}, {"absent/x.exr", "--dump-image"});
  expectRefused({"--dump-image", "pinhole.opaque/pinhole.color=out.exr"}, {"out.exr", "same file"});
}

TEST_F(Inspection, DumpsThatMatchNothingSayWhatThereIs) {
  expectRefused(
      {"--dump-image", "pinhole.opaqe/pinhole.color=x.exr"},
      {"pinhole.opaqe/pinhole.color", "did you mean pinhole.opaque/pinhole.color?", "pinhole.opaque/pinhole.depth"});
  expectRefused({"--dump-image", "pinhole.opaque/pinhole.color[1,0]=x.exr"}, {"[1,0]", "no such mip and layer"});
  expectRefused(
      {"--dump-image", "pinhole.opaque/pinhole.color[0,1]=x.exr", "--capture", "c.json", "--capture-frames", "1"},
      {"[0,1]", "no such mip and layer"});
}

TEST_F(Inspection, RefusesBadCaptureFiles) {
  write("broken.json", "{\"format\": ");
  write("other.json", "{\"scene\": []}");
  write("empty.json", "");
  write("future.json", R"({"format": "lensgraph capture", "formatVersion": 99})");
  write("hollow.json", R"({"format": "lensgraph capture", "formatVersion": 1})");
  const std::pair<std::string, std::string> files[] = {
      {"absent.json", "no such file"}, {"broken.json", "line 1"}, {"other.json", "is no capture"},
      {"shot.json", "is no capture"},  {"empty.json", "empty"},   {"future.json", "formatVersion"},
      {"hollow.json", "graph"},        {"quad.bin", "quad.bin"}};
  for (const auto& [file, reason] : files) {
    SCOPED_TRACE(file);
    expectError({"capture-view", file, "-o", "page.html"}, 2, {file, reason});
    expectError({"capture-diff", file, file}, 2, {file, reason});
  }
  expectError({"capture-diff", "shot.json"}, 2, {"capture-diff", "after"});
  expectError({"capture-view", "shot.json"}, 2, {"capture-view", "--output"});
  expectError({"capture-view", "shot.json", "-o", "page.txt"}, 2, {"page.txt", ".html"});
  expectError({"capture-view", "shot.json", "-o", "absent/page.html"}, 2, {"absent/page.html", "no such folder"});
}

}  // namespace

}  // namespace lensgraph
