// Bad input: exit status 2, one line that says file, field and reason, and nothing left behind.
#include <cmath>

#include "engine/image/image.h"
#include "engine/image/image_io.h"
#include "program.h"

namespace lensgraph {

namespace {

using nlohmann::json;

class BadInput : public cli_test::ProgramTest {
 protected:
  BadInput() {
    writeQuad();
    writeShot(shot());
  }
  void expectRefused(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) const {
    expectError(arguments, 2, parts);
  }
  /// Renders shot.json after one change of it.
  void expectShotRefused(const std::string& pointer, const json& value, const std::vector<std::string>& parts) const {
    json changed = shot();
    changed[json::json_pointer(pointer)] = value;
    writeShot(changed);
    expectRefused({"render", "shot.json", "-o", "out.exr"}, parts);
  }
};

// ---- Files

TEST_F(BadInput, AMissingShotIsRefused) {
  expectRefused({"render", "absent.json", "-o", "out.exr"}, {"absent.json", "no such file"});
}

TEST_F(BadInput, AMissingSceneIsRefused) {
  expectShotRefused("/scene/0/path", "absent.glb", {"shot.json", "scene[0].path", "absent.glb", "no such file"});
}

TEST_F(BadInput, MalformedJsonIsRefusedWithLineAndColumn) {
  write("shot.json", "{\n  \"scene\": [\n}");
  expectRefused({"render", "shot.json", "-o", "out.exr"}, {"shot.json", "line 3, column 1", "syntax error"});
}

TEST_F(BadInput, ABinaryFileIsRefusedAsAShot) {
  write("shot.json", std::string("\x89PNG\r\n\x1a\n\0\n", 10));
  expectRefused({"render", "shot.json", "-o", "out.exr"}, {"shot.json", "line 1, column 1"});
}

TEST_F(BadInput, ATruncatedGlbIsRefused) {
  writeQuadGlb(0);
  json good = shot();
  good["scene"][0]["path"] = "quad.glb";
  writeShot(good);
  EXPECT_EQ(run({"render", "shot.json", "--technique", "pinhole", "-o", "whole.exr"}).status, 0)
      << "the whole file is read";
  for (const std::size_t missing : {1, 50, 110, 300, 1000000}) {
    SCOPED_TRACE(missing);
    writeQuadGlb(missing);
    expectRefused({"render", "shot.json", "-o", "out.exr"}, {"quad.glb"});
  }
}

TEST_F(BadInput, AnIndexOutOfRangeIsRefused) {
  writeQuad({.lastIndex = 4});
  expectRefused({"render", "shot.json", "-o", "out.exr"}, {"quad.gltf", "meshes[0].primitives[0]", "4"});
}

TEST_F(BadInput, NanPositionsAreRefused) {
  writeQuad({.firstX = std::nanf("")});
  expectRefused({"render", "shot.json", "-o", "out.exr"}, {"quad.gltf", "POSITION"});
}

TEST_F(BadInput, AnEmptyImageOfASceneIsRefused) {
  writeQuad({.textured = true});
  write("texture.png", "");
  expectRefused({"render", "shot.json", "-o", "out.exr"}, {"quad.gltf", "images[0]", "texture.png"});
}

TEST_F(BadInput, EmptyPicturesAreRefused) {
  write("empty.exr", "");
  expectRefused({"compare", "empty.exr", "empty.exr"}, {"empty.exr"});
  expectRefused({"apply", "--color", "empty.exr", "--depth", "empty.exr", "--fovy", "40", "--aperture-radius", "0.01",
                 "--focus", "1", "--technique", "two_pass_filter", "-o", "out.exr"},
                {"empty.exr"});
}

TEST_F(BadInput, PicturesOfDifferentSizesAreNotCompared) {
  engine::writeImage(folder() / "small.exr", engine::FloatImage(4, 4, 3));
  engine::writeImage(folder() / "large.exr", engine::FloatImage(8, 4, 3));
  expectRefused({"compare", "small.exr", "large.exr"}, {"4", "8"});
}

// ---- Techniques and parameters

TEST_F(BadInput, AnUnknownTechniqueIsRefusedWithTheNearestName) {
  expectRefused({"render", "shot.json", "--technique", "pinhol", "-o", "out.exr"}, {"pinhol", "did you mean pinhole?"});
  expectShotRefused("/technique", {{"name", "acumulation"}}, {"technique.name", "accumulation"});
}

TEST_F(BadInput, AnUnknownParameterIsRefusedWithTheNearestName) {
  expectRefused({"render", "shot.json", "--technique", "accumulation", "--set", "lensSample=4", "-o", "out.exr"},
                {"lensSample", "did you mean", "lensSamples"});
  expectShotRefused("/technique", {{"name", "accumulation"}, {"lensSample", 4}},
                    {"technique.lensSample", "lensSamples"});
}

TEST_F(BadInput, AParameterOutOfRangeIsRefused) {
  for (const std::string value : {"0", "-1", "65537", "1e99", "many", "nan", ""}) {
    SCOPED_TRACE(value);
    expectRefused(
        {"render", "shot.json", "--technique", "accumulation", "--set", "lensSamples=" + value, "-o", "out.exr"},
        {"lensSamples"});
  }
  expectShotRefused("/technique", {{"name", "accumulation"}, {"lensSamples", 0}}, {"technique.lensSamples"});
}

TEST_F(BadInput, ABadConfigurationFileIsRefused) {
  const std::vector<std::string> arguments = {"render", "shot.json", "--config", "config.json", "-o", "out.exr"};
  expectRefused(arguments, {"config.json", "no such file"});
  write("config.json", "{\"technique\": {\"name\": \"accumulation\", \"lensSamples\": }}");
  expectRefused(arguments, {"config.json", "line 1, column"});
  write("config.json", R"({"technique": {"name": "accumulation", "lensSamples": 0}})");
  expectRefused(arguments, {"config.json", "technique.lensSamples"});
  write("config.json", R"({"technique": {"name": "accumulation"}})");
  auto contradiction = arguments;
  contradiction.insert(contradiction.end(), {"--technique", "pinhole"});
  expectRefused(contradiction, {"config.json", "accumulation", "pinhole"});
}

TEST_F(BadInput, ATechniqueThatDrawsIsRefusedForAPicture) {
  expectRefused({"apply", "--color", "c.exr", "--depth", "z.exr", "--fovy", "40", "--aperture-radius", "0.01",
                 "--focus", "1", "--technique", "accumulation", "-o", "out.exr"},
                {"accumulation", "two_pass_filter"});
}

// ---- Numbers

TEST_F(BadInput, ABadResolutionIsRefused) {
  for (const int side : {0, -1, 20000}) {
    expectShotRefused("/resolution", {side, 24}, {"resolution[0]", std::to_string(side)});
    expectShotRefused("/resolution", {32, side}, {"resolution[1]", std::to_string(side)});
  }
  for (const std::string size : {"0x24", "32x20000", "32", "32x", "x24", "axb", "32x24x2", "-1x24"}) {
    SCOPED_TRACE(size);
    expectRefused({"render", "shot.json", "--size", size, "-o", "out.exr"}, {"--size", size});
  }
}

TEST_F(BadInput, ABadFocusDistanceIsRefused) {
  for (const double focus : {0.0, -1.0}) expectShotRefused("/lens/focusDistance", focus, {"lens.focusDistance"});
  expectShotRefused("/lens/focusDistance", "nan", {"lens.focusDistance", "infinity"});
}

TEST_F(BadInput, ABadFNumberIsRefused) {
  expectShotRefused("/lens", {{"fStop", -2.8}, {"focusDistance", 1}}, {"lens.fStop", "-2.8"});
  expectShotRefused("/lens", {{"fStop", "nan"}, {"focusDistance", 1}}, {"lens.fStop"});
  write("shot.json", R"({"scene": [], "lens": {"fStop": NaN}})");
  expectRefused({"render", "shot.json", "-o", "out.exr"}, {"shot.json", "line 1, column"});
  write("shot.json", R"({"scene": [], "lens": {"fStop": 1e999}})");
  expectRefused({"render", "shot.json", "-o", "out.exr"}, {"shot.json", "line 1, column", "1e999"});
}

struct BadLens {
  std::vector<std::string> arguments;
  std::string option;
};

TEST_F(BadInput, ABadLensOfApplyIsRefused) {
  const BadLens rows[] = {
      {{"--aperture-radius", "-1", "--focus", "1"}, "--aperture-radius"},
      {{"--aperture-radius", "nan", "--focus", "1"}, "--aperture-radius"},
      {{"--focal-length-mm", "50", "--fstop", "-2", "--focus", "1"}, "--fstop"},
      {{"--focal-length-mm", "50", "--fstop", "nan", "--focus", "1"}, "--fstop"},
      {{"--focal-length-mm", "50", "--fstop", "inf", "--focus", "1"}, "--fstop"},
      {{"--focal-length-mm", "0", "--fstop", "2", "--focus", "1"}, "--focal-length-mm"},
      {{"--focal-length-mm", "50", "--focus", "1"}, "--fstop"},
      {{"--aperture-radius", "0.1", "--fstop", "2", "--focus", "1"}, "--fstop"},
      {{"--focus", "1"}, "--aperture-radius"},
      {{"--aperture-radius", "0.01", "--focus", "0"}, "--focus"},
      {{"--aperture-radius", "0.01", "--focus", "-3"}, "--focus"},
      {{"--aperture-radius", "0.01", "--focus", "nan"}, "--focus"},
  };
  for (const auto& [lens, option] : rows) {
    SCOPED_TRACE(testing::PrintToString(lens));
    std::vector<std::string> arguments = {"apply", "--color",     "c.exr",           "--depth", "z.exr",  "--fovy",
                                          "40",    "--technique", "two_pass_filter", "-o",      "out.exr"};
    arguments.insert(arguments.end(), lens.begin(), lens.end());
    expectRefused(arguments, {option});
  }
}

TEST_F(BadInput, ABadExposureIsRefused) {
  for (const std::string value : {"nan", "inf", "bright"}) {
    expectRefused({"render", "shot.json", "--exposure", value, "-o", "out.png"}, {"--exposure"});
  }
}

// ---- Outputs

TEST_F(BadInput, AnUnwritableOutputIsRefused) {
  expectRefused({"render", "shot.json", "-o", "absent/out.exr"}, {"absent/out.exr", "no such folder: absent"});
  expectRefused({"render", "shot.json", "-o", "/proc/out.exr"}, {"/proc/out.exr", "cannot be written"});
  expectRefused({"render", "shot.json", "-o", "shot.json/out.exr"}, {"shot.json/out.exr"});
  std::filesystem::create_directory(folder() / "folder.exr");
  expectRefused({"render", "shot.json", "-o", "folder.exr"}, {"folder.exr", "is a folder"});
  expectRefused({"render", "shot.json", "-o", "out.exr", "--capture", "absent/c.json"}, {"absent/c.json", "--capture"});
  expectRefused({"render", "shot.json", "-o", "out.exr", "--depth-out", "z.png"}, {"z.png", ".exr"});
  expectRefused({"graph", "shot.json", "--technique", "pinhole", "--dot", "absent/g.dot"}, {"absent/g.dot", "--dot"});
}

TEST_F(BadInput, AnUnknownPictureFormatIsRefused) {
  expectRefused({"render", "shot.json", "-o", "out.jpg"}, {"out.jpg", ".jpg", ".exr"});
  expectRefused({"render", "shot.json", "-o", "out"}, {"out", "extension"});
}

TEST_F(BadInput, AShotThatNeverEndsIsRefused) {
  expectRefused({"render", "/dev/zero", "-o", "out.exr"}, {"/dev/zero", "larger than 256 MiB"});
}

// ---- Usage

TEST_F(BadInput, BadUsageIsRefusedWithAdvice) {
  expectRefused({}, {"command line", "no subcommand", "--help"});
  expectRefused({"rendr", "shot.json"}, {"rendr", "did you mean render?"});
  expectRefused({"render", "shot.json", "--techniqe", "pinhole", "-o", "out.exr"}, {"--techniqe", "--technique"});
  expectRefused({"render", "shot.json"}, {"render", "--output"});
  expectRefused({"render", "-o", "out.exr"}, {"render", "shot"});
  expectRefused({"render", "shot.json", "-o", "out.exr", "--set", "noEquals"}, {"noEquals", "key=value"});
  expectRefused({"graph", "shot.json", "--technique", "pinhole"}, {"graph", "--dot"});
  expectRefused({"demo", "--scenes", "absent"}, {"absent", "--scenes"});
}

TEST_F(BadInput, AnUnknownDeviceIsRefused) {
  expectRefused({"render", "shot.json", "--device", "no such device", "-o", "out.exr"}, {"no such device"});
  expectRefused({"render", "shot.json", "--device", "99", "-o", "out.exr"}, {"99"});
}

TEST_F(BadInput, AMachineWithoutADriverIsToldWhatToInstall) {
  const auto outcome = run({"render", "shot.json", "-o", "out.exr"}, [] {
    return setenv("VK_DRIVER_FILES", "/nonexistent", 1) == 0 && setenv("VK_ICD_FILENAMES", "/nonexistent", 1) == 0;
  });
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "lensgraph: error: no Vulkan device found; install the package mesa-vulkan-drivers\n");
}

TEST_F(BadInput, APictureThatTheDeviceCannotHoldIsRefusedWithTheSizeThatFits) {
  expectRefused(
      {"render", "shot.json", "--technique", "multilayer_filtering", "--size", "16384x16384", "-o", "out.exr"},
      {"resolution: 16384x16384 px is more than this device takes for multilayer_filtering", "up to ", " px fits"});
}

}  // namespace

}  // namespace lensgraph
