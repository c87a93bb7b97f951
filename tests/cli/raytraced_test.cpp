// The technique raytraced as a user asks for it: no Vulkan device, no graph, a state that an interrupted rendering goes on
// from.
#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "engine/image/image.h"
#include "engine/image/image_io.h"
#include "engine/metrics/metrics.h"
#include "program.h"

namespace lensgraph {

namespace {

using nlohmann::json;
using testing::HasSubstr;

class Raytraced : public cli_test::ProgramTest {
 protected:
  Raytraced() {
    writeQuad();
    writeShot(shot());
  }
  static std::vector<std::string> command(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"render", "shot.json", "--technique", "raytraced"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  void expectRefused(std::vector<std::string> more, const std::vector<std::string>& parts) const {
    more.insert(more.end(), {"-o", "out.exr"});
    expectError(command(more), 2, parts);
  }
};

TEST_F(Raytraced, NeedsNoVulkanDevice) {
  const auto outcome = run(command({"--set", "samples=64", "-o", "out.exr", "--depth-out", "z.exr"}), [] {
    return setenv("VK_ICD_FILENAMES", "/nonexistent", 1) == 0 && setenv("VK_DRIVER_FILES", "/nonexistent", 1) == 0;
  });
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, testing::AllOf(HasSubstr("Embree 3"), HasSubstr("samples = 64"), HasSubstr("time ")));
  EXPECT_NEAR(engine::readImage(folder() / "z.exr").pixel(16, 12)[0], 2.0f, 1e-5f);
  runWell({"render", "shot.json", "--technique", "accumulation", "-o", "drawn.exr"});
  const auto drawn = engine::readImage(folder() / "drawn.exr"), traced = engine::readImage(folder() / "out.exr");
  EXPECT_GT(engine::compareImages(traced, drawn).psnr, 45.0);
}

TEST_F(Raytraced, AShotFileNamesItLikeAnyOther) {
  json changed = shot();
  changed["technique"] = {{"name", "raytraced"}, {"samples", 4}, {"pixelFilter", "tent"}};
  writeShot(changed);
  EXPECT_THAT(runWell({"render", "shot.json", "-o", "out.exr"}), HasSubstr("pixelFilter = tent"));
  changed["technique"]["samples"] = 0;
  writeShot(changed);
  expectError({"render", "shot.json", "-o", "bad.exr"}, 2, {"shot.json", "technique.samples"});
}

TEST_F(Raytraced, BadParametersAreRefused) {
  expectRefused({"--set", "sample=4"}, {"--set sample", "samples"});
  expectRefused({"--set", "samples=0"}, {"--set samples", "1"});
  expectRefused({"--set", "pixelFilter=boxx"}, {"--set pixelFilter", "box"});
  expectError({"render", "shot.json", "--technique", "raytrace", "-o", "out.exr"}, 2, {"--technique", "raytraced"});
}

TEST_F(Raytraced, WhatWantsAGraphIsRefusedInOneLine) {
  expectRefused({"--capture", "c.json"}, {"--capture", "no render graph"});
  expectRefused({"--trace", "t.json"}, {"--trace", "no render graph"});
  expectRefused({"--dump-image", "list"}, {"--dump-image", "no render graph"});
  expectError({"graph", "shot.json", "--technique", "raytraced", "--dot", "g.dot"}, 2,
              {"--technique", "no render graph"});
  expectError({"render", "shot.json", "--technique", "pinhole", "--checkpoint", "s", "-o", "out.exr"}, 2,
              {"--checkpoint", "pinhole", "raytraced"});
}

TEST_F(Raytraced, ACheckpointOfAnotherShotSizeOrParameterIsRefusedByName) {
  const auto withState = [](std::vector<std::string> more) {
    more.insert(more.end(), {"--set", "samples=1", "--checkpoint", "state"});
    return more;
  };
  auto first = withState({});
  first.insert(first.end(), {"-o", "out.exr"});
  runWell(command(first));
  expectRefused(withState({"--size", "33x24"}), {"state", "another size"});
  expectRefused(withState({"--set", "seed=3"}), {"state", "another seed"});
  json changed = shot();
  changed["lens"]["focusDistance"] = 7.5;
  writeShot(changed);
  expectRefused(withState({}), {"state", "another focus distance", "7.5"});
}

// A process that is ended by a signal leaves a whole state or none, and the next one makes the picture of an undisturbed
// one.
TEST_F(Raytraced, EndedBySignalsItGoesOnToTheSamePicture) {
  const auto asked = [](const char* samples, const char* out) {
    return command({"--size", "160x120", "--set", std::string("samples=") + samples, "-o", out});
  };
  runWell(asked("24", "whole.exr"));
  auto interrupted = asked("1000000", "part.exr");
  interrupted.insert(interrupted.end(), {"--checkpoint", "state"});
  auto first = asked("8", "part.exr");
  first.insert(first.end(), {"--checkpoint", "state"});
  runWell(first);
  const std::string before = cli_test::contentOf(folder() / "state");
  // SIGALRM stands for Ctrl-C: an alarm outlives the start of the program.
  EXPECT_EQ(run(interrupted, [] { return alarm(1) == 0; }).status, 128 + SIGALRM);
  EXPECT_EQ(cli_test::contentOf(folder() / "state"), before) << "the state is written every 10 s";
  auto last = asked("24", "part.exr");
  last.insert(last.end(), {"--checkpoint", "state"});
  runWell(last);
  const auto part = engine::readImage(folder() / "part.exr"), whole = engine::readImage(folder() / "whole.exr");
  EXPECT_TRUE(part.samples == whole.samples);
}

}  // namespace

}  // namespace lensgraph
